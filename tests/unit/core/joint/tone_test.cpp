#include "core/joint/tone.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/joint/joint_options.hpp"
#include "core/joint/recency_tapers.hpp"
#include "support/signals.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kWindow = 1024;

Tone found_in(const testing::Signal& x, double least_prominence = kSureTone) {
  RecencyTapers tapers(kWindow, 2, 3.0);
  std::vector<double> power(tapers.bins());
  tapers.spectrum(x, power);
  return find_tone(power, least_prominence);
}

testing::Signal tone_of(double amplitude, double frequency) {
  return testing::times(testing::tone(kWindow, frequency), amplitude);
}

TEST(FindTone, GivesFrequencyAndAmplitude) {
  // The tone of drive0708: 31 Hz at 100 Hz. Half a bin, and what the recency of the tapers leaves of a stationary amplitude.
  for (const double amplitude : {0.5, 3.0}) {
    const Tone found =
        found_in(testing::sum(tone_of(amplitude, 0.31), testing::white_noise(kWindow, 1), 0.1));
    EXPECT_NEAR(found.frequency_cycles, 0.31, 0.5 / kWindow);
    EXPECT_NEAR(found.amplitude, amplitude, 0.1 * amplitude);
  }
}

// Two modes in a row at 0.95 fall off with the fourth power of the frequency: below 0.03 the motion is higher than the tone.
TEST(FindTone, SeesATonePastStrongerMotion) {
  const auto motion = testing::autoregressive(std::vector<double>{1.9, -0.9025}, kWindow, 1);
  const Tone found = found_in(testing::sum(tone_of(2.0, 0.0945), motion));
  EXPECT_NEAR(found.frequency_cycles, 0.0945, 0.5 / kWindow);
  EXPECT_NEAR(found.amplitude, 2.0, 0.4);
  EXPECT_EQ(found_in(motion).amplitude, 0.0);
}

// Of three tones the one counts that stands out most: not the strongest, which is where motion is strong, too, nor the last.
TEST(FindTone, PrefersTheToneThatStandsOut) {
  const auto motion = testing::autoregressive(std::vector<double>{1.9, -0.9025}, kWindow, 1);
  const auto x = testing::sum(testing::sum(motion, tone_of(3.0, 0.0945)),
                              testing::sum(tone_of(2.0, 0.3), tone_of(0.5, 0.45)));
  EXPECT_NEAR(found_in(x).frequency_cycles, 0.3, 0.5 / kWindow);
}

TEST(FindTone, TellsHowFarItStandsOut) {
  const auto x = testing::sum(tone_of(0.3, 0.2), testing::white_noise(kWindow, 1));
  const double prominence = found_in(x, 5.0).prominence;
  EXPECT_GT(prominence, 5.0);
  EXPECT_GT(found_in(x, 0.99 * prominence).amplitude, 0.0);
  EXPECT_EQ(found_in(x, 1.01 * prominence).amplitude, 0.0);
}

// Of 10 000 windows of this kind 102 show a line of prominence 11 or more, 54 one of 12, 1 one of 18, none one of 20.
TEST(FindTone, SeesNoneInWhiteNoise) {
  int likely = 0;
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    const auto x = testing::white_noise(kWindow, seed);
    EXPECT_EQ(found_in(x).amplitude, 0.0) << "seed " << seed;
    if (found_in(x, JointOptions{}.tone_prominence).amplitude > 0.0) ++likely;
  }
  EXPECT_LE(likely, 20);
}

TEST(FindTone, SeesNoneInSlowMotionOrNothing) {
  EXPECT_EQ(found_in(testing::tone(kWindow, 0.003)).amplitude, 0.0);
  EXPECT_EQ(found_in(testing::Signal(kWindow)).amplitude, 0.0);
  EXPECT_EQ(find_tone(std::vector<double>(20, 1.0), kSureTone).amplitude, 0.0);
}

// A line of 100 with shoulders of 20 over five bins, beside 4 below it and 16, 15, .. 1 above it, whose ninth is 9: it stands in 6. Above that are 94 and
// ten times 14; two bins below 6 count as none. amplitude^2 / 2 is that over 512, twice.
TEST(FindTone, IsMeasuredByWhatStandsAboveItsSurroundings) {
  constexpr std::size_t kSize = 257;
  constexpr std::size_t kAt = 120;
  std::vector<double> power(kSize, 1.0);
  std::fill_n(power.begin(), kAt - kToneReach, 4.0);
  std::fill_n(power.begin() + kAt - kToneReach, 2 * kToneReach + 1, 20.0);
  power[kAt] = 100.0;
  power[kAt - kToneReach] = power[kAt + kToneReach] = 2.0;
  for (std::size_t i = 0; i < 16; ++i) power[kAt + kToneReach + 1 + i] = 16.0 - static_cast<double>(i);
  const Tone found = find_tone(power, 12.0);
  EXPECT_NEAR(found.prominence, 100.0 / 6.0, 1e-12);
  EXPECT_NEAR(found.frequency_cycles, static_cast<double>(kAt) / 512.0, 1e-12);
  EXPECT_NEAR(found.amplitude, std::sqrt(2.0 * 2.0 * (94.0 + 10.0 * 14.0) / 512.0), 1e-12);
}

// Tones are looked for from 22 periods a transform on, and as far from the other end.
TEST(FindTone, LooksWhereThereAreSurroundingsOnBothSides) {
  constexpr std::size_t kSize = 257;
  constexpr std::size_t kSides = kToneReach + 16;
  for (std::size_t at = 0; at < kSize; ++at) {
    std::vector<double> power(kSize, 1.0);
    power[at] = 100.0;
    const Tone found = find_tone(power, 12.0);
    const bool within = at >= kSides && at + kSides < kSize;
    EXPECT_NEAR(found.prominence, within ? 100.0 : 0.0, 1e-12) << at;
    EXPECT_NEAR(found.frequency_cycles, within ? static_cast<double>(at) / 512.0 : 0.0, 1e-12) << at;
  }
}

}  // namespace
}  // namespace gyrod::core
