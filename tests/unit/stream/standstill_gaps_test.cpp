// Where what is learned at rest begins anew: another sample rate, another rest, a gap.
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "core/allan/online_allan.hpp"
#include "core/noise/noise_model.hpp"
#include "engine_support.hpp"
#include "stream/standstill_noise.hpp"
#include "support/signals.hpp"

namespace gyrod::stream {
namespace {

constexpr double kStillHz = 100.0;

/// White noise of this standard deviation on each axis, rad/s, with a steady accelerometer or none.
std::vector<Sample> still(std::size_t count, double deviation, bool accelerometer = false) {
  std::vector<Sample> samples(count);
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    const auto noise = testing::white_noise(count, static_cast<unsigned>(axis + 1));
    for (std::size_t n = 0; n < count; ++n) samples[n].rate_radps[axis] = deviation * noise[n];
  }
  for (std::size_t n = 0; accelerometer && n < count; ++n)
    samples[n].specific_force_mps2 = {0.0, 0.0, 9.81 + (n % 2 == 0 ? 0.01 : -0.01)};
  return samples;
}

CalibratedNoise believed() {
  CalibratedNoise noise{kStillHz, {}};
  noise.models.fill(core::white_noise(1e-4));
  return noise;
}

/// Whether stamps of these rates, in turn, make another noise of the calibration.
bool changes_with(const std::vector<double>& rates_hz) {
  StandstillNoise learner({.calibrated = believed()});
  const auto samples = still(4 * StandstillNoise::kAgreeing, 0.01);
  bool changed = false;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    learner.step(samples[n], true, rates_hz[n % rates_hz.size()]);
    changed = changed || learner.update().has_value();
  }
  return changed;
}

TEST(StandstillNoise, TakesARateForAnotherFromTwoPerCentOn) {
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_FALSE(changes_with({kStillHz + 1.9 * sign})) << sign;
    EXPECT_TRUE(changes_with({kStillHz + 2.2 * sign})) << sign;
  }
}

// Stamps that come in bursts: each rate is far from the one in use, and none is that of the next.
TEST(StandstillNoise, BelievesNoRatesThatDoNotAgree) {
  EXPECT_TRUE(changes_with({200.0, 203.0})) << "one rate, estimated twice";
  EXPECT_FALSE(changes_with({200.0, 300.0}));
  EXPECT_FALSE(changes_with({200.0, 200.0, 200.0, kStillHz}));
}

// The curves are of the rest that was learned from. Where that was none, as the sensor is quieter, they are of what came after.
TEST(StandstillNoise, ItsAllanDeviationBeginsAnewWhereWhatWasLearnedWasNoRest) {
  StandstillNoise learner({.sample_rate_hz = kStillHz});
  RestEvidence last;
  const auto run = [&](const std::vector<Sample>& samples) {
    for (const Sample& sample : samples) {
      learner.step(sample, true, kStillHz);
      if (learner.evidence() != nullptr) last = *learner.evidence();
    }
    learner.reset_segment();
  };
  run(still(3000, 0.01));
  EXPECT_GT(last.curves[0].terms[0], 0U);
  const auto quiet = still(4000, 0.005);
  run(quiet);
  // Rest is known after eight blocks, and the last block waits for the next.
  core::OnlineAllan expected;
  for (std::size_t n = 800; n < 3900; ++n) expected.step(quiet[n].rate_radps[0]);
  EXPECT_EQ(last.curves[0], expected.sums());
}

TEST(StandstillNoise, RemembersNoAllanDeviationOfAnotherRate) {
  RememberedNoise state;
  StandstillNoise teller({.on_learned = [&state](const auto& now) { state = now; }});
  for (const Sample& sample : still(6000, 0.01)) {
    teller.step(sample, true, kStillHz);
    static_cast<void>(teller.update());
  }
  ASSERT_GT(state.curves[0].terms[0], 0U);
  StandstillNoise learner({.sample_rate_hz = 2.0 * kStillHz, .remembered = state});
  std::optional<AllanCurves> curves;
  for (const Sample& sample : still(200, 0.01)) {
    learner.step(sample, true, 2.0 * kStillHz);
    if (learner.evidence() != nullptr) curves = learner.evidence()->curves;
  }
  EXPECT_EQ(curves, AllanCurves{});
}

