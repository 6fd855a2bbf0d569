#include "core/joint/whittle_fit.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "support/allocation_counter.hpp"
#include "support/signals.hpp"
#include "unit/core/joint/joint_support.hpp"

namespace gyrod::core {
namespace {

using testing::Signal;
using testing::spectrum_of;

constexpr std::size_t kTransform = 1024;
constexpr std::size_t kBins = kTransform / 2 + 1;

double radians(std::size_t bin) {
  return std::numbers::pi * static_cast<double>(bin) / static_cast<double>(kBins - 1);
}

SpectralMode oscillation(double radius, double angle, double drive) {
  return {.a = {2.0 * radius * std::cos(angle), -radius * radius, 0.0}, .drive = drive};
}

SpectralMode slow_mode(double pole, double drive) {
  return {.a = {pole, 0.0, 0.0}, .drive = drive, .slow = true};
}

ModeSet set_of(std::initializer_list<SpectralMode> modes) {
  ModeSet set;
  for (const SpectralMode& mode : modes) set.add(mode);
  return set;
}

/// The exact spectrum of modes in white noise of variance 1: a periodogram without chance.
Signal expected_periodogram(const ModeSet& modes) {
  Signal power(kBins, 1.0);
  for (std::size_t k = 0; k < kBins; ++k) {
    for (const SpectralMode& mode : modes.modes()) power[k] += spectrum_of(mode, radians(k));
  }
  return power;
}

/// Periodograms are exponentially distributed about the spectrum.
Signal drawn_periodogram(const ModeSet& modes, unsigned seed) {
  std::mt19937_64 bits(seed);
  std::exponential_distribution<double> exponential;
  Signal power = expected_periodogram(modes);
  for (double& value : power) value *= exponential(bits);
  return power;
}

double variance_of(const SpectralMode& mode) {
  double sum = 0.0;
  for (std::size_t k = 0; k < kBins; ++k) sum += spectrum_of(mode, radians(k)) / static_cast<double>(kBins);
  return sum;
}

// The property of EM (Dempster, Laird, Rubin 1977), where the M step is exact: Levinson's recursion maximises a mode's own Whittle
// likelihood on the whole circle. 1e-9: rounding of sums of 513 terms.
TEST(WhittleFit, LikelihoodNeverFalls) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ModeSet truth =
        set_of({oscillation(0.97, 0.3, 0.5), oscillation(0.9, 1.2, 0.2), slow_mode(0.995, 0.05)});
    WhittleFit fit(kTransform, 0.0);
    fit.observe(drawn_periodogram(truth, seed), white_noise(1.0));
    ModeSet modes = set_of({oscillation(0.8, 0.6, 1.0), oscillation(0.8, 1.8, 1.0), slow_mode(0.9, 1.0)});
    double before = fit.log_likelihood(modes);
    for (int i = 0; i < 30; ++i) {
      fit.iterate(modes, 1);
      const double after = fit.log_likelihood(modes);
      EXPECT_GE(after, before - 1e-9 * std::abs(before)) << seed << " " << i;
      before = after;
    }
  }
}

// Of the spectrum without chance, the modes that made it are a fixed point.
TEST(WhittleFit, TheTruthIsAFixedPoint) {
  const ModeSet truth = set_of({oscillation(0.95, 0.5, 0.3), slow_mode(0.98, 0.1)});
  WhittleFit fit(kTransform, 0.0);
  fit.observe(expected_periodogram(truth), white_noise(1.0));
  ModeSet modes = truth;
  fit.iterate(modes, 10);
  for (std::size_t j = 0; j < modes.size(); ++j) {
    EXPECT_NEAR(modes.modes()[j].drive, truth.modes()[j].drive, 1e-6);
    for (std::size_t i = 0; i < kModeOrder; ++i)
      EXPECT_NEAR(modes.modes()[j].a[i], truth.modes()[j].a[i], 1e-6);
  }
}

// The reference is noise_spectrum(), by cosines and sines of each multiple; here it is Horner's rule.
TEST(WhittleFit, TheNoisesSpectrumIsThatOfItsModelAndOfItsLines) {
  NoiseModel noise = white_noise(1.0);
  noise.colour_order = kMaxNoiseColour;
  noise.colour = {0.4, -0.3, 0.1, 0.05, -0.02, 0.02, 0.01, -0.05};
  noise.colour_variance = 0.5;
  ASSERT_TRUE(is_usable(noise));
  const std::array lines = {oscillation(0.98, 1.7, 0.02), oscillation(0.97, 2.4, 0.01)};
  WhittleFit fit(kTransform, 0.0);
  fit.observe(Signal(kBins, 1.0), noise, lines);
  for (std::size_t k = 0; k < kBins; ++k) {
    const double rest = noise_spectrum(noise, radians(k));
    EXPECT_NEAR(fit.noise_without_lines()[k] / rest, 1.0, 1e-12);
    const double both = spectrum_of(lines[0], radians(k)) + spectrum_of(lines[1], radians(k));
    EXPECT_NEAR(fit.noise()[k] / (rest + both), 1.0, 1e-12);
  }
  noise.line_count = 1;
  noise.line[0] = {.cycles = 0.3, .half_width = 0.01, .variance = 0.5};
  fit.observe(Signal(kBins, 1.0), noise);
  for (std::size_t k = 0; k < kBins; ++k)
    EXPECT_NEAR(fit.noise()[k] / noise_spectrum(noise, radians(k)), 1.0, 1e-12) << k;
  fit.observe(Signal(kBins, 1.0), white_noise(2.0));
  EXPECT_EQ(fit.noise()[17], 2.0) << "nothing is left of what was told before";
}

