// What must hold for the two-speed estimator on any finite input, tried with the whole loop on random mixtures of what gyros give
// and of what no gyro gives.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/noise/noise_model.hpp"
#include "unit/core/joint/joint_support.hpp"

namespace gyrod {
namespace {

using core::NoiseModel;
using namespace testing;

constexpr std::size_t kSamples = 1600;
constexpr std::size_t kLag = 16;

/// Every estimate is finite and every variance is not negative.
void expect_sane(const JointOutput& out) {
  const std::size_t smoothed = out.denoised.size() - kLag;
  EXPECT_TRUE(is_finite(out.realtime));
  EXPECT_TRUE(is_finite(out.realtime_variance));
  EXPECT_TRUE(is_finite(std::span(out.denoised).first(smoothed)));
  EXPECT_TRUE(is_finite(std::span(out.denoised_variance).first(smoothed)));
  EXPECT_GE(*std::ranges::min_element(out.realtime_variance), 0.0);
  EXPECT_GE(*std::min_element(out.denoised_variance.begin(),
                              out.denoised_variance.begin() + static_cast<std::ptrdiff_t>(smoothed)),
            0.0);
}

void expect_sane_with_any_noise(const Signal& z) {
  for (const double level : {0.0, 1e-6, 1.0, 1e6}) {
    SCOPED_TRACE(level);
    expect_sane(run_joint(z, level > 0.0 ? core::white_noise(level * level) : NoiseModel{}, kLag));
  }
}

class JointProperty : public ::testing::TestWithParam<unsigned> {
 protected:
  JointProperty() : bits_(GetParam()) {}

  double uniform() { return std::uniform_real_distribution<double>()(bits_); }
  bool chance(double probability) { return uniform() < probability; }
  std::ptrdiff_t place() { return static_cast<std::ptrdiff_t>(uniform() * static_cast<double>(kSamples)); }

  /// Tones, a wandering rate and a turn, variance about 1.
  Signal motion() {
    Signal x(kSamples);
    for (int tones = 0; tones < 2; ++tones) {
      const double frequency = 0.2 * std::pow(uniform(), 3.0);
      const double phase = 6.0 * uniform();
      x = sum(x, tone(kSamples, frequency, phase), uniform());
    }
    const double wander = 0.1 * uniform();
    double level = 0.0;
    const Signal steps = white_noise(kSamples, static_cast<unsigned>(bits_()));
    for (std::size_t t = 0; t < kSamples; ++t) x[t] += level = 0.99 * level + wander * steps[t];
    const double turn = 2.0 * uniform();
    std::for_each(x.begin() + place(), x.end(), [turn](double& value) { value += turn; });
    return x;
  }

