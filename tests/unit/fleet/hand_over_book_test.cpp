#include "fleet/hand_over_book.hpp"

#include <string>

#include <gtest/gtest.h>

namespace gyrod::fleet {
namespace {

TEST(HandOverBook, OwesWhatWasAnnouncedUntilItHasComeInEitherOrder) {
  HandOverBook book;
  EXPECT_FALSE(book.owes());
  book.announce("a", 0);
  EXPECT_FALSE(book.owes()) << "nothing was given up yet";
  book.announce("a", 2);
  book.announce("b", 1);
  book.receive("a", 1);
  book.receive("b", 1);
  EXPECT_TRUE(book.owes()) << "the second of a";
  book.receive("a", 2);
  EXPECT_FALSE(book.owes());
  book.receive("a", 3);
  book.announce("a", 3);
  book.announce("a", 1);
  EXPECT_FALSE(book.owes()) << "news may be old";
}

TEST(HandOverBook, AwaitsTheLastOneOfADaemonThatHasGone) {
  HandOverBook book;
  book.announce("a", 1);
  book.forget("a");
  EXPECT_TRUE(book.owes());
  book.receive("a", 1);
  EXPECT_FALSE(book.owes());
}

TEST(HandOverBook, ADaemonThatIsBackOwesNothingThatHasCome) {
  HandOverBook book;
  book.announce("a", 3);
  book.forget("a");
  book.announce("a", 3);
  book.receive("a", 3);
  book.announce("a", 3);
  EXPECT_FALSE(book.owes());
}

TEST(HandOverBook, WritesOffWhatDoesNotCome) {
  HandOverBook book;
  book.announce("a", 1);
  book.announce("gone", 1);
  book.forget("gone");
  book.write_off();
  EXPECT_FALSE(book.owes());
  book.announce("a", 2);
  EXPECT_TRUE(book.owes()) << "the next one is another matter";
}

TEST(HandOverBook, HasRoomForNewDaemonsHoweverManyHaveGone) {
  HandOverBook book;
  for (int k = 0; k < 5000; ++k) {
    const std::string id = std::to_string(k);
    book.announce(id, 1);
    ASSERT_TRUE(book.owes()) << k;
    book.receive(id, 1);
    book.forget(id);
    ASSERT_FALSE(book.owes()) << k;
  }
}

}  // namespace
}  // namespace gyrod::fleet
