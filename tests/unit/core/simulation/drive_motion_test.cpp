/// The true motion: what a car can do, and nothing that jumps.
#include "core/simulation/drive_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "unit/core/simulation/simulation_support.hpp"

namespace gyrod::core {
namespace {

using Rates = std::array<double, 3>;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr std::size_t kX = 0;
constexpr std::size_t kY = 1;
constexpr std::size_t kZ = 2;

constexpr DriveOptions kSmoothRoad = {.road_vibration_radps = 0.0};

std::vector<Rates> drive(const DriveOptions& options, double rate_hz, std::size_t samples,
                         std::uint64_t seed = 1) {
  DriveMotion motion(options, rate_hz, seed);
  std::vector<Rates> rates(samples);
  for (Rates& rate : rates) rate = motion.next();
  return rates;
}

std::vector<double> axis_of(const std::vector<Rates>& rates, std::size_t axis) {
  std::vector<double> values;
  for (const Rates& rate : rates) values.push_back(rate[axis]);
  return values;
}

bool stands(const Rates& rate) { return rate == Rates{}; }

TEST(DriveMotion, RatesStayWithinWhatTheManoeuvresAllow) {
  // From the ranges in the header; the steepest slope of the quintic step over a rise T is 1.875 / T.
  constexpr double kYaw = 30.0 * kRadPerDeg;
  constexpr double kRoll = 0.09 * kYaw * 1.875 / 1.5;
  constexpr double kPitch = 1.5 * kRadPerDeg * 1.875 / 1.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    for (const Rates& rate : drive(kSmoothRoad, 100.0, 100'000, seed)) {
      ASSERT_LE(std::abs(rate[kX]), kRoll);
      ASSERT_LE(std::abs(rate[kY]), kPitch);
      ASSERT_LE(std::abs(rate[kZ]), kYaw);
    }
  }
}

TEST(DriveMotion, RatesDoNotJump) {
  constexpr double kRateHz = 1000.0;
  // The same bounds one derivative on; that of the quintic step's second derivative is 10 / sqrt(3) / T^2.
  const Rates steepest = {0.09 * 30.0 * kRadPerDeg * 10.0 / std::sqrt(3.0) / (1.5 * 1.5),
                          1.5 * kRadPerDeg * 10.0 / std::sqrt(3.0) / (1.0 * 1.0),
                          30.0 * kRadPerDeg * 1.875 / 1.5};
  const auto rates = drive(kSmoothRoad, kRateHz, 600'000);
  for (std::size_t i = 1; i < rates.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_LE(std::abs(rates[i][axis] - rates[i - 1][axis]), steepest[axis] / kRateHz) << i;
    }
  }
}

TEST(DriveMotion, TurnsBothWaysBrakesAndStands) {
  const auto rates = drive({}, 100.0, 360'000);
  const auto yaw = axis_of(rates, kZ);
  EXPECT_GT(*std::ranges::max_element(yaw), 5.0 * kRadPerDeg);
  EXPECT_LT(*std::ranges::min_element(yaw), -5.0 * kRadPerDeg);
  std::size_t longest = 0;
  std::size_t standing = 0;
  for (const Rates& rate : rates) {
    standing = stands(rate) ? standing + 1 : 0;
    longest = std::max(longest, standing);
  }
  // A stop lasts 3 to 12 s, with no vibration either.
  EXPECT_GE(longest, 300U);
  EXPECT_LE(longest, 1210U);
}

TEST(DriveMotion, PitchAndRollComeBackToWhereTheyWere) {
  constexpr double kRateHz = 100.0;
  const auto rates = drive(kSmoothRoad, kRateHz, 360'000);
  Rates angle{};
  for (const Rates& rate : rates) {
    for (std::size_t axis = 0; axis < 3; ++axis) angle[axis] += rate[axis] / kRateHz;
  }
  // At most one manoeuvre is unfinished: a dip of 1.5 deg, a roll of 0.09 s times 30 deg/s.
  EXPECT_LE(std::abs(angle[kY]), 1.6 * kRadPerDeg);
  EXPECT_LE(std::abs(angle[kX]), 2.8 * kRadPerDeg);
}

TEST(DriveMotion, VibrationHasItsStandardDeviationWhileMoving) {
  // The same seed with and without: the difference is the vibration alone.
  const auto rough = drive({}, 200.0, 200'000);
  const auto smooth = drive(kSmoothRoad, 200.0, 200'000);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> vibration;
    for (std::size_t i = 0; i < rough.size(); ++i) {
      if (!stands(rough[i])) vibration.push_back(rough[i][axis] - smooth[i][axis]);
    }
    // Braking and leaving, some percent of the time, have less of it; the sum of five sines beats slowly.
    EXPECT_NEAR(test::standard_deviation_of(vibration) / DriveOptions{}.road_vibration_radps, 1.0, 0.1);
  }
}

TEST(DriveMotion, TonesBeyondHalfTheSampleRateAreLeftOut) {
  const DriveOptions engine = {.road_vibration_radps = 0.0, .engine_tone_radps = 0.01};
  EXPECT_EQ(drive(engine, 50.0, 5000), drive(kSmoothRoad, 50.0, 5000));  // 27 Hz at 50 Hz
  EXPECT_NE(drive(engine, 60.0, 5000), drive(kSmoothRoad, 60.0, 5000));
}

}  // namespace
}  // namespace gyrod::core
