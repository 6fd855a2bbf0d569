#include "report/stillness.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "unit/report/noise.hpp"

namespace gyrod::report {
namespace {

TEST(Stillness, OfWhiteNoiseIsOneOverTheRootOfTheSamplesInASecond) {
  const auto x = testing::white_noise(100'000, 0.3, 2, 5.0);
  const Stillness found = stillness(x, 100.0);
  EXPECT_NEAR(found.sample_noise, 0.3, 0.3 * 0.01);  // 4 standard errors: sqrt(3/(4 N)) = 0.0027
  EXPECT_NEAR(found.slow_motion, 0.03, 0.03 * 0.1);  // 1000 means: 4 standard errors, 1/sqrt(2000) = 0.022
  EXPECT_TRUE(found.still());
}

TEST(Stillness, ATurningSensorIsNotStill) {
  auto x = testing::white_noise(6000, 0.3, 3);
  for (std::size_t n = 0; n < x.size(); ++n) {
    x[n] += 5.0 * std::sin(2.0 * std::numbers::pi * 0.05 * static_cast<double>(n) / 100.0);
  }
  EXPECT_FALSE(stillness(x, 100.0).still());
}

TEST(Stillness, AConstantOrEmptyOrTinyRecordIsStill) {
  EXPECT_TRUE(stillness({}, 100.0).still());
  EXPECT_TRUE(stillness(std::vector<double>(5, 2.0), 100.0).still());
  EXPECT_TRUE(stillness(std::vector<double>(500, 2.0), 100.0).still());
}

TEST(Stillness, ARecordShorterThanASecondIsJudgedByTenthsOfIt) {
  EXPECT_TRUE(stillness(testing::white_noise(50, 1.0, 4), 100.0).still());
  std::vector<double> ramp(50);
  for (std::size_t n = 0; n < ramp.size(); ++n) ramp[n] = static_cast<double>(n);
  EXPECT_FALSE(stillness(ramp, 100.0).still());
}

}  // namespace
}  // namespace gyrod::report
