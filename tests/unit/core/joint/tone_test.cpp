#include "core/joint/tone.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/joint/recency_tapers.hpp"
#include "support/signals.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kWindow = 1024;

Tone tone_of(const testing::Signal& x) {
  RecencyTapers tapers(kWindow, 2, 3.0);
  std::vector<double> power(tapers.bins());
  tapers.spectrum(x, power);
  return find_tone(power);
}

TEST(FindTone, GivesFrequencyAndAmplitude) {
  // The tone of drive0708: 31 Hz at 100 Hz. Half a bin, and what the recency of the tapers leaves of a stationary amplitude.
  for (const double amplitude : {0.5, 3.0}) {
    const auto x = testing::sum(testing::times(testing::tone(kWindow, 0.31), amplitude),
                                testing::white_noise(kWindow, 1), 0.1);
    const Tone found = tone_of(x);
    EXPECT_NEAR(found.frequency_cycles, 0.31, 0.5 / kWindow);
    EXPECT_NEAR(found.amplitude, amplitude, 0.1 * amplitude);
  }
}

TEST(FindTone, SeesNoneInWhiteNoise) {
  int found = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    if (tone_of(testing::white_noise(kWindow, seed)).amplitude > 0.0) ++found;
  }
  EXPECT_LE(found, 2);
}

TEST(FindTone, SeesNoneInSlowMotionOrNothing) {
  EXPECT_EQ(tone_of(testing::tone(kWindow, 0.003)).amplitude, 0.0);
  EXPECT_EQ(tone_of(testing::Signal(kWindow)).amplitude, 0.0);
  EXPECT_EQ(find_tone(std::vector<double>(20, 1.0)).amplitude, 0.0);
}

}  // namespace
}  // namespace gyrod::core
