// The noise line against fresh noise, and its two readings against each other.
#include "core/denoise/noise_line.hpp"

#include <array>

#include <gtest/gtest.h>

#include "core/emd/emd.hpp"
#include "core/signal/moments.hpp"
#include "support/signals.hpp"

namespace gyrod {
namespace {

using namespace testing;

// 1000 windows with other seeds than the table's: its standard errors, 0.2 % for IMF 1 and 3 % for IMF 8,
// four times.
TEST(NoiseLine, IsWhatTheDefaultEmdMakesOfWhiteNoise) {
  constexpr std::size_t kSize = 1024;
  constexpr unsigned kSeeds = 1000;
  constexpr std::array kTolerance{0.008, 0.01, 0.015, 0.02, 0.03, 0.04, 0.06, 0.12};
  std::array<double, kTolerance.size()> energy{};
  std::array<double, kTolerance.size()> windows{};
  core::Emd emd(kSize);
  Signal imf(kSize);
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    emd.start(white_noise(kSize, 1000000 + seed));
    for (std::size_t i = 0; i < energy.size() && emd.next_imf(imf); ++i) {
      energy[i] += core::variance(imf);
      windows[i] += 1.0;
    }
  }
  for (std::size_t i = 0; i < energy.size(); ++i) {
    EXPECT_NEAR(energy[i] / windows[i] / core::noise_line_energy(i + 1), 1.0, kTolerance[i])
        << "IMF " << i + 1;
  }
}

TEST(NoiseLine, HalvesFromModeToModeBeyondItsTable) {
  for (std::size_t imf = 9; imf < 32; ++imf) {
    EXPECT_EQ(core::noise_line_energy(imf + 1), 0.5 * core::noise_line_energy(imf)) << imf;
  }
}

TEST(NoiseLine, FallsFromModeToMode) {
  for (std::size_t imf = 1; imf < 32; ++imf) {
    EXPECT_LT(core::noise_line_energy(imf + 1), 0.56 * core::noise_line_energy(imf)) << imf;
  }
}

TEST(NoiseLine, TellsTheNoiseFromTheFirstMode) {
  EXPECT_NEAR(core::white_noise_variance(core::noise_line_energy(1)), 1.0, 1e-15);
  EXPECT_EQ(core::white_noise_variance(0.0), 0.0);
}

// The part from a mode on less the part from the next one on is the mode; 60 modes hold all but 2^-50 of the
// last.
TEST(NoiseLine, RestIsTheSumOfTheModes) {
  for (std::size_t first = 1; first <= 14; ++first) {
    double sum = 0.0;
    for (std::size_t imf = first; imf < first + 60; ++imf) {
      sum += core::noise_line_energy(imf);
    }
    EXPECT_NEAR(core::noise_line_rest(first), sum, 1e-14) << first;
  }
}

}  // namespace
}  // namespace gyrod
