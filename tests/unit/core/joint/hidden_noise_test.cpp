// Noise that a sensor's own low-pass hides: docs/joint.md, "What is reported".
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/joint/noise_tracker.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kBins = 513;
using Spectrum = std::vector<double>;

/// `upper` in the upper bands, 100 in the others.
Spectrum ending_in(const std::vector<double>& upper) {
  Spectrum bins(kBins, 100.0);
  const std::size_t width = (kBins - 1) / kNoiseBands;
  for (std::size_t k = 0; k < upper.size() * width; ++k)
    bins[kBins - 1 - k] = upper[upper.size() - 1 - k / width];
  return bins;
}

/// What a tracker makes of so many windows, a thirty-second of each new.
NoiseTracker after_windows(const std::vector<double>& upper, int windows, const NoiseModel& believed = {}) {
  constexpr double kShare = 1.0 / 32.0;
  NoiseTracker tracker;
  for (int i = 0; i < windows; ++i)
    tracker.observe(ending_in(upper), Spectrum(kBins, 1.0), believed, kShare, kShare);
  return tracker;
}

/// |H|^2 of a second-order Butterworth low-pass at 0.2 of the rate, 1 / (1 + (tan(pi f) / tan(0.2 pi))^4), in the middle of the upper four bands, where 100 is
/// its flat part.
std::vector<double> second_order() {
  std::vector<double> upper;
  for (const double band : {4.5, 5.5, 6.5, 7.5}) {
    const double cycles = 0.5 * band / static_cast<double>(kNoiseBands);
    const double ratio = std::tan(std::numbers::pi * cycles) / std::tan(0.2 * std::numbers::pi);
    upper.push_back(100.0 / (1.0 + std::pow(ratio, 4)));
  }
  return upper;
}

TEST(HiddenNoise, IsWhatFallsToHalfTheSampleRate) {
  const auto hidden = [](const std::vector<double>& upper, const NoiseModel& believed = {}) {
    return after_windows(upper, 32, believed).is_hidden();
  };
  NoiseModel measured = white_noise(1.0);
  measured.line_count = 1;
  measured.line[0] = {.cycles = 0.2, .half_width = 0.001, .variance = 0.1};
  EXPECT_TRUE(hidden(second_order()));
  EXPECT_TRUE(hidden({16.0, 5.1, 0.5, 0.5})) << "leakage after all has gone";
  EXPECT_FALSE(hidden({16.0, 5.1, 5.0, 5.0})) << "a floor";
  EXPECT_FALSE(hidden({2.9, 2.0, 1.4, 1.05}))
      << "tumvi_room1 x, whole, Welch of 1024 samples: behind 75 Hz at 200";
  EXPECT_FALSE(hidden({1.0, 1.0, 1.0, 1.0}));
  EXPECT_FALSE(hidden({120.0, 16.0, 5.1, 0.99})) << "an engine";
  EXPECT_FALSE(hidden(second_order(), measured)) << "its noise is known";
  EXPECT_FALSE(hidden(second_order(), white_noise(1.0)));
  EXPECT_FALSE(NoiseTracker().is_hidden());
}

TEST(HiddenNoise, IsNotToldByTheBeginningOfAWindow) {
  for (int windows = 1; windows <= 32; ++windows)
    EXPECT_EQ(after_windows(second_order(), windows).is_hidden(), windows == 32) << windows;
}

}  // namespace
}  // namespace gyrod::core
