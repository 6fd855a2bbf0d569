#include "core/joint/joint_fit.hpp"

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "support/allocation_counter.hpp"
#include "unit/core/joint/joint_support.hpp"
#include "unit/core/joint/line_support.hpp"

namespace gyrod {
namespace {

using core::JointFit;
using core::JointModel;
using core::MemberModel;
using core::NoiseModel;
using core::WindowReport;
using testing::JointOutput;
using testing::Signal;

constexpr std::size_t kWindow = 1024;

/// A swing, a slow turn, and noise of variance 0.09.
Signal window(unsigned seed = 1, std::size_t size = kWindow) {
  Signal x = testing::times(testing::tone(size, 0.01), 2.0);
  x = testing::sum(x, testing::tone(size, 0.0007), 5.0);
  return testing::sum(x, testing::white_noise(size, seed), 0.3);
}

JointModel fitted(const Signal& z, const NoiseModel& noise) {
  JointFit fit(kWindow);
  JointModel model;
  WindowReport report;
  fit.fit(z, noise, model, report);
  return model;
}

void expect_same(const MemberModel& a, const MemberModel& b, double factor = 1.0) {
  EXPECT_EQ(a.usable, b.usable);
  EXPECT_EQ(a.states, b.states);
  EXPECT_EQ(a.gain, b.gain);
  EXPECT_EQ(a.smoothing, b.smoothing);
  EXPECT_EQ(a.innovation_variance * factor, b.innovation_variance);
  EXPECT_EQ(a.prediction_variance * factor, b.prediction_variance);
}

// White noise holds no motion: of its deviation of 1 a twelfth is left. The windowed fit finds chance peaks, which is what remains.
TEST(JointFit, WhiteNoiseGivesAQuietOutput) {
  const Signal z = testing::white_noise(6000, 1);
  const JointOutput out = testing::run_joint(z, core::white_noise(1.0), 16, kWindow);
  const Signal nothing(z.size());
  EXPECT_LT(testing::rms_difference(out.denoised, nothing, 1200, 5900), 0.3);
  EXPECT_LT(testing::rms_difference(out.realtime, nothing, 1200, 5900), 0.35);
  EXPECT_EQ(out.fallbacks, 0U);
}

TEST(JointFit, TakesNoiseThatIsNotKnownForNoMoreThanItIsTold) {
  const Signal z = testing::white_noise(kWindow, 3);
  JointModel model;
  WindowReport report;
  JointFit fit(kWindow);
  fit.set_most_noise(0.25);
  fit.fit(z, {}, model, report);
  EXPECT_NEAR(report.noise_floor, 0.5, 1e-12);
  fit.fit(z, core::white_noise(1.0), model, report);
  EXPECT_GT(report.noise_floor, 0.9) << "known noise is known";
}

TEST(JointFit, TakesTheNoiseOffASwing) {
  const Signal truth = testing::times(testing::tone(4000, 0.005), 3.0);
  const Signal z = testing::sum(truth, testing::white_noise(4000, 2), 0.5);
  const JointOutput out = testing::run_joint(z, core::white_noise(0.25), 16, kWindow);
  EXPECT_LT(testing::rms_difference(out.denoised, truth, 1200, 3900), 0.2);
  EXPECT_LT(testing::rms_difference(out.realtime, truth, 1200, 3900), 0.3);
}

// Residuals are noise, unless the user or a moved line of the noise says that motion is left out.
TEST(JointFit, KnowsWhatResidualsMayBe) {
  const Signal z = testing::sum(testing::white_noise(kWindow, 3), testing::tone(kWindow, 0.2), 2.0);
  JointModel model;
  WindowReport report;
  JointFit fit(kWindow);
  fit.fit(z, core::white_noise(1.0), model, report);
  EXPECT_DOUBLE_EQ(model.residual_variance, model.noise_variance);
  fit.set_max_signal(0.1);
  fit.fit(z, core::white_noise(1.0), model, report);
  EXPECT_EQ(model.residual_variance, std::numeric_limits<double>::infinity());
  fit.set_max_signal(1.0);
  // Of four times the tone's power, and nearly where the tone is: all of the tone may be the rest of it.
  fit.fit(z, testing::noise_with_line(0.22, 8.0), model, report);
  EXPECT_GT(model.residual_variance, 1.05 * model.noise_variance);
}

// The tone is the only thing there.
TEST(JointFit, KnowsHowMuchLiesBeyondTheSignalBand) {
  const Signal z = testing::sum(testing::white_noise(kWindow, 3), testing::tone(kWindow, 0.2), 2.0);
  const auto beyond = [&z](double max_signal_cycles) {
    JointModel model;
    WindowReport report;
    JointFit fit(kWindow);
    fit.set_max_signal(max_signal_cycles);
    fit.fit(z, core::white_noise(1.0), model, report);
    return model.beyond_band_variance;
  };
  EXPECT_NEAR(beyond(0.1), 2.0, 0.2) << "half the square of its amplitude";
  EXPECT_LT(beyond(0.3), 0.1);
  EXPECT_EQ(beyond(0.5), 0.0);
}

// Thirty times the noise, and all of it unwanted. The corrections give back what estimates leave out: they took a twelfth of the tone for that.
TEST(JointFit, AToneAboveTheSignalBandDoesNotComeBack) {
  constexpr double kTone = 0.0775;
  constexpr double kAmplitude = 3.0;
  const Signal truth = testing::times(testing::tone(8000, 0.005), 2.0);
  Signal z = testing::sum(truth, testing::white_noise(8000, 4), 0.1);
  z = testing::sum(z, testing::tone(8000, kTone), kAmplitude);
  const JointOutput out =
      testing::run_joint(z, core::white_noise(0.01), 16, core::JointFit::kMinSamples, 0.05);
  const auto left = [&truth](const Signal& answer) {
    std::complex<double> sum = 0.0;
    for (std::size_t t = 2000; t < 7900; ++t)
      sum +=
          (answer[t] - truth[t]) * std::polar(1.0, -2.0 * std::numbers::pi * kTone * static_cast<double>(t));
    return 2.0 * std::abs(sum) / 5900.0;
  };
  EXPECT_LT(left(out.denoised), 0.01 * kAmplitude);
  EXPECT_LT(left(out.realtime), 0.02 * kAmplitude);
  EXPECT_LT(testing::rms_difference(out.denoised, truth, 2000, 7900), 0.1);
}

// Nothing can be told from a sensor that is stuck.
TEST(JointFit, AConstantWindowLeavesTheModelAlone) {
  JointFit fit(kWindow);
  WindowReport report;
  JointModel model;
  fit.fit(window(), {}, model, report);
  ASSERT_TRUE(model.usable());
  const JointModel before = model;
  model.fallbacks = 2;
  fit.fit(Signal(kWindow, 3.0), {}, model, report);
  EXPECT_EQ(model.fallbacks, 0U) << "of the window before";
  EXPECT_EQ(model.mean, before.mean);
  for (std::size_t i = 0; i < core::kMembers; ++i) expect_same(model.members[i], before.members[i]);
  EXPECT_EQ(report.mean, 3.0);
  EXPECT_EQ(report.imf_count, 0U);
}

// Powers of two scale every number exactly, so that not one bit of a gain may differ.
TEST(JointFit, ScalingByAPowerOfTwoScalesTheVariancesOnly) {
  const Signal z = window();
  for (const bool known : {true, false}) {
    const JointModel plain = fitted(z, known ? core::white_noise(0.09) : NoiseModel{});
    ASSERT_TRUE(plain.usable());
    for (const double factor : {0x1p-20, 0x1p30}) {
      const NoiseModel noise = known ? core::white_noise(0.09 * factor * factor) : NoiseModel{};
      const JointModel scaled = fitted(testing::times(z, factor), noise);
      EXPECT_EQ(scaled.mean, plain.mean * factor);
      for (std::size_t i = 0; i < core::kMembers; ++i) {
        expect_same(plain.members[i], scaled.members[i], factor * factor);
      }
    }
  }
}

// The blocks are in parts of the noise's variance, the variances of a member in the data's unit.
TEST(JointFit, MembersAreDesignedForTheirBlocks) {
  constexpr double kVariance = 0.09;
  const JointModel model = fitted(window(), core::white_noise(kVariance));
  for (const MemberModel& member : model.members) {
    MemberModel again;
    const NoiseModel noise = core::noise_of(model.noise.shape());
    ASSERT_TRUE(core::MemberDesigner().design(member.blocks, noise.white_variance, again));
    EXPECT_NEAR(member.innovation_variance, again.innovation_variance * kVariance, 1e-9);
    EXPECT_NEAR(member.prediction_variance, again.prediction_variance * kVariance, 1e-9);
  }
}

// A white part of 1e-300 beside a colour of 1 overflows in the Riccati equation.
TEST(JointFit, AMemberThatFailsKeepsWhatItHad) {
  JointFit fit(kWindow);
  WindowReport report;
  JointModel model;
  fit.fit(window(1), core::white_noise(0.09), model, report);
  ASSERT_EQ(model.fallbacks, 0U);
  const JointModel before = model;
  NoiseModel impossible = core::white_noise(1e-300);
  impossible.colour_order = 1;
  impossible.colour[0] = 0.5;
  impossible.colour_variance = 0.09;
  fit.fit(window(2), impossible, model, report);
  EXPECT_EQ(model.fallbacks, core::kMembers);
  EXPECT_TRUE(model.usable());
  for (std::size_t i = 0; i < core::kMembers; ++i) expect_same(model.members[i], before.members[i]);
  fit.fit(window(3), core::white_noise(0.09), model, report);
  EXPECT_EQ(model.fallbacks, 0U) << "of this window";
}

TEST(JointFit, AUsedObjectGivesTheBitsOfAFreshOne) {
  JointFit used(kWindow);
  WindowReport report;
  for (const std::size_t size : {64U, 1000U, 1024U}) {
    JointModel other;
    used.fit(window(3, size), {}, other, report);
    JointModel model;
    used.fit(window(4, size), core::white_noise(0.09), model, report);
    const JointModel fresh = fitted(window(4, size), core::white_noise(0.09));
    for (std::size_t i = 0; i < core::kMembers; ++i) expect_same(model.members[i], fresh.members[i]);
  }
}

TEST(JointFit, WindowsOfOneRateLeaveNoTraceInThoseOfAnother) {
  JointFit used(kWindow);
  WindowReport report;
  JointModel fast;
  JointModel model;
  used.set_sample_rate(400.0);
  used.fit(window(), core::white_noise(0.09), fast, report);
  used.set_sample_rate(core::kDesignRateHz);
  used.fit(window(), core::white_noise(0.09), model, report);
  const JointModel fresh = fitted(window(), core::white_noise(0.09));
  for (std::size_t i = 0; i < core::kMembers; ++i) expect_same(model.members[i], fresh.members[i]);
  EXPECT_EQ(model.scale, core::JointScale());
  EXPECT_NE(fast.member(core::MemberKind::kFull).gain, model.member(core::MemberKind::kFull).gain);
}

// The agile blocks are driven by their part of the full member's innovation variance; 480 Hz is four times the design's rate.
TEST(JointFit, AFasterSensorGetsSlowerAgileMembers) {
  constexpr double kVariance = 0.09;
  JointFit fit(kWindow);
  WindowReport report;
  JointModel model;
  fit.set_sample_rate(480.0);
  fit.fit(window(), core::white_noise(kVariance), model, report);
  const double innovation = model.member(core::MemberKind::kFull).innovation_variance / kVariance;
  const core::JointOptions options;
  for (const core::MemberKind kind : {core::MemberKind::kLevel, core::MemberKind::kSlope}) {
    EXPECT_NEAR(model.member(kind).blocks.all().back().drive, options.agile_drive * innovation / 16.0, 1e-12);
  }
  EXPECT_EQ(model.scale, core::JointScale(480.0, kWindow));
}

TEST(JointFit, ReportsTheNoiseAndTheMean) {
  JointFit fit(kWindow);
  WindowReport report;
  JointModel model;
  const Signal z = testing::sum(window(), Signal(kWindow, 1.0), 7.0);
  fit.fit(z, core::white_noise(0.09), model, report);
  EXPECT_NEAR(report.noise_floor, 0.3 * std::sqrt(model.noise.level()), 1e-12);
  EXPECT_EQ(report.mean, model.mean);
  EXPECT_EQ(report.window_samples, kWindow);
  EXPECT_GT(report.imf_count, 3U);
}

// A new model moves the answer no more than a sample does: steps at hand-overs have the size of all others.
TEST(JointFit, HandOversDoNotShowInTheOutput) {
  constexpr std::size_t kSize = 8000;
  Signal truth = testing::times(testing::tone(kSize, 0.003), 3.0);
  const std::vector<double> wander = {1.8, -0.82};
  truth = testing::sum(truth, testing::autoregressive(wander, kSize, 5), 0.05);
  const Signal z = testing::sum(truth, testing::white_noise(kSize, 6), 0.3);
  const JointOutput out = testing::run_joint(z, core::white_noise(0.09), 16, kWindow);
  double at_hand_over = 0.0;
  double elsewhere = 0.0;
  std::size_t hand_overs = 0;
  std::size_t large = 0;
  for (std::size_t t = 1200; t < kSize - 16; ++t) {
    if (t % 32 != 0) elsewhere += std::pow(out.realtime[t] - out.realtime[t - 1], 2) / (6784.0 * 31.0 / 32.0);
  }
  for (std::size_t t = 1216; t < kSize - 16; t += 32, ++hand_overs) {
    const double step = std::pow(out.realtime[t] - out.realtime[t - 1], 2);
    at_hand_over += step;
    large += step > 9.0 * elsewhere ? 1 : 0;
  }
  // Of normal steps 0.3 % exceed three deviations; 5 % leaves room for what a model does change.
  EXPECT_LT(static_cast<double>(large), 0.05 * static_cast<double>(hand_overs));
  EXPECT_LT(at_hand_over / static_cast<double>(hand_overs), 2.25 * elsewhere);
}

TEST(JointFit, AllocatesNothingAfterConstruction) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "sanitizers bring their own heap";
  const Signal z = window();
  JointFit fit(kWindow);
  WindowReport report;
  JointModel model;
  model.lasting.make_room(core::RecencyTapers::bins(kWindow));
  const auto before = testing::allocations();
  fit.fit(z, core::white_noise(0.09), model, report);
  fit.fit(std::span(z).first(500), {}, model, report);
  fit.fit(z, testing::noise_with_line(0.2, 0.5), model, report);
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_TRUE(model.usable());
}

}  // namespace
}  // namespace gyrod
