// Biases that were put into an exact sensor are found again.
#include "core/inertial/truth_calibration.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "support/exact_motion.hpp"

namespace gyrod::core {
namespace {

/// An ideal sensor with constant errors on a moving body, and its truth.
struct Recording {
  std::vector<double> time_s;
  std::array<std::vector<double>, 3> rate;
  std::array<std::vector<double>, 3> force;
  Truth truth;

  Recording(const SensorBias& bias, int samples) {
    testing::ExactMotion motion;
    motion.start = {0.7, 0.1, 50.0};
    motion.velocity_mps = {{{.amplitude = 1.0, .period_s = 5.0}, {.amplitude = 2.0, .period_s = 7.0}, {}}};
    motion.euler_rad = {{{.amplitude = 0.5, .period_s = 4.0},
                         {.amplitude = 0.4, .period_s = 9.0},
                         {.amplitude = 1.0, .period_s = 6.0}}};
    testing::ExactWalk walk(motion);
    for (int n = 0; n < samples; ++n) {
      time_s.push_back(0.005 * n);
      const InertialSample sample = walk.sample();
      for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = static_cast<Eigen::Index>(i);
        rate[i].push_back(sample.rate_radps[axis] + bias.gyro_radps[axis]);
        force[i].push_back(sample.specific_force_mps2[axis] + bias.accel_mps2[axis]);
      }
      truth.attitude.push_back(walk.state().attitude);
      truth.velocity_mps.push_back(walk.state().velocity_mps);
      walk.advance(0.005);
    }
    truth.time_s = time_s;
  }
  [[nodiscard]] InertialSeries series() const {
    return {time_s, {rate[0], rate[1], rate[2]}, {force[0], force[1], force[2]}};
  }
};

constexpr GeodeticPosition kPlace{0.7, 0.1, 50.0};

// The trapezoid's error over a leg, 1e-5 relative of rates of 1 rad/s, is what is left.
TEST(TruthCalibration, FindsTheBiasesOfAMovingSensor) {
  const SensorBias bias{{0.01, -0.02, 0.005}, {0.1, -0.2, 0.3}};
  const Recording recording(bias, 8000);
  const auto found = calibrated_on_truth(recording.series(), recording.truth, kPlace, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->legs, 39U);
  EXPECT_LT((found->bias.gyro_radps - bias.gyro_radps).norm(), 2e-5);
  EXPECT_LT((found->bias.accel_mps2 - bias.accel_mps2).norm(), 2e-3);
}

TEST(TruthCalibration, LeavesOutLegsThatEndInAGap) {
  const SensorBias bias{{0.01, -0.02, 0.005}, {0.1, -0.2, 0.3}};
  Recording recording(bias, 8000);
  for (std::size_t n = 3000; n < 5000; ++n)
    recording.truth.attitude[n] = Eigen::Quaterniond(NAN, NAN, NAN, NAN);
  const auto found = calibrated_on_truth(recording.series(), recording.truth, kPlace, {});
  ASSERT_TRUE(found);
  EXPECT_LT(found->legs, 30U);
  EXPECT_LT((found->bias.gyro_radps - bias.gyro_radps).norm(), 3e-5);
}

TEST(TruthCalibration, WithoutVelocityLeavesTheAccelerometerAlone) {
  Recording recording({{0.01, 0.0, 0.0}, {0.1, 0.0, 0.0}}, 2000);
  recording.truth.velocity_mps.clear();
  const auto found = calibrated_on_truth(recording.series(), recording.truth, kPlace, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->velocity_legs, 0U);
  EXPECT_EQ(found->bias.accel_mps2.norm(), 0.0);
}

TEST(TruthCalibration, WithoutAttitudeFindsNothing) {
  Recording recording({}, 2000);
  recording.truth.attitude.clear();
  EXPECT_FALSE(calibrated_on_truth(recording.series(), recording.truth, kPlace, {}));
}

}  // namespace
}  // namespace gyrod::core
