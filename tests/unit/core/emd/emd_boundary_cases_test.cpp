// Inputs at the edge of what can be decomposed: short, flat, huge, tiny.
#include <cstdint>

#include <gtest/gtest.h>

#include "unit/core/emd/emd_support.hpp"

namespace gyrod {
namespace {

using core::BoundaryRule;
using namespace testing;

class EmdEdge : public ::testing::TestWithParam<BoundaryRule> {
 protected:
  /// What holds for every input: finite, and complete to rounding of the largest part.
  Decomposition check(const Signal& signal) const {
    Decomposition parts = decompose(signal, {.boundary = GetParam()});
    EXPECT_TRUE(is_finite(parts));
    double largest = peak(signal);
    for (const Signal& imf : parts.imfs) {
      largest = std::max(largest, peak(imf));
    }
    EXPECT_LE(completeness_error(parts, signal), 1e-14 * largest);
    return parts;
  }
};

INSTANTIATE_TEST_SUITE_P(BothRules, EmdEdge, ::testing::Values(BoundaryRule::kMirror, BoundaryRule::kLinear));

TEST_P(EmdEdge, OneToEightSamplesGiveAFiniteAnswer) {
  for (std::size_t size = 1; size <= 8; ++size) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
      check(white_noise(size, seed));
    }
  }
}

TEST_P(EmdEdge, FourSamplesHoldNoMode) { EXPECT_TRUE(check({1.0, -1.0, 1.0, -1.0}).imfs.empty()); }

TEST_P(EmdEdge, FiveAlternatingSamplesHoldAMode) {
  EXPECT_FALSE(check({1.0, -1.0, 1.0, -1.0, 1.0}).imfs.empty());
}

TEST_P(EmdEdge, ZeroIsResidue) {
  const Decomposition parts = check(Signal(100));
  EXPECT_TRUE(parts.imfs.empty());
  EXPECT_EQ(parts.residue, Signal(100));
}

TEST_P(EmdEdge, OneSpikeIsResidue) {
  Signal spike(100);
  spike[40] = 1.0;
  const Decomposition parts = check(spike);
  EXPECT_TRUE(parts.imfs.empty());
  EXPECT_EQ(parts.residue, spike);
}

// Envelopes of an alternating signal are the constants 1 and -1: the mean is zero and the signal its own IMF.
TEST_P(EmdEdge, AlternatingSignalIsItsOwnMode) {
  Signal alternating(101);
  for (std::size_t t = 0; t < alternating.size(); ++t) {
    alternating[t] = t % 2 == 0 ? 1.0 : -1.0;
  }
  const Decomposition parts = check(alternating);
  ASSERT_EQ(parts.imfs.size(), 1U);
  EXPECT_EQ(parts.imfs[0], alternating);
}

// A square wave has its extrema at the middle of its flats. Turned around in time it is the same signal, and
// so must its modes be: a rule that takes either edge of a flat would move them by half a period.
TEST_P(EmdEdge, FlatTopIsOneExtremumAtItsMiddle) {
  Signal square(120);
  for (std::size_t t = 0; t < square.size(); ++t) {
    square[t] = t / 8 % 2 == 0 ? 1.0 : -1.0;
  }
  const Decomposition parts = check(square);
  ASSERT_FALSE(parts.imfs.empty());
  for (const Signal& imf : parts.imfs) {
    EXPECT_LE(peak(sum(imf, reversed(imf), -1.0)), 1e-12);
  }
}

TEST_P(EmdEdge, QuantisedNoiseIsDecomposed) {
  for (const double resolution : {0.1, 0.5, 2.0}) {
    check(quantised(white_noise(1024, 7), resolution));
  }
}

TEST_P(EmdEdge, HugeAndTinyNumbersDecomposeLikeOrdinaryOnes) {
  const std::size_t modes = check(white_noise(512, 8)).imfs.size();
  for (const double scale : {1e-290, 1e-200, 1e-3, 1e150, 1e300}) {
    EXPECT_EQ(check(times(white_noise(512, 8), scale)).imfs.size(), modes) << scale;
  }
}

// Denormal numbers round at 5e-324, whatever their size: complete to one such step a mode.
TEST_P(EmdEdge, DenormalNumbersStayFiniteAndAddUp) {
  for (const double scale : {1e-310, 1e-322}) {
    const Signal signal = times(white_noise(256, 9), scale);
    const Decomposition parts = decompose(signal, {.boundary = GetParam()});
    EXPECT_TRUE(is_finite(parts));
    EXPECT_EQ(completeness_error(parts, signal), 0.0) << "sums of denormal numbers are exact";
  }
}

TEST_P(EmdEdge, LargestNumbersStayFinite) {
  constexpr double kMax = std::numeric_limits<double>::max();
  Signal signal(200);
  for (std::size_t t = 0; t < signal.size(); ++t) {
    signal[t] = t * t % 7 < 3 ? kMax : -kMax;
  }
  EXPECT_TRUE(is_finite(decompose(signal, {.boundary = GetParam()})));
}

TEST_P(EmdEdge, HugeStepNextToTinyNoiseStaysFinite) {
  Signal signal = times(white_noise(1024, 10), 1e-300);
  signal[512] = 1e300;
  signal[513] = -1e300;
  EXPECT_TRUE(is_finite(decompose(signal, {.boundary = GetParam()})));
}

// Bursts far apart give envelopes with knots very unevenly spaced, which overshoot: a hundred sifts must not
// diverge.
TEST_P(EmdEdge, UnevenExtremaAndManySiftsStayFinite) {
  Signal signal(2000);
  for (std::size_t t = 0; t < signal.size(); ++t) {
    signal[t] =
        t % 500 < 6 ? std::pow(-1.0, t) * static_cast<double>(t % 500) : 1e-3 * static_cast<double>(t % 500);
  }
  EXPECT_TRUE(is_finite(decompose(signal, {.sifts = 100, .boundary = GetParam()})));
}

TEST_P(EmdEdge, EveryLengthUpToTheLargestWorksWithOneObject) {
  core::Emd emd(300, {.boundary = GetParam()});
  const Signal noise = white_noise(300, 11);
  for (std::size_t size = 1; size <= noise.size(); ++size) {
    const auto signal = std::span(noise).first(size);
    EXPECT_EQ(decompose(emd, signal), decompose(signal, {.boundary = GetParam()})) << size;
  }
}

}  // namespace
}  // namespace gyrod