// Where the periodogram is what noise, line and modes make together, the line is as strong as believed; where it has left its place there is little of
// it: sum L - (L / M)^2 (M - 1) with M = L + 1, and L up to 38 here.
TEST(WhittleFit, ExplainsModesAndAsMuchOfTheLineAsTheWindowHas) {
  const ModeSet modes = set_of({oscillation(0.9, 1.3, 0.5), slow_mode(0.98, 0.1)});
  const SpectralMode line = oscillation(0.97, 2.0, 0.15);
  constexpr std::size_t kPeak = 326;  // 2.0 radians
  WhittleFit fit(kTransform, 0.0);
  Signal whole = expected_periodogram(modes);
  for (std::size_t k = 0; k < kBins; ++k) whole[k] += spectrum_of(line, radians(k));
  fit.observe(whole, white_noise(1.0), std::span(&line, 1));
  const auto all = fit.explained(modes);
  for (std::size_t k = 0; k < kBins; k += 7) EXPECT_NEAR(all[k], whole[k] - 1.0, 1e-9 * whole[k]) << k;

  fit.observe(Signal(kBins, 1.0), white_noise(1.0), std::span(&line, 1));
  EXPECT_LT(fit.explained(set_of({}))[kPeak], 0.35 * spectrum_of(line, radians(kPeak)));

  fit.observe(whole, white_noise(1.0));
  const auto without = fit.explained(modes);
  for (std::size_t k = 0; k < kBins; k += 7)
    EXPECT_NEAR(without[k], expected_periodogram(modes)[k] - 1.0, 1e-9 * whole[k]);
}

// Where the fit would stay, an iteration takes its share of the drive and no more; the slow mode pays nothing.
TEST(WhittleFit, ShrinkageTakesItsShareOfAllButTheSlowMode) {
  const ModeSet truth = set_of({oscillation(0.95, 0.5, 0.3), slow_mode(0.98, 0.1)});
  WhittleFit fit(kTransform, 0.0);
  fit.set_shrinkage(0.03);
  fit.observe(expected_periodogram(truth), white_noise(1.0));
  ModeSet modes = truth;
  fit.iterate(modes, 1);
  EXPECT_NEAR(modes.modes()[0].drive, 0.97 * 0.3, 1e-6);
  EXPECT_NEAR(modes.modes()[1].drive, 0.1, 1e-6);
}

// Of a spectrum without chance, a mode 0.1 of the noise's height fades to less than half under a shrinkage of 0.03, one 100 times as high loses
// less than 10 %: where I = M an iteration gives S <- 0.97 S, and what I - M then lacks is given back in parts of S / M.
TEST(WhittleFit, ShrinkageFadesWhatIsHardlyMoreThanNoise) {
  for (const double height : {0.1, 100.0}) {
    const SpectralMode mode{.a = {0.5, 0.0, 0.0}, .drive = 0.25 * height};
    WhittleFit fit(kTransform, 0.0);
    fit.set_shrinkage(0.03);
    fit.observe(expected_periodogram(set_of({mode})), white_noise(1.0));
    ModeSet modes = set_of({mode});
    fit.iterate(modes, 200);
    const double left = variance_of(modes.modes()[0]) / variance_of(mode);
    if (height < 1.0) {
      EXPECT_LT(left, 0.5);
    } else {
      EXPECT_GT(left, 0.9);
    }
  }
}

// An AR(2) seen in white noise, from a start far off: its spectrum comes back. A periodogram of 513 bins tells the height of a peak
// some ten bins wide to about a third; 0.2 in the logarithm is three deviations of the mean of 30.
TEST(WhittleFit, RecoversAnOscillationInNoise) {
  const SpectralMode truth = oscillation(0.95, 0.5, 1.0);
  constexpr unsigned kSeeds = 30;
  std::array<double, 3> error{};
  constexpr std::array<double, 3> kRadians = {0.45, 0.5, 0.55};
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    WhittleFit fit(kTransform, 0.001);
    fit.observe(drawn_periodogram(set_of({truth}), seed), white_noise(1.0));
    ModeSet modes = set_of({oscillation(0.7, 1.0, 0.3)});
    fit.iterate(modes, 200);
    for (std::size_t i = 0; i < error.size(); ++i) {
      error[i] +=
          std::log(spectrum_of(modes.modes()[0], kRadians[i]) / spectrum_of(truth, kRadians[i])) / kSeeds;
    }
  }
  for (const double value : error) EXPECT_NEAR(value, 0.0, 0.2);
}

