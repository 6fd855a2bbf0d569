// The interval holds the truth as often as it says: many seeds of noise whose Allan variance is known.
#include <functional>

#include <gtest/gtest.h>

#include "allan_support.hpp"

namespace gyrod {
namespace {

using namespace testing;

constexpr std::size_t kSamples = 2000;
constexpr unsigned kSeeds = 1000;

/// Part of the seeds for which the interval at cluster size m holds `truth`.
double coverage(const std::function<Signal(std::size_t, unsigned)>& noise, std::size_t m, double truth,
                double confidence) {
  int held = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const auto point = core::allan_deviation_at(noise(kSamples, seed), 1.0, std::vector{m}, confidence).at(0);
    if (point.lower <= truth && truth <= point.upper) ++held;
  }
  return static_cast<double>(held) / kSeeds;
}

// Counting 1000 seeds is good to 0.015 (68 %) and 0.007 (95 %) standard; 0.05 and 0.03 are three of that and a
// little for the noise being identified anew in every record.
constexpr double kTolerance68 = 0.05;
constexpr double kTolerance95 = 0.03;

// White noise of variance 1 has sigma^2 = 1/m.
TEST(ConfidenceInterval, HoldsForWhiteNoise) {
  for (const std::size_t m : {1U, 10U, 60U, 200U}) {
    const double truth = std::sqrt(1.0 / static_cast<double>(m));
    EXPECT_NEAR(coverage(white_noise, m, truth, 0.6827), 0.6827, kTolerance68) << m;
    EXPECT_NEAR(coverage(white_noise, m, truth, 0.95), 0.95, kTolerance95) << m;
  }
}

// A sum of unit steps has sigma^2 = (2 m^2 + 1) / (6 m): the variance of the difference of two adjacent means.
TEST(ConfidenceInterval, HoldsForRandomWalk) {
  for (const std::size_t m : {1U, 10U, 60U, 200U}) {
    const auto size = static_cast<double>(m);
    const double truth = std::sqrt((2.0 * size * size + 1.0) / (6.0 * size));
    EXPECT_NEAR(coverage(random_walk, m, truth, 0.6827), 0.6827, kTolerance68) << m;
    EXPECT_NEAR(coverage(random_walk, m, truth, 0.95), 0.95, kTolerance95) << m;
  }
}

// The angle x is white with variance 1: z_k has variance 6, sigma^2 = 3/m^2. With 33 clusters left it is often taken
// for white noise, whose interval is wider.
TEST(ConfidenceInterval, HoldsForQuantizationNoise) {
  for (const std::size_t m : {1U, 10U}) {
    const double truth = std::sqrt(3.0) / static_cast<double>(m);
    EXPECT_NEAR(coverage(differenced_noise, m, truth, 0.6827), 0.6827, kTolerance68) << m;
  }
  EXPECT_GE(coverage(differenced_noise, 60, std::sqrt(3.0) / 60.0, 0.6827), 0.6827 - kTolerance68);
}

}  // namespace
}  // namespace gyrod
