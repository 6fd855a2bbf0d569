// The two-speed estimator behind the engine's seam: what it is told, and what it keeps.
#include "stream/joint_method.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/joint/joint_fit.hpp"
#include "core/joint/kalman_bank.hpp"
#include "stream/others_noise.hpp"
#include "support/signals.hpp"

namespace gyrod::stream {
namespace {

using testing::Signal;

constexpr std::size_t kJointWindow = 512;
constexpr std::size_t kJointLag = 16;
constexpr double kJointNoise = 0.01;  // variance

/// A slow swing, a tone at 0.3 cycles per sample and noise.
Signal joint_window(unsigned seed) {
  const Signal swing = testing::times(testing::tone(kJointWindow, 0.008), 2.0);
  const Signal moved = testing::sum(swing, testing::tone(kJointWindow, 0.3), 1.0);
  return testing::sum(moved, testing::white_noise(kJointWindow, seed), std::sqrt(kJointNoise));
}

/// White noise of 0.005 and a resonance of as much at a fifth of the sample rate.
core::NoiseModel with_a_line() {
  core::NoiseModel noise = core::white_noise(0.5 * kJointNoise);
  noise.colour_order = 2;
  noise.colour = {2.0 * 0.97 * std::cos(0.4 * std::numbers::pi), -0.97 * 0.97};
  noise.colour_variance = 0.5 * kJointNoise;
  noise.colour_variance *= 0.5 * kJointNoise / (core::noise_variance(noise) - 0.5 * kJointNoise);
  return noise;
}

/// A method, a model and a filter of its, as a channel has them for an axis.
struct Axis {
  explicit Axis(double max_signal_hz = 0.0) : factory(joint_method({}, max_signal_hz)) {}

  core::WindowReport fit(const Signal& samples, double rate_hz,
                         const core::NoiseModel& noise = core::white_noise(kJointNoise)) {
    core::WindowReport report;
    method->fit({.samples = samples,
                 .sample_rate_hz = rate_hz,
                 .noise_source = NoiseSource::kCalibrated,
                 .noise = noise},
                *model, report);
    return report;
  }

