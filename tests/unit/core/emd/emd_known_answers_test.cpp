// Identities and published values of the decomposition as a whole.
#include <array>
#include <stdexcept>

#include <gtest/gtest.h>

#include "unit/core/emd/emd_support.hpp"

namespace gyrod {
namespace {

using core::BoundaryRule;
using core::Emd;
using core::EmdOptions;
using namespace testing;

/// A slow turn, a sway and noise: what a gyro on a vehicle gives, rad/s.
Signal drive(std::size_t size, unsigned seed) {
  Signal signal = times(tone(size, 0.002), 0.1);
  signal = sum(signal, tone(size, 0.013, 1.0), 0.03);
  return sum(signal, white_noise(size, seed), 0.005);
}

class EmdRule : public ::testing::TestWithParam<BoundaryRule> {
 protected:
  EmdOptions options() const { return {.boundary = GetParam()}; }
};

INSTANTIATE_TEST_SUITE_P(BothRules, EmdRule, ::testing::Values(BoundaryRule::kMirror, BoundaryRule::kLinear));

// Each level is one subtraction rounded to half an ulp: ten levels stay below 1e-15, the bound leaves room
// for more.
TEST_P(EmdRule, ModesAndResidueAddUpToTheSignal) {
  for (const std::size_t size : {64U, 1000U, 1024U, 4096U}) {
    const Signal signal = drive(size, 1);
    EXPECT_LE(completeness_error(decompose(signal, options()), signal), 1e-14 * peak(signal)) << size;
  }
}

TEST_P(EmdRule, ConstantIsResidue) {
  const Signal constant(500, -0.731);
  const Decomposition parts = decompose(constant, options());
  EXPECT_TRUE(parts.imfs.empty());
  EXPECT_EQ(parts.residue, constant);
}

TEST_P(EmdRule, RampIsResidue) {
  Signal ramp(500);
  for (std::size_t t = 0; t < ramp.size(); ++t) {
    ramp[t] = 0.3 - 0.001 * static_cast<double>(t);
  }
  const Decomposition parts = decompose(ramp, options());
  EXPECT_TRUE(parts.imfs.empty());
  EXPECT_EQ(parts.residue, ramp);
}

TEST_P(EmdRule, ScalingByAPowerOfTwoScalesEveryBit) {
  const Signal signal = drive(1024, 2);
  const Decomposition parts = decompose(signal, options());
  for (const int exponent : {-900, -30, -1, 1, 10, 900}) {
    const double factor = std::ldexp(1.0, exponent);
    Decomposition scaled = decompose(times(signal, factor), options());
    for (Signal& imf : scaled.imfs) {
      imf = times(imf, 1.0 / factor);
    }
    scaled.residue = times(scaled.residue, 1.0 / factor);
    EXPECT_EQ(scaled, parts) << exponent;
  }
}

// The sum rounds at 2^-53 of the offset; ten sifts do not amplify that by more than a few thousand.
TEST_P(EmdRule, OffsetMovesOnlyTheResidue) {
  const Signal signal = drive(1024, 3);
  const double offset = 0.75;
  Decomposition moved = decompose(sum(signal, Signal(signal.size(), offset)), options());
  moved.residue = sum(moved.residue, Signal(signal.size(), -offset));
  EXPECT_LE(difference(moved, decompose(signal, options())), 1e-12 * offset);
}

// Envelopes are solved and evaluated from left to right, so that the two differ by rounding: up to 1.3e-14
// over fifty signals, and the bound leaves room for others.
TEST_P(EmdRule, TimeReversalReversesTheModes) {
  const Signal signal = drive(1024, 4);
  Decomposition back = decompose(reversed(signal), options());
  std::ranges::for_each(back.imfs, [](Signal& imf) { imf = reversed(imf); });
  back.residue = reversed(back.residue);
  EXPECT_LE(difference(back, decompose(signal, options())), 1e-12 * peak(signal));
}

/// Part of the energy that the first mode of an IMF leaves unexplained, averaged over the IMFs of a few
/// seeds.
double unexplained_on_second_pass(const EmdOptions& options) {
  double unexplained = 0.0;
  double modes = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const Signal& imf : decompose(white_noise(1024, seed), options).imfs) {
      const Decomposition again = decompose(imf, options);
      if (!again.imfs.empty()) {
        unexplained += energy(sum(imf, again.imfs[0], -1.0)) / energy(imf);
        modes += 1.0;
      }
    }
  }
  return unexplained / modes;
}

// The mode of a tone beside a slower one returns to a few 1e-6 of its energy.
TEST(Emd, DecomposingAModeAgainReturnsIt) {
  for (const double frequency : {0.05, 0.013}) {
    const Signal mode = decompose(sum(tone(2048, frequency), tone(2048, frequency / 8), 0.7)).imfs[0];
    const Decomposition again = decompose(mode);
    EXPECT_LT(energy(sum(mode, again.imfs[0], -1.0)), 1e-3 * energy(mode));
  }
}