  std::mt19937_64 bits_;
};

INSTANTIATE_TEST_SUITE_P(Random, JointProperty, ::testing::Range(1U, 41U));

TEST_P(JointProperty, IsFiniteWhateverComesIn) {
  const double ratio = std::pow(10.0, 12.0 * uniform() - 6.0);
  Signal z = sum(motion(), white_noise(kSamples, GetParam()), ratio);
  if (chance(0.4)) z = quantised(z, 0.5 * uniform() + 1e-3);
  if (chance(0.4)) z[static_cast<std::size_t>(place())] += 1e4;
  if (chance(0.3)) std::fill(z.begin() + place(), z.end(), uniform());
  if (chance(0.3)) z = sum(z, Signal(kSamples, 1.0), 1e6 * uniform());
  const double scale = std::pow(10.0, 24.0 * uniform() - 12.0);
  const double level = std::pow(10.0, 24.0 * uniform() - 12.0);
  const bool known = chance(0.5);
  SCOPED_TRACE(::testing::Message() << "ratio " << ratio << " scale " << scale << " known " << known
                                    << " level " << level);
  expect_sane(run_joint(times(z, scale), known ? core::white_noise(level * level) : NoiseModel{}, kLag));
}

// Of motion of variance about 1 in white noise of 1 to 1000 times its deviation: no worse than what came in. 1.02: the error of an
// estimate that returns its input differs from the input's by what chance leaves in 1500 samples.
TEST_P(JointProperty, IsNoWorseThanItsInputWhereNoiseDominates) {
  const Signal truth = motion();
  const double level = std::pow(10.0, 3.0 * uniform());
  const Signal z = sum(truth, white_noise(kSamples, GetParam() + 1000), level);
  const bool known = chance(0.5);
  const JointOutput out = run_joint(z, known ? core::white_noise(level * level) : NoiseModel{}, kLag);
  expect_sane(out);
  const double raw = rms_difference(z, truth, 64, kSamples - kLag);
  EXPECT_LE(rms_difference(out.realtime, truth, 64, kSamples - kLag), 1.02 * raw) << level << known;
  EXPECT_LE(rms_difference(out.denoised, truth, 64, kSamples - kLag), 1.02 * raw) << level << known;
}

// Noise a thousandth to a millionth of the motion: what is done to the motion stays below its own size by far. A tenth: a turn in one
// sample, which no member expects, and tones of 0.2 cycles per sample are in the mixture.
TEST_P(JointProperty, LeavesMotionAloneWhereThereIsHardlyNoise) {
  const Signal truth = motion();
  const double level = std::pow(10.0, -3.0 - 3.0 * uniform());
  const Signal z = sum(truth, white_noise(kSamples, GetParam() + 2000), level);
  const JointOutput out = run_joint(z, core::white_noise(level * level), kLag);
  expect_sane(out);
  EXPECT_LE(rms_difference(out.denoised, truth, 256, kSamples - kLag), 0.1);
}

TEST(JointOnHostileValues, IsFiniteForConstants) {
  for (const double value : {0.0, 1.0, -1e300, 5e-324, 1.7e308}) {
    SCOPED_TRACE(value);
    expect_sane_with_any_noise(Signal(400, value));
  }
}

TEST(JointOnHostileValues, IsFiniteForTheLargestAlternation) {
  for (const double size : {1e300, 1e160, 1e150, 1e-160, 1e-300, 5e-324}) {
    SCOPED_TRACE(size);
    Signal z(400);
    for (std::size_t t = 0; t < z.size(); ++t) z[t] = t % 2 == 0 ? size : -size;
    expect_sane_with_any_noise(z);
  }
}

TEST(JointOnHostileValues, IsFiniteForOneSpikeInSilence) {
  for (const double size : {1.0, 1e4, 1e155, 1e300}) {
    SCOPED_TRACE(size);
    Signal z(700);
    z[300] = size;
    expect_sane_with_any_noise(z);
  }
}

TEST(JointOnHostileValues, IsFiniteForAShockOfTenThousandDeviations) {
  Signal z = white_noise(1200, 7);
  for (std::size_t t = 600; t < 610; ++t) z[t] += 1e4;
  expect_sane_with_any_noise(z);
}

TEST(JointOnHostileValues, IsFiniteForValuesOfAllMagnitudes) {
  std::mt19937_64 bits(11);
  std::uniform_real_distribution<double> exponent(-307.0, 307.0);
  Signal z(600);
  for (double& value : z) value = (bits() % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, exponent(bits));
  expect_sane_with_any_noise(z);
}

// The answers recover: long after a shock they are those of an estimator that never saw it, within the noise.
TEST(JointOnHostileValues, ForgetsAShock) {
  const Signal truth = tone(4000, 0.004);
  Signal z = sum(truth, white_noise(4000, 3), 0.3);
  const JointOutput calm = run_joint(z, core::white_noise(0.09), kLag);
  for (std::size_t t = 1000; t < 1010; ++t) z[t] += 1e4;
  const JointOutput shocked = run_joint(z, core::white_noise(0.09), kLag);
  const double error = rms_difference(calm.denoised, truth, 3000, 3900);
  EXPECT_LE(rms_difference(shocked.denoised, truth, 3000, 3900), 1.2 * error);
}

}  // namespace
}  // namespace gyrod