  ModelMethodFactory factory;
  std::unique_ptr<ModelMethod> method = factory.method(kJointWindow, 32);
  std::unique_ptr<Model> model = factory.model(kJointWindow);
  std::unique_ptr<SampleFilter> filter = factory.filter(kJointLag);
};

/// What the axis' filter answers to these with the axis' model.
std::vector<double> answers(Axis& axis, const Signal& samples) {
  axis.filter->use(*axis.model);
  std::vector<double> all;
  for (const double sample : samples) all.push_back(axis.filter->step(sample).denoised.rate);
  return all;
}

// A body that shakes evenly at all frequencies about an axis of its own, and nothing known: no axis by itself could tell that from noise.
TEST(JointMethod, TellsShakingThatAxesShareFromNoise) {
  const ModelMethodFactory factory = joint_method({});
  const std::unique_ptr<ModelMethod> method = factory.method(kJointWindow, 32);
  const Signal shaking = testing::white_noise(kJointWindow, 77);
  std::array<Signal, kAxes> axes;
  std::array<WindowInput, kAxes> windows;
  for (unsigned axis = 0; axis < kAxes; ++axis) {
    const Signal noise =
        testing::times(testing::white_noise(kJointWindow, 78 + axis), std::sqrt(kJointNoise));
    axes[axis] = testing::sum(noise, shaking, 2.0 - axis);
    windows[axis].axis = axis;
    windows[axis].samples = axes[axis];
    windows[axis].sample_rate_hz = 100.0;
  }
  const auto noise_of = [&](std::size_t axis) {
    const std::unique_ptr<Model> model = factory.model(kJointWindow);
    core::WindowReport report;
    method->fit(windows[axis], *model, report);
    return model->noise_variance();
  };
  EXPECT_GT(noise_of(0), 100.0 * kJointNoise);  // as the windows have not been compared
  method->compare(windows);
  EXPECT_LT(noise_of(0), 10.0 * kJointNoise);  // what x is by y: twice the noise of y, and its own
  EXPECT_LT(noise_of(1), 3.0 * kJointNoise);
  EXPECT_LT(noise_of(2), 1.5 * kJointNoise);
}

// The parts do it: the limit of the signal band in cycles per sample is that in Hz over the sample rate.
TEST(JointMethod, IsTheFitAndTheBankWithTheSignalBandInCyclesPerSample) {
  for (const double rate_hz : {80.0, 200.0}) {
    Axis axis(40.0);
    axis.fit(joint_window(1), rate_hz);
    core::JointFit fit(kJointWindow);
    core::KalmanBank bank({}, kJointLag, core::SignalBandLimit::kPossible);
    core::JointModel model;
    core::WindowReport report;
    fit.set_sample_rate(rate_hz);
    fit.set_max_signal(40.0 / rate_hz);
    fit.fit(joint_window(1), core::white_noise(kJointNoise), model, report);
    bank.use(model);
    std::vector<double> expected;
    for (const double sample : joint_window(2)) expected.push_back(bank.step(sample).denoised.rate);
    EXPECT_EQ(answers(axis, joint_window(2)), expected) << rate_hz;
  }
}

// The axes of a gyro have noise of a size: at most twice the variance of the quietest.
TEST(JointMethod, TakesNoiseThatIsNotKnownForNoMoreThanTwiceTheQuietestAxiss) {
  const Signal shaking = testing::white_noise(kJointWindow, 3);
  for (const double others : {0.01, 0.1}) {
    Axis axis;
    core::WindowReport report;
    axis.method->fit({.samples = shaking, .sample_rate_hz = 120.0, .noise = {}, .others_noise = others},
                     *axis.model, report);
    EXPECT_NEAR(report.noise_floor, std::sqrt(2.0 * others), 1e-12) << others;
  }
}

// The axis that hangs was once fitted to a step of its converter.
TEST(OthersNoise, IsNotThatOfAnAxisThatHardlyChanges) {
  const Signal moving = joint_window(1);
  Signal stuck(kJointWindow, 0.5);
  stuck[100] = 0.5001;
  Signal coarse = moving;
  for (double& value : coarse) value = std::round(4.0 * value) / 4.0;
  std::array<WindowInput, kAxes> windows;
  windows[0].samples = moving;
  windows[1].samples = coarse;
  windows[2].samples = stuck;
  ASSERT_FALSE(hardly_changes(coarse));
  tell_others_noise(windows, {3.0, 2.0, 1e-9});
  EXPECT_EQ(windows[0].others_noise, 2.0);
  EXPECT_EQ(windows[1].others_noise, 3.0);
  EXPECT_EQ(windows[2].others_noise, 2.0);
  windows[2].samples = moving;
  tell_others_noise(windows, {3.0, 2.0, 0.01});
  EXPECT_EQ(windows[0].others_noise, 0.01);
  tell_others_noise(windows, {3.0, 2.0, 1e-9});
  EXPECT_EQ(windows[0].others_noise, 2.0)
      << "a simulator's plane: what has no noise says nothing of the others'";
  EXPECT_FALSE(hardly_changes({}));
}

// Nothing known, bounded by other axes; a level alone; and a colour.
TEST(JointMethod, FollowsTheNoiseAsItsFitsDo) {
  for (const core::NoiseModel& noise : {core::NoiseModel{}, core::white_noise(kJointNoise), with_a_line()}) {
    Axis fitted;
    Axis followed;
    for (unsigned seed = 1; seed < 12; ++seed) {
      const Signal samples = testing::times(joint_window(seed), 1.0 + 0.05 * seed);
      const WindowInput window{
          .samples = samples,
          .sample_rate_hz = 100.0,
          .noise_source = core::is_usable(noise) ? NoiseSource::kCalibrated : NoiseSource::kNone,
          .noise = noise,
          .others_noise = core::is_usable(noise) ? 0.0 : 0.01 * seed};
      core::WindowReport report;
      fitted.method->fit(window, *fitted.model, report);
      followed.method->follow_noise(window, *followed.model);
      EXPECT_EQ(followed.model->noise_variance(), fitted.model->noise_variance()) << seed;
    }
    EXPECT_GT(followed.model->noise_variance(), 0.0);
  }
}

// A window in which nothing changes leaves the model as it is, but for what is of another rate. It is so from a quarter of the rate on, however slowly: with stamps in bursts
// of 9 samples two estimates of one rate are 12.7 % apart.
TEST(JointMethod, KnowsNoNoiseOfAnotherRate) {
  const Signal constant(kJointWindow, 0.5);
  const auto left_at = [&constant](const std::vector<double>& rates_hz) {
    Axis axis;
    axis.fit(joint_window(1), 100.0);
    for (const double rate_hz : rates_hz) axis.fit(constant, rate_hz);
    return axis.model->noise_variance() > 0.0;
  };
  EXPECT_TRUE(left_at({0.0, 124.0, 76.0, 101.6, 88.9})) << "one rate, estimated again";
  EXPECT_FALSE(left_at({126.0}));
  EXPECT_FALSE(left_at({74.0}));
  EXPECT_FALSE(left_at({115.0, 126.0})) << "step by step";
}

TEST(JointMethod, AModelOfWindowsAtAnotherRateIsThatOfAFreshOne) {
  Axis used;
  for (unsigned seed = 1; seed < 20; ++seed) used.fit(joint_window(seed), 100.0, with_a_line());
  used.fit(joint_window(30), 200.0, with_a_line());
  Axis fresh;
  fresh.fit(joint_window(30), 200.0, with_a_line());
  EXPECT_EQ(answers(used, joint_window(31)), answers(fresh, joint_window(31)));
}

// A white part of 1e-300 beside a colour overflows in the Riccati equation: no member can be made.
TEST(JointMethod, CountsTheFallbacksOfAllModelsUntilItIsReset) {
  core::NoiseModel impossible = core::white_noise(1e-300);
  impossible.colour_order = 1;
  impossible.colour[0] = 0.5;
  impossible.colour_variance = kJointNoise;
  Axis axis;
  axis.fit(joint_window(1), 120.0);
  axis.fit(joint_window(2), 120.0, impossible);
  for (std::uint64_t times = 1; times <= 3; ++times) {
    axis.filter->use(*axis.model);
    EXPECT_EQ(axis.filter->model_fit().fallbacks, times * core::kMembers);
  }
  for (int n = 0; n < 100; ++n) axis.filter->step(1e3);
  ASSERT_TRUE(axis.filter->model_fit().misfit);
  axis.filter->reset();
  EXPECT_EQ(axis.filter->model_fit(), ModelFit{});
  axis.filter->step(0.0);
  EXPECT_EQ(axis.filter->model_fit(), ModelFit{}) << "nothing of it is left to judge by";
}

}  // namespace
}  // namespace gyrod::stream
