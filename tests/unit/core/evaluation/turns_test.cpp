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
  const TurnOptions options{.rate_hz = 1000.0, .straight_s = 2.0, .hold_s = 3.0, .repeats = 1};
  const double share = 1.0 - std::exp(-1.0 / (1000.0 * kTau));
  const auto response =
      turn_response(rival_method({Rival::kExponential, share}), {"step", 10.0, 0.0}, {}, options);
  EXPECT_NEAR(*response.half_delay_s, kTau * std::log(2.0), 0.002);  // two samples
  EXPECT_NEAR(*response.time_95_s, kTau * std::log(20.0), 0.002);
  EXPECT_DOUBLE_EQ(response.overshoot, 0.0);
  EXPECT_NEAR(response.peak_error_dps, 10.0 * (1.0 - share), 1e-9);  // at the step itself
}

// Second order with Q = 1/sqrt(2): a step overshoots by exp(-pi) = 4.32 % in continuous time.
TEST(Turns, OfASecondOrderButterworthOvershootAsInTheTextbook) {
  const TurnOptions options{.rate_hz = 1000.0, .straight_s = 2.0, .hold_s = 3.0, .repeats = 1};
  const auto response =
      turn_response(rival_method({Rival::kButterworth2, 0.002}), {"step", 2.0, 0.0}, {}, options);
  EXPECT_NEAR(response.overshoot, std::exp(-std::numbers::pi), 1e-3);
}

TEST(Turns, RiseAsTheirProfileSays) {
  const TurnOptions options{.rate_hz = 100.0, .straight_s = 1.0, .hold_s = 1.0, .repeats = 1};
  const auto truth = turn_truth(kTurnProfiles[0], options);
  ASSERT_EQ(truth.size(), 230U);
  EXPECT_DOUBLE_EQ(truth[100], 0.0);
  EXPECT_NEAR(truth[115], 5.0, 1e-12);
  EXPECT_NEAR(truth[130], 10.0, 1e-12);
  EXPECT_NEAR(truth[229], 10.0, 1e-12);
}

TEST(Turns, OfRawRatesAreThoseOfTheTruth) {
  const TurnOptions options{.rate_hz = 100.0, .straight_s = 3.0};
  const auto response = turn_response(rival_method({Rival::kRaw}), kTurnProfiles[2], {}, options);
  EXPECT_NEAR(*response.half_delay_s, 0.0, 1e-12);
  EXPECT_NEAR(*response.time_95_s, 0.95, 1e-9);
  EXPECT_DOUBLE_EQ(response.peak_error_dps, 0.0);
  ASSERT_EQ(response.trace_dps.size(), 400U);
  EXPECT_DOUBLE_EQ(response.trace_start_s, -1.0);
}

TEST(Turns, AverageOverStretchesOfTheNoise) {
  const auto noise = test::white_noise(5000, 0.5, 3);
  TurnOptions options{.rate_hz = 100.0, .straight_s = 3.0};
  options.repeats = 25;
  const auto response = turn_response(rival_method({Rival::kRaw}), kTurnProfiles[0], noise, options);
  double squares = 0.0;
  for (std::size_t t = 0; t < response.trace_dps.size(); ++t) {
    squares += std::pow(response.trace_dps[t] - response.trace_truth_dps[t], 2.0);
  }
  // 0.5 / sqrt(25), from 400 samples: 3.5 %; three of these and a little
  EXPECT_NEAR(std::sqrt(squares / 400.0), 0.1, 0.015);
  EXPECT_GT(response.peak_error_dps,
            0.8);  // each run for itself: the greatest of 280 normal ones is near 2.9 sigma
}

TEST(Turns, SayNothingOfALevelThatIsNeverReached) {
  const Method zero{"zero", 0, [](std::span<const double> noisy) {
                      Contender contender;
                      contender.estimate.assign(noisy.size(), 0.0);
                      return contender;
                    }};
  const auto response = turn_response(zero, kTurnProfiles[0], {}, {.straight_s = 2.0});
  EXPECT_FALSE(response.half_delay_s || response.time_95_s);
  EXPECT_DOUBLE_EQ(response.peak_error_dps, 10.0);
}

}  // namespace
}  // namespace gyrod::core
