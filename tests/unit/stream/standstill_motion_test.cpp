// Noise behind a sensor's own low-pass, learned in motion until it is learned at rest.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>

#include <gtest/gtest.h>

#include "core/noise/noise_units.hpp"
#include "core/noise/still_noise.hpp"
#include "engine_support.hpp"
#include "stream/joint_method.hpp"
#include "stream/standstill_noise.hpp"
#include "support/low_passed.hpp"

namespace gyrod::stream {
namespace {

constexpr double kRadPerDeg = 0.017453292519943295;
constexpr std::size_t kHalfMinute = 12'000;
/// By two_poles(): 0.3^2 of white noise before it.
constexpr double kVariance = 0.133 * 0.09 * kRadPerDeg * kRadPerDeg;

std::vector<Sample> samples_of(const std::array<testing::Signal, 3>& rates_dps) {
  std::vector<Sample> samples(rates_dps[0].size());
  for (std::size_t n = 0; n < samples.size(); ++n) {
    samples[n].sequence = n;
    samples[n].stamp_ns = std::llround(static_cast<double>(n) * 1e9 / testing::kLowPassedHz);
    for (std::size_t axis = 0; axis < kAxes; ++axis)
      samples[n].rate_radps[axis] = kRadPerDeg * rates_dps[axis][n];
  }
  return samples;
}

std::vector<Sample> moving(std::size_t size, unsigned seed) {
  return samples_of(testing::low_passed_motion(size, seed).measured);
}

std::vector<Sample> resting(std::size_t size, unsigned seed) {
  const testing::LowPassed sensor = testing::low_passed_motion(size, seed);
  auto rates = sensor.measured;
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    rates[axis] = testing::sum(std::move(rates[axis]), sensor.truth[axis], -1.0);
  return samples_of(rates);
}

ChannelNoise after(StandstillNoise& learner, const std::vector<Sample>& samples, ChannelNoise noise = {}) {
  for (const Sample& sample : samples) {
    learner.step(sample, true, testing::kLowPassedHz);
    if (const auto update = learner.update()) noise = *update;
  }
  return noise;
}

TEST(StandstillNoiseInMotion, IsLearnedBehindALowPassWithoutRest) {
  bool told = false;
  StandstillNoise learner({.on_learned = [&told](const auto&) { told = true; }});
  const ChannelNoise noise = after(learner, moving(kHalfMinute, 1));
  ASSERT_EQ(noise.source, NoiseSource::kImf1);
  for (const core::NoiseModel& model : noise.axis)
    EXPECT_NEAR(core::noise_variance(model) / (1.04 * kVariance), 1.0, 0.15);
  EXPECT_FALSE(learner.at_rest());
  EXPECT_FALSE(told) << "it is not what is kept of rest";
}

// 18.6 s, then the noise is known.
TEST(StandstillNoiseInMotion, GivesTheSameBitsForAnyWorkersAndAnyBatching) {
  const auto input = moving(9000, 1);
  const auto run = [&input](std::size_t workers, std::size_t batch) {
    RecordingSink sink;
    EngineOptions options = small_options(workers);
    options.window_samples = 512;
    options.hop_samples = 64;
    options.learner = [](std::string_view) { return std::make_unique<StandstillNoise>(StandstillOptions{}); };
    Engine engine(options, joint_method({}), sink);
    const std::span<const Sample> all{input};
    for (std::size_t n = 0; n < all.size(); n += batch)
      engine.push("imu", all.subspan(n, std::min(batch, all.size() - n)));
    engine.stop(std::chrono::seconds{60});
    return sink.samples("imu");
  };
  const auto expected = run(0, 9000);
  ASSERT_EQ(expected.size(), input.size());
  EXPECT_LT(expected[7000].rate_std_radps[0], 0.3 * expected[8999].rate_std_radps[0]) << "then known";
  EXPECT_TRUE(same_bits(run(3, 61), expected));
}

/// A sensor without a low-pass of its own, 0.3 deg/s of white noise and on z a line of 0.2 deg/s at a fifth of the rate, that is moved.
std::vector<Sample> with_a_line(std::size_t size) {
  std::array<testing::Signal, 3> axes;
  for (unsigned axis = 0; axis < kAxes; ++axis) {
    axes[axis] = testing::times(testing::white_noise(size, 30 + axis), 0.3);
    axes[axis] = testing::sum(std::move(axes[axis]), testing::tone(size, 0.0005), 5.0);
  }
  const std::array<double, 2> line = {2.0 * 0.98 * std::cos(0.4 * std::numbers::pi), -0.98 * 0.98};
  axes[2] = testing::sum(std::move(axes[2]), testing::autoregressive(line, size, 50), 0.06);
  return samples_of(axes);
}

// Of the rest nothing is known: methods judge by the window.
TEST(StandstillNoiseInMotion, TellsALineOfAnAxis) {
  StandstillNoise learner(StandstillOptions{});
  const ChannelNoise noise = after(learner, with_a_line(5 * kHalfMinute));
  ASSERT_EQ(noise.source, NoiseSource::kImf1);
  EXPECT_EQ(noise.axis[0], core::NoiseModel{});
  EXPECT_FALSE(core::is_usable(noise.axis[2]));
  ASSERT_EQ(noise.axis[2].line_count, 1U);
  EXPECT_NEAR(noise.axis[2].line[0].cycles, 0.2, 0.003);
  EXPECT_NEAR(std::sqrt(noise.axis[2].line[0].variance) / kRadPerDeg, 0.2, 0.05);
}

TEST(StandstillNoiseInMotion, GivesWayToWhatRestTeaches) {
  StandstillNoise learner(StandstillOptions{});
  const ChannelNoise moved = after(learner, moving(kHalfMinute, 1));
  const ChannelNoise rested = after(learner, resting(3 * kHalfMinute, 2), moved);
  EXPECT_EQ(rested.source, NoiseSource::kStandstill);
  EXPECT_EQ(after(learner, moving(2 * kHalfMinute, 3), rested), rested);
}

TEST(StandstillNoiseInMotion, IsNotAskedForWhereSomethingIsKnown) {
  StandstillOptions calibrated;
  calibrated.calibrated = CalibratedNoise{testing::kLowPassedHz, {}};
  calibrated.calibrated->models.fill(core::white_noise(1.0));
  StandstillNoise knows(calibrated);
  EXPECT_EQ(after(knows, moving(kHalfMinute, 1)), ChannelNoise{}) << "nothing new";
  StandstillNoise may_not({.use_learned = false});
  EXPECT_EQ(after(may_not, moving(kHalfMinute, 1)), ChannelNoise{});
  StandstillNoise at_rest_alone({.learns_in_motion = false});
  EXPECT_EQ(after(at_rest_alone, moving(kHalfMinute, 1)), ChannelNoise{}) << "method paper asks for none";
}

TEST(StandstillNoiseInMotion, BeginsAnewAtAGapAndKeepsWhatItHas) {
  StandstillNoise learner(StandstillOptions{});
  ChannelNoise noise;
  const std::vector<Sample> minute = moving(2 * kHalfMinute, 5);
  for (auto part = minute.begin(); part != minute.end(); part += 3000) {  // 7.5 s
    learner.reset_segment();
    noise = after(learner, {part, part + 3000}, noise);
  }
  EXPECT_EQ(noise.source, NoiseSource::kNone);
  noise = after(learner, moving(kHalfMinute, 1), noise);
  ASSERT_EQ(noise.source, NoiseSource::kImf1);
  learner.reset_segment();
  EXPECT_EQ(after(learner, moving(3000, 9), noise), noise);
}

TEST(StandstillNoiseInMotion, ForgetsItAtAnotherRate) {
  StandstillNoise learner(StandstillOptions{});
  ChannelNoise noise = after(learner, moving(kHalfMinute, 1));
  ASSERT_EQ(noise.source, NoiseSource::kImf1);
  for (const Sample& sample : moving(1000, 2)) {
    learner.step(sample, true, 0.5 * testing::kLowPassedHz);
    if (const auto update = learner.update()) noise = *update;
  }
  EXPECT_EQ(noise, ChannelNoise{});
}

}  // namespace
}  // namespace gyrod::stream