TEST(WhittleFit, NoiseAloneLeavesTheModesWithoutPower) {
  WhittleFit fit(kTransform, 0.001);
  fit.observe(Signal(kBins, 1.0), white_noise(1.0));
  ModeSet modes = set_of({oscillation(0.9, 0.5, 0.3), oscillation(0.9, 1.5, 0.3), slow_mode(0.99, 0.01)});
  double before = 0.0;
  for (const SpectralMode& mode : modes.modes()) before += variance_of(mode);
  fit.iterate(modes, 200);
  double after = 0.0;
  for (const SpectralMode& mode : modes.modes()) after += variance_of(mode);
  EXPECT_LT(after, 0.1 * before);
  // The power falls slowly there, about as the inverse of the iterations: the likelihood is flat at the border.
  fit.iterate(modes, 2000);
  double later = 0.0;
  for (const SpectralMode& mode : modes.modes()) later += variance_of(mode);
  EXPECT_LT(later, 0.5 * after);
}

TEST(WhittleFit, PruningTakesTheSuperfluousModeAndKeepsTheNeededOne) {
  const SpectralMode needed = oscillation(0.97, 0.3, 0.5);
  const SpectralMode superfluous = oscillation(0.9, 2.0, 1e-3);
  WhittleFit fit(kTransform, 0.001);
  fit.observe(expected_periodogram(set_of({needed, slow_mode(0.995, 0.05)})), white_noise(1.0));
  ModeSet modes = set_of({superfluous, needed, slow_mode(0.995, 0.05)});
  fit.prune(modes, 25.0);
  ASSERT_EQ(modes.size(), 2U);
  EXPECT_EQ(modes.modes()[0].a, needed.a);
  EXPECT_TRUE(modes.modes()[1].slow);
}

TEST(WhittleFit, PruningNeverTakesTheSlowMode) {
  WhittleFit fit(kTransform, 0.001);
  fit.observe(Signal(kBins, 1.0), white_noise(1.0));
  ModeSet modes = set_of({oscillation(0.9, 0.5, 1e-3), slow_mode(0.99, 1e-9)});
  fit.prune(modes, 1e4);
  ASSERT_EQ(modes.size(), 1U);
  EXPECT_TRUE(modes.modes()[0].slow);
}

// By the definition of gain: twice the difference of ln L with and without the mode.
TEST(WhittleFit, PruningDrawsTheLineAtTheLikelihoodThatAModeBuys) {
  const ModeSet both = set_of({oscillation(0.97, 0.3, 0.05), slow_mode(0.995, 0.05)});
  const ModeSet without = set_of({slow_mode(0.995, 0.05)});
  WhittleFit fit(kTransform, 0.001);
  fit.observe(drawn_periodogram(both, 3), white_noise(1.0));
  const double gain = 2.0 * (fit.log_likelihood(both) - fit.log_likelihood(without));
  ASSERT_GT(gain, 0.0);
  ModeSet kept = both;
  fit.prune(kept, gain * (1.0 - 1e-9));
  EXPECT_EQ(kept.size(), 2U);
  fit.prune(kept, gain * (1.0 + 1e-9));
  EXPECT_EQ(kept.size(), 1U);
}

TEST(WhittleFit, GivesTheSameBitsOnEveryKernel) {
  const ModeSet truth = set_of({oscillation(0.97, 0.3, 0.5), slow_mode(0.995, 0.05)});
  const ModeSet start = set_of({oscillation(0.8, 0.6, 1.0), slow_mode(0.9, 1.0)});
  const Signal power = drawn_periodogram(truth, 1);
  const auto fitted = [&](EmdKernel kernel) {
    WhittleFit fit(kTransform, 0.001, kernel);
    fit.observe(power, white_noise(1.0));
    ModeSet modes = start;
    fit.iterate(modes, 20);
    return modes;
  };
  const ModeSet baseline = fitted(EmdKernel::kBaseline);
  for (const EmdKernel kernel : {EmdKernel::kAvx2, EmdKernel::kAvx512, EmdKernel::kFastest}) {
    if (!is_available(kernel)) continue;
    const ModeSet modes = fitted(kernel);
    for (std::size_t j = 0; j < modes.size(); ++j) {
      EXPECT_EQ(modes.modes()[j].a, baseline.modes()[j].a);
      EXPECT_EQ(modes.modes()[j].drive, baseline.modes()[j].drive);
    }
  }
}

TEST(WhittleFit, AllocatesNothingAfterConstruction) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "sanitizers bring their own heap";
  const Signal power(kBins, 2.0);
  const NoiseModel noise = white_noise(1.0);
  WhittleFit fit(kTransform, 0.001);
  ModeSet modes = set_of({oscillation(0.9, 0.5, 0.1), oscillation(0.9, 1.5, 0.1), slow_mode(0.99, 0.1)});
  const auto before = testing::allocations();
  fit.observe(power, noise);
  fit.iterate(modes, 5);
  fit.prune(modes, 25.0);
  EXPECT_EQ(testing::allocations(), before);
}

}  // namespace
}  // namespace gyrod::core
