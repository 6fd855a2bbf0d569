#include "core/evaluation/guards.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "core/evaluation/rivals.hpp"
#include "core/evaluation/statistics.hpp"
#include "evaluation_support.hpp"

namespace gyrod::core {
namespace {

using Change = std::function<void(std::vector<double>&)>;

/// A drive that turns slowly, with white noise: 3 min at 100 Hz.
struct Drive {
  std::vector<double> truth = test::sum_of(test::tone(18'000, 0.0013, 8.0), test::tone(18'000, 0.0101, 2.0));
  std::vector<double> noisy = test::sum_of(truth, test::white_noise(18'000, 0.3, 1));

  [[nodiscard]] GuardCase guard_case() const { return {noisy, truth, {500, 17'500}, 100.0}; }
};

/// Zero-phase low-pass at 40 Hz, which keeps everything that guards ask for, and then a defect.
Method method_with(const Change& defect, std::size_t lag = 16) {
  const auto run = [defect, lag](std::span<const double> noisy) {
    Contender contender;
    contender.name = "test";
    contender.lag_samples = lag;
    contender.estimate = rival_estimate({Rival::kZeroPhase2, 0.45}, noisy);
    contender.seams = SeamPattern{32, 16};
    defect(contender.estimate);
    return contender;
  };
  return {"test", lag, run};
}

Guard guard_on(const GuardCase& on, GuardKind kind, const Change& defect, std::size_t lag = 16) {
  const Method method = method_with(defect, lag);
  const auto all = guards(method, method.run(on.noisy_dps), on);
  return *std::ranges::find(all, kind, &Guard::kind);
}

Guard guard_of(GuardKind kind, const Change& defect, std::size_t lag = 16) {
  const Drive drive;
  return guard_on(drive.guard_case(), kind, defect, lag);
}

void none(std::vector<double>&) {}

TEST(Guards, PassAnEstimatorWithoutDefect) {
  const Drive drive;
  const Method method = method_with(none);
  const auto all = guards(method, method.run(drive.noisy), drive.guard_case());
  ASSERT_EQ(all.size(), 9U);
  for (const Guard& guard : all) {
    EXPECT_EQ(guard.verdict, Verdict::kPass) << name_of(guard.kind) << ' ' << guard.value.value_or(-1.0);
  }
}

TEST(Guards, FailOneThatShrinksByThreePercent) {
  const Change shrink = [](std::vector<double>& x) {
    for (double& value : x) value *= 0.97;
  };
  for (const GuardKind kind : {GuardKind::kSlowTurnGain, GuardKind::kSwingGain, GuardKind::kScaleFactor}) {
    const Guard guard = guard_of(kind, shrink);
    EXPECT_EQ(guard.verdict, Verdict::kFail) << name_of(kind);
    EXPECT_NEAR(*guard.value, 0.97, 0.003) << name_of(kind);
  }
}

// Half of 20 deg/s at 1.5 Hz is lost. A mean over a second has (2 / 3 pi)^2 / 2 of its square, whatever the phase, beside nearly all of 8 deg/s at
// 0.13 Hz: sinc^2 of either. Means of seconds that follow each other would all have the same phase, and twice as much of it.
TEST(Guards, SeeMotionFasterThanASecondAtAllPhases) {
  Drive drive;
  const auto swing = test::tone(18'000, 0.015, 20.0);
  drive.truth = test::sum_of(drive.truth, swing);
  drive.noisy = test::sum_of(drive.noisy, swing);
  const Method method = method_with([&swing](std::vector<double>& x) {
    for (std::size_t t = 0; t < x.size(); ++t) x[t] -= 0.5 * swing[t];
  });
  const auto all = guards(method, method.run(drive.noisy), drive.guard_case());
  const auto power = [](double amplitude, double cycles) {
    const double angle = std::numbers::pi * cycles;
    return 0.5 * std::pow(amplitude * std::sin(angle) / angle, 2);
  };
  const double fast = power(20.0, 1.5);
  const double expected = 1.0 - 0.5 * fast / (fast + power(8.0, 0.13) + power(2.0, 1.01));
  EXPECT_NEAR(std::ranges::find(all, GuardKind::kScaleFactor, &Guard::kind)->value.value_or(0.0), expected,
              0.01);
}

TEST(Guards, FailOneThatIsLateByASample) {
  const Change shift = [](std::vector<double>& x) { std::rotate(x.rbegin(), x.rbegin() + 1, x.rend()); };
  const Guard guard = guard_of(GuardKind::kDelay, shift);
  EXPECT_EQ(guard.verdict, Verdict::kFail);
  EXPECT_NEAR(*guard.value, 1.0, 0.1);
  EXPECT_EQ(guard_of(GuardKind::kDelay, none).verdict, Verdict::kPass);
}

// Of motion as slow as the drive's and an answer with ten times its noise nobody can say whether it is late by half a sample.
TEST(Guards, DoNotJudgeADelayThatIsTooUncertain) {
  const auto noise = test::white_noise(18'000, 30.0, 2);
  const Change drown = [&noise](std::vector<double>& x) {
    for (std::size_t t = 0; t < x.size(); ++t) x[t] += noise[t];
  };
  const Guard guard = guard_of(GuardKind::kDelay, drown);
  EXPECT_EQ(guard.verdict, Verdict::kNotApplicable);
  EXPECT_GT(guard.standard_error.value_or(0.0), 0.25);
  EXPECT_FALSE(guard.reason.empty());
}

// Gains of 0.96 and 1.04 by turns, 10 s each: 1 +- 0.01 in the mean, of which nobody can say whether it is within 0.01.
TEST(Guards, DoNotJudgeAGainThatIsTooUncertain) {
  const Change swell = [](std::vector<double>& x) {
    for (std::size_t t = 0; t < x.size(); ++t) x[t] *= (t + 500) / 1000 % 2 == 0 ? 0.96 : 1.04;
  };
  const Guard guard = guard_of(GuardKind::kSlowTurnGain, swell);
  EXPECT_EQ(guard.verdict, Verdict::kNotApplicable) << *guard.value;
  EXPECT_NEAR(guard.standard_error.value_or(0.0), 0.01, 0.002);
  EXPECT_FALSE(guard.reason.empty());
}

TEST(Guards, OnlyStateTheDelayOfOneThatAnswersAtOnce) {
  const Guard guard = guard_of(GuardKind::kDelay, none, 0);
  EXPECT_EQ(guard.verdict, Verdict::kNotApplicable);
  EXPECT_NEAR(*guard.value, 0.0, 0.1);
}

TEST(Guards, FailOneThatMovesTheMean) {
  const Change move = [](std::vector<double>& x) {
    for (double& value : x) value += 0.02;
  };
  // Standard error of the mean: 0.3 / sqrt(17 000) = 0.0023.
  const Guard guard = guard_of(GuardKind::kMeanPreserved, move);
  EXPECT_EQ(guard.verdict, Verdict::kFail);
  EXPECT_NEAR(*guard.value, 0.02 / 0.0023, 2.0);
}

TEST(Guards, FailOneWithStepsAtItsSeams) {
  const Change steps = [](std::vector<double>& x) {
    for (std::size_t t = 0; t < x.size(); ++t) x[t] += (t + 16) / 32 % 2 == 0 ? 1.0 : -1.0;
  };
  EXPECT_EQ(guard_of(GuardKind::kSeamRoughness, steps).verdict, Verdict::kFail);
  EXPECT_EQ(guard_of(GuardKind::kSeamOutliers, steps).verdict, Verdict::kFail);
  EXPECT_EQ(guard_of(GuardKind::kSeamWorstStep, steps).verdict, Verdict::kFail);
}

TEST(Guards, DoNotTakeKnocksForSeams) {
  // Twelve knocks, each at this place of its hop; seams are at 16.
  const auto knocks_at = [](const std::array<std::size_t, 12>& places) {
    return [places](std::vector<double>& x) {
      for (std::size_t k = 0; k < places.size(); ++k) x[32 * (30 + 40 * k) + places[k]] += 20.0;
    };
  };
  const Guard chance =
      guard_of(GuardKind::kSeamRoughness, knocks_at({16, 16, 22, 22, 22, 3, 5, 8, 11, 26, 29, 31}));
  EXPECT_GT(*chance.value, 1.2);
  EXPECT_EQ(chance.verdict, Verdict::kPass) << "elsewhere there are more in one place";
  const Guard more =
      guard_of(GuardKind::kSeamRoughness, knocks_at({16, 16, 16, 16, 16, 16, 22, 22, 3, 8, 26, 29}));
  EXPECT_EQ(more.verdict, Verdict::kFail) << "nowhere else are nearly as many";
}

TEST(Guards, FailOneWithASingleLargeStepAtASeam) {
  const Change step = [](std::vector<double>& x) {
    for (std::size_t t = 32 * 200 + 16; t < x.size(); ++t) x[t] += 5.0;
  };
  EXPECT_EQ(guard_of(GuardKind::kSeamWorstStep, step).verdict, Verdict::kFail);
}

// Taps of the motion that fall where windows meet. Knocks of 20 have squared second differences of 6 * 400 in all.
TEST(Guards, DoNotTakeTheRoughnessOfTheMotionForTheMethods) {
  const auto tapped = [](std::vector<double>& x) {
    for (std::size_t k = 0; k < 12; ++k) x[32 * (30 + 40 * k) + 16] += 20.0;
  };
  const auto stepped = [](std::vector<double>& x) {
    for (std::size_t t = 0; t < x.size(); ++t) x[t] += (t + 16) / 32 % 2 == 0 ? 1.0 : -1.0;
  };
  const auto roughness = [](const Drive& drive, const Change& defect) {
    const Method method = method_with(none);
    Contender plain = method.run(drive.noisy);
    plain.estimate = drive.noisy;
    defect(plain.estimate);
    const auto all = guards(method, plain, drive.guard_case());
    return *std::ranges::find(all, GuardKind::kSeamRoughness, &Guard::kind);
  };
  Drive drive;
  tapped(drive.truth);
  tapped(drive.noisy);
  const Guard follows = roughness(drive, none);
  EXPECT_GT(*follows.value, 1.5);
  EXPECT_EQ(follows.verdict, Verdict::kPass) << follows.limit;
  EXPECT_EQ(roughness(Drive(), tapped).verdict, Verdict::kFail) << "these are the method's";
  EXPECT_EQ(roughness(Drive(), stepped).verdict, Verdict::kFail);
}

TEST(Guards, FailOneThatLosesVibration) {
  const Change smooth = [](std::vector<double>& x) { x = rival_estimate({Rival::kZeroPhase1, 0.25}, x); };
  const Guard guard = guard_of(GuardKind::kVibrationGain, smooth);
  EXPECT_EQ(guard.verdict, Verdict::kFail);
  EXPECT_NEAR(*guard.value, 0.5, 0.05);  // fs/4 is the cut-off of both passes, and 0.45 takes a little
}

// Who says where the signal ends wants what lies beyond to go.
TEST(Guards, DoNotAskForVibrationBeyondTheSignalBand) {
  const Drive drive;
  const Method method = method_with([](std::vector<double>& x) {
    x = rival_estimate({Rival::kZeroPhase2, 0.1}, x);
  });
  GuardCase on = drive.guard_case();
  for (const double max_signal_hz : {0.0, 10.0, 26.0, 40.0}) {
    on.max_signal_hz = max_signal_hz;
    const Guard vibration = guards(method, method.run(drive.noisy), on).back();
    ASSERT_EQ(vibration.kind, GuardKind::kVibrationGain);
    EXPECT_LT(vibration.value.value_or(1.0), 0.2);
    const bool beyond = max_signal_hz == 10.0 || max_signal_hz == 26.0;
    EXPECT_EQ(vibration.verdict, beyond ? Verdict::kNotApplicable : Verdict::kFail) << max_signal_hz;
    EXPECT_EQ(vibration.reason.find("max_signal_hz") != std::string::npos, beyond);
  }
}

TEST(Guards, SayWhyTheyDoNotApply) {
  const Drive drive;
  Method method = method_with(none);
  Contender plain = method.run(drive.noisy);
  plain.seams.reset();
  GuardCase on = drive.guard_case();
  on.range = {500, 900};  // 4 s
  for (const Guard& guard : guards(method, plain, on)) {
    EXPECT_EQ(guard.reason.empty(), guard.verdict != Verdict::kNotApplicable);
    const bool long_one = guard.kind == GuardKind::kSlowTurnGain || guard.kind == GuardKind::kScaleFactor ||
                          guard.kind == GuardKind::kSeamRoughness;
    EXPECT_TRUE(!long_one || guard.verdict == Verdict::kNotApplicable) << name_of(guard.kind);
  }
}

// The truth comes two samples late: nobody's delay, where it has a clock of its own.
TEST(Guards, DelayIsBesideTheRecordsOwnWhereTheTruthHasAClock) {
  Drive drive;
  std::rotate(drive.truth.begin(), drive.truth.end() - 2, drive.truth.end());
  GuardCase on = drive.guard_case();
  EXPECT_NEAR(guard_on(on, GuardKind::kDelay, none).value.value(), -2.0, 0.2);
  on.truth_has_own_clock = true;
  const Guard prompt = guard_on(on, GuardKind::kDelay, none);
  EXPECT_NEAR(prompt.value.value(), 0.0, 0.2);
  EXPECT_EQ(prompt.verdict, Verdict::kPass);
  const Guard late = guard_on(on, GuardKind::kDelay, [](std::vector<double>& estimate) {
    std::rotate(estimate.begin(), estimate.end() - 1, estimate.end());
  });
  EXPECT_NEAR(late.value.value(), 1.0, 0.2);
  EXPECT_EQ(late.verdict, Verdict::kFail);
}

// One batch tells nothing of how uncertain a gain is.
TEST(Guards, DoNotJudgeAGainWhoseErrorIsNotKnown) {
  const Drive drive;
  GuardCase on = drive.guard_case();
  on.range = {500, 1400};  // 9 s
  for (const GuardKind kind : {GuardKind::kSwingGain, GuardKind::kVibrationGain}) {
    const Guard guard = guard_on(on, kind, [](std::vector<double>& estimate) {
      for (double& value : estimate) value *= 0.9;
    });
    EXPECT_EQ(guard.verdict, Verdict::kNotApplicable) << name_of(kind);
    EXPECT_NE(guard.reason.find("20 s"), std::string::npos) << guard.reason;
    EXPECT_NEAR(guard.value.value(), 0.9, 0.1) << "said, but not judged";
    EXPECT_FALSE(guard.standard_error);
  }
}

// Three minutes at 1.8 Hz: 0.1 Hz has its periods, 1 Hz is nothing that samples could hold.
TEST(Guards, SayThatASwingIsBeyondHalfTheSampleRate) {
  const Drive drive;
  const GuardCase on{drive.noisy, drive.truth, {500, 17'500}, 1.8};
  EXPECT_EQ(guard_on(on, GuardKind::kSlowTurnGain, none).reason, "");
  EXPECT_NE(guard_on(on, GuardKind::kSwingGain, none).reason.find("Nyquist"), std::string::npos);
}

// First-order low-pass, exponential average with share a: group delay at low frequency (1 - a)/a samples.
TEST(Guards, AddedSwingMeasuresTheGroupDelayOfAFilter) {
  const Drive drive;
  const Method method{"exponential", 0, [](std::span<const double> noisy) {
                        Contender contender;
                        contender.estimate = rival_estimate({Rival::kExponential, 0.25}, noisy);
                        return contender;
                      }};
  const auto response = added_swing(method, method.run(drive.noisy), drive.guard_case(), 0.1, 5.0);
  EXPECT_NEAR(response->delay_samples, 3.0, 0.01);
  const auto all = guards(method, method.run(drive.noisy), drive.guard_case());
  EXPECT_DOUBLE_EQ(
      std::ranges::find(all, GuardKind::kSlowTurnGain, &Guard::kind)->group_delay_samples.value_or(0.0),
      response->delay_samples);
}

}  // namespace
}  // namespace gyrod::core
