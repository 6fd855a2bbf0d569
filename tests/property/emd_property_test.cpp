// What must hold for the decomposition of any finite signal, tried on random mixtures of what gyros give and
// of what no gyro gives.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "unit/core/emd/emd_support.hpp"

namespace gyrod {
namespace {

using core::BoundaryRule;
using core::Emd;
using core::EmdKernel;
using core::EmdOptions;
using namespace testing;

constexpr std::size_t kMaxSize = 1500;
constexpr unsigned kCases = 300;

/// Draws signals: any length, tones, noise, steps, spikes, quantisation, offset and scale, in random company.
class RandomSignals {
 public:
  explicit RandomSignals(unsigned seed) : bits_(seed) {}

  Signal next() {
    const auto size = static_cast<std::size_t>(std::pow(static_cast<double>(kMaxSize), uniform()));
    Signal signal(size);
    for (int tones = whole(3); tones > 0; --tones) {
      signal = sum(signal, tone(size, 0.5 * std::pow(uniform(), 3.0), 6.0 * uniform()), uniform());
    }
    if (chance(0.7)) {
      signal = sum(signal, white_noise(size, bits_() & 0xffffU), uniform());
    }
    for (int steps = whole(4); steps > 0; --steps) {
      const double step = uniform() - 0.5;
      std::for_each(signal.begin() + place(size), signal.end(), [step](double& value) { value += step; });
    }
    for (int spikes = whole(4); spikes > 0; --spikes) {
      signal[static_cast<std::size_t>(place(size))] += 20.0 * (uniform() - 0.5);
    }
    if (chance(0.4)) {
      signal = quantised(signal, 0.5 * uniform() + 1e-3);
    }
    if (chance(0.3)) {
      signal = sum(signal, Signal(size, 1.0), 1000.0 * uniform());
    }
    return times(signal, std::pow(10.0, 24.0 * uniform() - 12.0));
  }

  EmdOptions options() {
    return {.sifts = 1 + whole(20), .boundary = chance(0.5) ? BoundaryRule::kMirror : BoundaryRule::kLinear};
  }

 private:
  double uniform() { return std::uniform_real_distribution<double>()(bits_); }
  int whole(int below) { return std::uniform_int_distribution<int>(0, below - 1)(bits_); }
  bool chance(double probability) { return uniform() < probability; }
  std::ptrdiff_t place(std::size_t size) { return whole(static_cast<int>(size)); }

  std::mt19937 bits_;
};

/// Largest magnitude of any part: rounding is relative to it, and an envelope may overshoot the signal.
double largest_part(const Decomposition& parts) {
  double largest = peak(parts.residue);
  for (const Signal& imf : parts.imfs) {
    largest = std::max(largest, peak(imf));
  }
  return largest;
}

class EmdProperty : public ::testing::TestWithParam<unsigned> {
 protected:
  EmdProperty() : random_(GetParam()), signal_(random_.next()), options_(random_.options()) {}

  RandomSignals random_;
  Signal signal_;
  EmdOptions options_;
};

INSTANTIATE_TEST_SUITE_P(Random, EmdProperty, ::testing::Range(1U, kCases + 1));

TEST_P(EmdProperty, PartsAreFiniteAndAddUp) {
  const Decomposition parts = decompose(signal_, options_);
  EXPECT_TRUE(is_finite(parts));
  EXPECT_LE(completeness_error(parts, signal_), 1e-14 * std::max(peak(signal_), largest_part(parts)));
}

TEST_P(EmdProperty, UsedObjectGivesTheBitsOfAFreshOne) {
  Emd used(kMaxSize, options_);
  decompose(used, random_.next());
  const Decomposition first = decompose(used, signal_);
  EXPECT_TRUE(first == decompose(signal_, options_));
  EXPECT_TRUE(first == decompose(used, signal_));
}

TEST_P(EmdProperty, EveryVectorKernelGivesTheSameBits) {
  const Decomposition fastest = decompose(signal_, options_);
  for (const EmdKernel kernel : {EmdKernel::kBaseline, EmdKernel::kAvx2, EmdKernel::kAvx512}) {
    if (core::is_available(kernel)) {
      EXPECT_TRUE(decompose(signal_, options_, kernel) == fastest);
    }
  }
}

TEST_P(EmdProperty, ScalingByAPowerOfTwoChangesNoBit) {
  Decomposition scaled = decompose(times(signal_, 0x1p-40), options_);
  for (Signal& imf : scaled.imfs) {
    imf = times(imf, 0x1p40);
  }
  scaled.residue = times(scaled.residue, 0x1p40);
  EXPECT_TRUE(scaled == decompose(signal_, options_));
}

}  // namespace
}  // namespace gyrod
