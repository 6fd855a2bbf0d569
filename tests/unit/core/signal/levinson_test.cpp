#include "core/signal/levinson.hpp"

#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

using ::testing::Each;

// AR(2) x = a x[-1] + b x[-2] + w: r_1 / r_0 = a / (1 - b), r_2 = a r_1 + b r_0 (Box, Jenkins, section 3.2.4).
constexpr double kA = 1.2;
constexpr double kB = -0.5;
constexpr std::array<double, 4> kAutocovariance = {1.0, 0.8, 0.46, 0.152};

TEST(Levinson, FindsTheModelWhoseAutocovariancesAreGiven) {
  std::array<double, 2> a{};
  const double w = levinson(std::span(kAutocovariance).first(3), a);
  EXPECT_NEAR(a[0], kA, 1e-14);
  EXPECT_NEAR(a[1], kB, 1e-14);
  EXPECT_NEAR(w, 1.0 - kA * 0.8 - kB * 0.46, 1e-14);
}

TEST(Levinson, GivesZeroBeyondTheTrueOrder) {
  std::array<double, 3> a{};
  levinson(kAutocovariance, a);
  EXPECT_NEAR(a[2], 0.0, 1e-14);
}

TEST(Levinson, GivesNoModelOfASeriesWithoutVariance) {
  std::array<double, 2> a = {7.0, 7.0};
  EXPECT_EQ(levinson(std::array<double, 3>{0.0, 0.0, 0.0}, a), 0.0);
  EXPECT_THAT(a, Each(0.0));
}

TEST(Levinson, StopsWhereTheSeriesIsPredictable) {
  // A cosine: r_l = cos(w l) is predicted without error by two terms, a = (2 cos w, -1).
  std::array<double, 5> r{};
  for (std::size_t l = 0; l < r.size(); ++l) r[l] = std::cos(0.3 * static_cast<double>(l));
  std::array<double, 4> a{};
  const double w = levinson(r, a);
  EXPECT_LT(std::abs(w), 1.0);
  for (const double value : a) EXPECT_TRUE(std::isfinite(value));
}

TEST(ArVarianceGain, IsVarianceOverInnovationVariance) {
  const double w = 1.0 - kA * 0.8 - kB * 0.46;
  EXPECT_NEAR(ar_variance_gain(std::array{kA, kB}), 1.0 / w, 1e-12);
  EXPECT_EQ(ar_variance_gain({}), 1.0);
  EXPECT_NEAR(ar_variance_gain(std::array{0.9}), 1.0 / (1.0 - 0.81), 1e-12);
}

TEST(ArVarianceGain, IsInfiniteForAnUnstableModel) {
  EXPECT_TRUE(std::isinf(ar_variance_gain(std::array{1.0})));
  EXPECT_TRUE(std::isinf(ar_variance_gain(std::array{0.3, 1.1})));
}

}  // namespace
}  // namespace gyrod::core
