#include "top/view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyrod::top {
namespace {

constexpr std::uint64_t kMatching = 100;
constexpr std::uint64_t kRows = 10;

bool type(View& view, std::string_view bytes) {
  bool going = true;
  for (const KeyPress key : keys_of(bytes)) going = going && press(view, key, kMatching, kRows);
  return going;
}

TEST(Keys, AreReadFromWhatTerminalsSend) {
  const auto keys = keys_of("\x1b[A\x1bOB\x1b[5~q\x1b[1;5C\x7f\r\x1b");
  std::vector<Key> names;
  for (const KeyPress key : keys) names.push_back(key.key);
  EXPECT_THAT(names, ::testing::ElementsAre(Key::kUp, Key::kDown, Key::kPageUp, Key::kCharacter,
                                            Key::kBackspace, Key::kEnter, Key::kEscape))
      << "an unknown sequence is no key, and none of its letters is one";
}

TEST(View, QuitsWithQButNotWhileASearchIsTyped) {
  View view;
  EXPECT_TRUE(type(view, "/q"));
  EXPECT_EQ(view.search, "q");
  EXPECT_TRUE(type(view, "\x7fimu\r"));
  EXPECT_EQ(view.search, "imu");
  EXPECT_FALSE(type(view, "q"));
}

TEST(View, GivesUpASearchWithEscape) {
  View view;
  type(view, "/imu\x1b");
  EXPECT_EQ(view.search, "");
  type(view, "/imu\r");
  type(view, "\x1b");
  EXPECT_EQ(view.search, "");
}

TEST(View, SortsByOneKeyAfterTheOther) {
  View view;
  for (const char* sort : {"sensor", "noise_in", "reduction", "rate", "health"}) {
    type(view, "s");
    EXPECT_EQ(view.sort, sort);
  }
}

TEST(View, KeepsTheChosenOneOnTheScreen) {
  View view;
  type(view, "\x1b[B\x1b[B");
  EXPECT_EQ(view.chosen, 2U);
  EXPECT_EQ(view.first, 0U);
  type(view, "\x1b[6~");
  EXPECT_EQ(view.chosen, 12U);
  EXPECT_EQ(view.first, 3U);
  type(view, "\x1b[F");
  EXPECT_EQ(view.chosen, 99U);
  EXPECT_EQ(view.first, 90U);
  type(view, "\x1b[H\x1b[A");
  EXPECT_EQ(view.chosen, 0U);
  view.first = 90;
  view.chosen = 99;
  keep_in_sight(view, 5, kRows);
  EXPECT_EQ(view.chosen, 4U) << "sensors have gone";
  keep_in_sight(view, 0, kRows);
  EXPECT_EQ(view.chosen, 0U);
}

TEST(View, AsksTheApiForWhatItShows) {
  View view;
  type(view, "t/a/b &c\r");
  EXPECT_EQ(sensors_query(view, 20, 10),
            "/api/v1/channels?sort=health&offset=20&limit=10&search=a%2Fb%20%26c"
            "&health=silent,stuck,saturated,noisy,drifting,lossy,degraded");
  type(view, "t");
  EXPECT_TRUE(view.health.empty());
}

}  // namespace
}  // namespace gyrod::top
