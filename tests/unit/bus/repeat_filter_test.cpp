#include "bus/repeat_filter.hpp"

#include <gtest/gtest.h>

namespace gyrod::bus::test {
namespace {

using std::chrono::seconds;
using Clock = RepeatFilter::Clock;

TEST(RepeatFilterTest, AMessagePassesAtFirstAndThenOnceAMinuteWithHowOftenItCame) {
  RepeatFilter filter;
  const Clock::time_point begin{};
  EXPECT_EQ(filter.pass("refused", begin), "refused");
  for (int second = 1; second < 60; ++second)
    EXPECT_EQ(filter.pass("refused", begin + seconds(second)), std::nullopt);
  EXPECT_EQ(filter.pass("refused", begin + seconds(60)), "refused (59 times more since)");
  EXPECT_EQ(filter.pass("refused", begin + seconds(61)), std::nullopt);
}

TEST(RepeatFilterTest, DifferentMessagesDoNotHoldEachOtherBack) {
  RepeatFilter filter;
  EXPECT_EQ(filter.pass("one", {}), "one");
  EXPECT_EQ(filter.pass("other", {}), "other");
}

TEST(RepeatFilterTest, AMessageIsNewsAgainAfterAQuietTime) {
  RepeatFilter filter;
  EXPECT_EQ(filter.pass("refused", {}), "refused");
  EXPECT_EQ(filter.pass("refused", Clock::time_point{} + seconds(121)), "refused");
}

TEST(RepeatFilterTest, AFloodOfDifferentMessagesBecomesOne) {
  RepeatFilter filter;
  std::size_t passed = 0;
  for (int i = 0; i < 10'000; ++i) passed += filter.pass("message " + std::to_string(i), {}).has_value();
  EXPECT_EQ(passed, RepeatFilter::kMostTexts + 1);
}

}  // namespace
}  // namespace gyrod::bus::test