// A force from before a gap does not hold after it: rest without an accelerometer is known after eight blocks, as ever.
TEST(StandstillNoise, ASpecificForceDoesNotHoldOverAGap) {
  StandstillNoise learner({.sample_rate_hz = kStillHz});
  for (const Sample& sample : still(1500, 0.01, true)) learner.step(sample, true, kStillHz);
  ASSERT_TRUE(learner.at_rest());
  learner.reset_segment();
  std::size_t first = 0;
  const auto later = still(1000, 0.01);
  for (std::size_t n = 0; n < later.size() && first == 0; ++n) {
    learner.step(later[n], true, kStillHz);
    if (learner.at_rest()) first = n + 1;
  }
  EXPECT_EQ(first, 800U);
}

TEST(StandstillNoise, ItsAllanDeviationBeginsAnewAtAnotherRate) {
  StandstillNoise learner({});
  RestEvidence last;
  const auto samples = still(3000, 0.01);
  const auto run = [&](std::span<const Sample> some, double rate_hz) {
    for (const Sample& sample : some) {
      learner.step(sample, true, rate_hz);
      if (learner.evidence() != nullptr) last = *learner.evidence();
    }
  };
  run(samples, kStillHz);
  ASSERT_GT(last.curves[0].terms[0], 0U);
  run(std::span(samples).first(StandstillNoise::kAgreeing + 200), 2.0 * kStillHz);
  EXPECT_EQ(last.sample_rate_hz, 2.0 * kStillHz);
  EXPECT_EQ(last.curves, AllanCurves{});
}

// Sixteen samples without a number are looked through; of the seventeenth on rest is judged without an accelerometer, from its beginning.
TEST(StandstillNoise, TheLastSpecificForceHoldsForSixteenSamples) {
  for (const std::size_t missing : {StandstillNoise::kMostHeldForces, StandstillNoise::kMostHeldForces + 1}) {
    StandstillNoise learner({.sample_rate_hz = kStillHz});
    auto samples = still(1600, 0.01, true);
    for (std::size_t n = 1520; n < 1520 + missing; ++n) samples[n].specific_force_mps2.reset();
    for (const Sample& sample : samples) learner.step(sample, true, kStillHz);
    EXPECT_EQ(learner.at_rest(), missing == StandstillNoise::kMostHeldForces) << missing;
  }
}

// One force in twenty samples, as of an accelerometer at 5 Hz: it fails again and again, and must not begin rest anew each time.
TEST(StandstillNoise, AnAccelerometerThatComesAndGoesDoesNotKeepRestFromBeingFound) {
  StandstillNoise learner({.sample_rate_hz = kStillHz});
  auto samples = still(1600, 0.01, true);
  for (std::size_t n = 0; n < samples.size(); ++n) {
    if (n % 20 != 0) samples[n].specific_force_mps2.reset();
  }
  for (const Sample& sample : samples) learner.step(sample, true, kStillHz);
  EXPECT_TRUE(learner.at_rest());
}

/// A minute at rest at 200 Hz, with a noisy accelerometer that measures every so many samples, and between them has nothing or its last.
double rest_with(std::size_t every, bool repeats) {
  constexpr double kHz = 200.0;
  StandstillNoise learner({.sample_rate_hz = kHz});
  auto samples = still(12'000, 0.01);
  const auto noise = testing::white_noise(3 * samples.size(), 9);
  std::size_t at_rest = 0;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const std::size_t k = repeats ? n - n % every : n;
    if (k % every == 0) {
      samples[n].specific_force_mps2 = {0.05 * noise[3 * k], 0.05 * noise[3 * k + 1],
                                        9.81 + 0.05 * noise[3 * k + 2]};
    }
    learner.step(samples[n], true, kHz);
    if (learner.at_rest()) ++at_rest;
  }
  return static_cast<double>(at_rest) / static_cast<double>(samples.size());
}

// Forces that are held tell nothing new: taken for samples of their own, their means vary by more than their noise would explain.
TEST(StandstillNoise, AnAccelerometerSlowerThanTheGyroFindsRestAsSoon) {
  const double as_fast = rest_with(1, false);
  EXPECT_GT(as_fast, 0.8);
  for (const std::size_t every : {std::size_t{2}, std::size_t{4}, std::size_t{8}, std::size_t{16}}) {
    EXPECT_EQ(rest_with(every, false), as_fast) << every;
    EXPECT_EQ(rest_with(every, true), as_fast) << every;
  }
}

}  // namespace
}  // namespace gyrod::stream
