#include "core/evaluation/turns.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/evaluation/rivals.hpp"
#include "evaluation_support.hpp"

namespace gyrod::core {
namespace {

Method rival_method(const RivalSetting& setting) {
  return {"test", setting.delay, [setting](std::span<const double> noisy) {
            Contender contender;
            contender.estimate = rival_estimate(setting, noisy);
            return contender;
          }};
}

// 1 - exp(-t / tau): half after tau ln 2, 95 % after tau ln 20. Sampled: (1 - a)^n with n counted from the sample before the step.
TEST(Turns, OfAFirstOrderFilterHaveTheTimesOfItsClosedForm) {
  constexpr double kTau = 0.2;
  const TurnOptions options{.rate_hz = 1000.0, .straight_s = 2.0, .after_s = 3.0, .repeats = 1};
  const double share = 1.0 - std::exp(-1.0 / (1000.0 * kTau));
  const auto response =
      TurnTrials(rival_method({Rival::kExponential, share}), {}, options).take({"step", 10.0, 0.0});
  EXPECT_NEAR(*response.half_delay_s, kTau * std::log(2.0), 0.002);  // two samples
  EXPECT_NEAR(*response.time_95_s, kTau * std::log(20.0), 0.002);
  EXPECT_DOUBLE_EQ(response.overshoot, 0.0);
  EXPECT_NEAR(response.peak_error_dps, 10.0 * (1.0 - share), 1e-9);  // at the step itself
}

// Second order with Q = 1/sqrt(2): a step overshoots by exp(-pi) = 4.32 % in continuous time.
TEST(Turns, OfASecondOrderButterworthOvershootAsInTheTextbook) {
  const TurnOptions options{.rate_hz = 1000.0, .straight_s = 2.0, .after_s = 3.0, .repeats = 1};
  const auto response =
      TurnTrials(rival_method({Rival::kButterworth2, 0.002}), {}, options).take({"step", 2.0, 0.0});
  EXPECT_NEAR(response.overshoot, std::exp(-std::numbers::pi), 1e-3);
}

TEST(Turns, RiseAsTheirProfileSays) {
  const TurnOptions options{.rate_hz = 100.0, .straight_s = 1.0, .after_s = 1.3, .repeats = 1};
  const auto truth = turn_truth(kTurnProfiles[0], options);
  ASSERT_EQ(truth.size(), 230U);
  EXPECT_DOUBLE_EQ(truth[100], 0.0);
  EXPECT_NEAR(truth[115], 5.0, 1e-12);
  EXPECT_NEAR(truth[130], 10.0, 1e-12);
  EXPECT_NEAR(truth[229], 10.0, 1e-12);
}

TEST(Turns, OfRawRatesAreThoseOfTheTruth) {
  const TurnOptions options{.rate_hz = 100.0, .straight_s = 3.0};
  const auto response = TurnTrials(rival_method({Rival::kRaw}), {}, options).take(kTurnProfiles[2]);
  EXPECT_NEAR(*response.half_delay_s, 0.0, 1e-12);
  EXPECT_NEAR(*response.time_95_s, 0.95, 1e-9);
  EXPECT_DOUBLE_EQ(response.peak_error_dps, 0.0);
  ASSERT_EQ(response.trace_dps.size(), 400U);
  EXPECT_DOUBLE_EQ(response.trace_start_s, -1.0);
}

// A linear filter answers to the turn as it would without noise; its errors have the noise.
TEST(Turns, OfALinearFilterAreFreeOfTheNoise) {
  const auto noise = test::white_noise(5000, 0.5, 3);
  const TurnOptions options{.rate_hz = 100.0, .straight_s = 3.0, .repeats = 2};
  const Method filter = rival_method({Rival::kButterworth2, 0.02, 0.0, 4});
  const auto noisy = TurnTrials(filter, noise, options).take(kTurnProfiles[1]);
  const auto quiet = TurnTrials(filter, {}, options).take(kTurnProfiles[1]);
  EXPECT_NEAR(*noisy.half_delay_s, *quiet.half_delay_s, 1e-9);
  EXPECT_NEAR(*noisy.half_delay_error_s, 0.0, 1e-9);
  EXPECT_NEAR(*noisy.time_95_s, *quiet.time_95_s, 1e-9);
  EXPECT_NEAR(noisy.overshoot, quiet.overshoot, 1e-9);
  EXPECT_GT(noisy.peak_error_dps, quiet.peak_error_dps);
}

TEST(Turns, HavePeakErrorsOfEachRunForItself) {
  const auto noise = test::white_noise(5000, 0.5, 3);
  const TurnOptions options{.rate_hz = 100.0, .straight_s = 3.0, .repeats = 25};
  const auto response = TurnTrials(rival_method({Rival::kRaw}), noise, options).take(kTurnProfiles[0]);
  EXPECT_NEAR(response.peak_error_dps, 0.5 * 2.9, 0.25);  // the greatest of 280 normal ones is near 2.9 sigma
}

// Late by as many samples as the run's first one, 0.2 to 0.6 deg/s of noise, says: 2, 3, ... 6, where the turn goes 10 deg/s^2. Population variance of
// 2 .. 6 is 2; of their mean 2 / 5, its root 0.63 samples.
TEST(Turns, SayHowUncertainTheirHalfIs) {
  const Method late{"late", 0, [](std::span<const double> noisy) {
                      const auto delay = static_cast<std::size_t>(std::llround(10.0 * noisy[0]));
                      Contender contender;
                      contender.estimate.assign(noisy.size(), 0.0);
                      for (std::size_t t = delay; t < noisy.size(); ++t) {
                        contender.estimate[t] = noisy[t - delay] > 1.0 ? noisy[t - delay] - noisy[0] : 0.0;
                      }
                      return contender;
                    }};
  // Each fifth of it is a constant, long enough for a run.
  std::vector<double> noise;
  for (const double level : {0.2, 0.3, 0.4, 0.5, 0.6}) noise.insert(noise.end(), 900, level);
  const TurnOptions options{.rate_hz = 100.0, .straight_s = 3.0, .repeats = 5};
  const auto response = TurnTrials(late, noise, options).take({"ramp", 10.0, 1.0});
  EXPECT_NEAR(*response.half_delay_s, 0.04, 1e-9);
  EXPECT_NEAR(*response.half_delay_error_s, 0.01 * std::sqrt(2.0 / 5.0), 1e-9);
  const TurnOptions once{.rate_hz = 100.0, .straight_s = 3.0, .repeats = 1};
  EXPECT_FALSE(TurnTrials(late, noise, once).take({"ramp", 10.0, 1.0}).half_delay_error_s);
}

TEST(Turns, SayNothingOfALevelThatIsNeverReached) {
  const Method zero{"zero", 0, [](std::span<const double> noisy) {
                      Contender contender;
                      contender.estimate.assign(noisy.size(), 0.0);
                      return contender;
                    }};
  const auto response = TurnTrials(zero, {}, {.straight_s = 2.0}).take(kTurnProfiles[0]);
  EXPECT_FALSE(response.half_delay_s || response.time_95_s);
  EXPECT_DOUBLE_EQ(response.peak_error_dps, 10.0);
}

}  // namespace
}  // namespace gyrod::core