// A mode of noise is not done after ten sifts: ten more move 3.0 % (linear: 3.7 %) of its energy on average.
// See docs/decisions/0002-emd-kernel.md.
TEST_P(EmdRule, DecomposingANoiseModeAgainNearlyReturnsIt) {
  EXPECT_LT(unexplained_on_second_pass(options()), 0.05);
}

struct TwoTones {
  double frequency_ratio;
  double lowest;
  double highest;
};

/// c = |IMF_1 - x_1| / |x_2| on the inner half, averaged over phases.
double separation(double frequency_ratio) {
  constexpr std::size_t kSize = 4096;
  constexpr double kFrequency = 0.05;
  double total = 0.0;
  constexpr int kPhases = 8;
  for (int phase = 0; phase < kPhases; ++phase) {
    const Signal fast = tone(kSize, kFrequency);
    const Signal slow = tone(kSize, frequency_ratio * kFrequency, 0.7 * phase);
    const Signal error = sum(decompose(sum(fast, slow)).imfs[0], fast, -1.0);
    const auto inner = [](const Signal& signal) { return std::span(signal).subspan(kSize / 4, kSize / 2); };
    total += std::sqrt(energy(inner(error)) / energy(inner(slow)));
  }
  return total / kPhases;
}

class EmdTwoTones : public ::testing::TestWithParam<TwoTones> {};

// Rilling & Flandrin 2008, "One or two frequencies? The empirical mode decomposition answers", fig. 3, equal
// amplitudes, 10 sifts: below a ratio of about 0.6 the tones come apart, above 0.75 they are one.
INSTANTIATE_TEST_SUITE_P(RillingFlandrin2008, EmdTwoTones,
                         ::testing::Values(TwoTones{0.3, 0.0, 0.005}, TwoTones{0.5, 0.01, 0.03},
                                           TwoTones{0.65, 0.44, 0.48}, TwoTones{0.7, 0.71, 0.75},
                                           TwoTones{0.8, 0.95, 1.1}));

TEST_P(EmdTwoTones, SeparateAsPublished) {
  const double c = separation(GetParam().frequency_ratio);
  EXPECT_GE(c, GetParam().lowest);
  EXPECT_LE(c, GetParam().highest);
}

TEST(Emd, OptionOutsideItsRangeIsRefusedByName) {
  const auto message = [](EmdOptions options) -> std::string {
    try {
      const Emd emd(16, options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(message({.sifts = 0}).find("sifts"), std::string::npos);
  EXPECT_NE(message({.sifts = 101}).find("sifts"), std::string::npos);
  EXPECT_NE(message({.max_imfs = 33}).find("max_imfs"), std::string::npos);
  EXPECT_NE(message({.min_extrema = 2}).find("min_extrema"), std::string::npos);
  EXPECT_NE(message({.min_relative_amplitude = -0.1}).find("min_relative_amplitude"), std::string::npos);
  EXPECT_NE(message({.min_relative_amplitude = std::nan("")}).find("min_relative_amplitude"),
            std::string::npos);
  EXPECT_THROW(Emd(0), std::invalid_argument);
}

TEST(Emd, StopsAtTheModesAskedFor) {
  EXPECT_EQ(decompose(white_noise(1024, 5), {.max_imfs = 3}).imfs.size(), 3U);
}

TEST(Emd, StopsAtARemainderBelowTheRelativeAmplitude) {
  const Signal signal = sum(tone(1024, 0.1), tone(1024, 0.005), 1e-3);
  EXPECT_EQ(decompose(signal, {.min_relative_amplitude = 0.1}).imfs.size(), 1U);
  EXPECT_GT(decompose(signal, {.min_relative_amplitude = 1e-6}).imfs.size(), 1U);
}

TEST(Emd, MeasuresTheRelativeAmplitudeFromPeakToPeakWhateverTheOffset) {
  const Signal signal = sum(tone(1024, 0.1), tone(1024, 0.005), 1e-3);
  const Signal lifted = sum(signal, Signal(1024, 1000.0));
  EXPECT_EQ(decompose(lifted, {.min_relative_amplitude = 0.1}).imfs.size(), 1U);
}

TEST(Emd, WritesNothingWhenThereIsNoMode) {
  Emd emd(16);
  emd.start(Signal(16, 1.0));
  Signal imf(16, 42.0);
  EXPECT_FALSE(emd.next_imf(imf));
  EXPECT_EQ(imf, Signal(16, 42.0));
}

TEST(Emd, RemainderIsAtHandAfterEveryMode) {
  const Signal signal = white_noise(256, 6);
  Emd emd(256);
  emd.start(signal);
  Signal imf(256);
  ASSERT_TRUE(emd.next_imf(imf));
  EXPECT_EQ(Signal(emd.residue().begin(), emd.residue().end()), sum(signal, imf, -1.0));
}

}  // namespace
}  // namespace gyrod
