// Lines of the five slopes.
#include <gtest/gtest.h>

#include "allan_support.hpp"

namespace gyrod {
namespace {

using namespace testing;
using core::slope_coefficients;

// A curve of one term is that line: identity.
TEST(SlopeMethod, ReadsEachTermOfItsOwnLine) {
  for (std::size_t t = 0; t < core::kNoiseTerms; ++t) {
    Five truth{};
    truth[t] = 0.5;
    const auto found = slope_coefficients(exact_curve(truth, 100.0, 1'000'000));
    for (std::size_t other = 0; other < core::kNoiseTerms; ++other) {
      EXPECT_EQ(found.terms[other].observable, other == t) << t << " " << other;
    }
    EXPECT_NEAR(found.terms[t].value, 0.5, 1e-12);
  }
}

// The floor of white noise and random walk alone is level over a sixth of a decade only: no bias instability.
TEST(SlopeMethod, DoesNotTakeATurningPointForAFloor) {
  const auto found = slope_coefficients(exact_curve({0.0, 0.01, 0.0, 1e-3, 0.0}, 100.0, 10'000'000));
  EXPECT_TRUE(found[kN].observable);
  EXPECT_TRUE(found[kK].observable);
  EXPECT_FALSE(found[kB].observable);
}

// What adds to a line is not taken off: above the truth, by less than the slope's tolerance allows.
TEST(SlopeMethod, ReadsTooHighWhereTermsAdd) {
  const Five truth = {0.0, 4e-2, 9e-3, 6e-4, 0.0};
  const auto found = slope_coefficients(exact_curve(truth, 100.0, 100'000'000));
  EXPECT_GT(found[kN].value, truth[1]);
  EXPECT_NEAR(found[kN].value, truth[1], 0.1 * truth[1]);
  EXPECT_GT(found[kK].value, truth[3]);
  EXPECT_NEAR(found[kK].value, truth[3], 0.1 * truth[3]);
}

TEST(SlopeMethod, LeavesOutTimesWithFewDegreesOfFreedom) {
  auto points = exact_curve({0.0, 0.0, 0.0, 1e-3, 0.0}, 100.0, 1'000'000);
  for (auto& point : points) point.edf = 5.0;
  for (const auto& term : slope_coefficients(points).terms) EXPECT_FALSE(term.observable);
  EXPECT_FALSE(slope_coefficients({})[kN].observable);
}

}  // namespace
}  // namespace gyrod
