// Work that is waited for only while it is wanted.
#include "app/abandonable.hpp"

#include <future>
#include <memory>
#include <stdexcept>

#include <gtest/gtest.h>

namespace gyrod {
namespace {

TEST(WhileWanted, GivesWhatTheWorkReturns) {
  EXPECT_EQ(app::while_wanted([] { return true; }, [] { return 42; }), 42);
}

TEST(WhileWanted, HandsOnWhatTheWorkThrows) {
  const auto fail = []() -> int { throw std::runtime_error("no"); };
  EXPECT_THROW((void)app::while_wanted([] { return true; }, fail), std::runtime_error);
}

// Were it waited for, this would never end: the work waits for what comes after.
TEST(WhileWanted, DoesNotWaitForWorkThatIsNoLongerWanted) {
  std::promise<void> release;
  const auto ended = std::make_shared<std::promise<void>>();
  std::future<void> end = ended->get_future();
  const auto work = [released = release.get_future().share(), ended] {
    released.wait();
    ended->set_value();
    return 1;
  };
  EXPECT_FALSE(app::while_wanted([] { return false; }, work).has_value());
  release.set_value();
  end.wait();
}

}  // namespace
}  // namespace gyrod
