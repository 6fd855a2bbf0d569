#include "core/noise/own_lines.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "core/signal/periodogram.hpp"
#include "support/signals.hpp"

namespace gyrod::core {
namespace {

using testing::Signal;

constexpr double kOwnLinesHz = 100.0;
/// Six minutes.
constexpr std::size_t kSixMinutes = 36'000;
constexpr std::size_t kOwnLinesHop = kNoiseSegment / 2;

/// White noise of 1 on each axis.
std::array<Signal, 3> white_axes() {
  return {testing::white_noise(kSixMinutes, 1), testing::white_noise(kSixMinutes, 2),
          testing::white_noise(kSixMinutes, 3)};
}

/// Noise of variance 1 within +- half_width_hz of hz, at half its height: an AR(2) of poles of radius r has a half width of -ln r / (2 pi).
Signal resonance(double hz, double half_width_hz, unsigned seed) {
  const double radius = std::exp(-2.0 * std::numbers::pi * half_width_hz / kOwnLinesHz);
  const std::array<double, 2> a = {2.0 * radius * std::cos(2.0 * std::numbers::pi * hz / kOwnLinesHz),
                                   -radius * radius};
  Signal signal = testing::autoregressive(a, kSixMinutes, seed);
  double power = 0.0;
  for (const double value : signal) power += value * value / static_cast<double>(kSixMinutes);
  return testing::times(std::move(signal), 1.0 / std::sqrt(power));
}

/// The lines that are known in the end; when the first was, s; and how often they changed.
struct OwnLinesFound {
  std::array<NoiseModel, 3> lines;
  double first_s = 0.0;
};

/// @param gap_every segments after which a gap is told; 0: none
OwnLinesFound find_own_lines(const std::array<Signal, 3>& axes, std::size_t gap_every = 0) {
  const auto own = std::make_unique<OwnLines>(static_cast<double>(kOwnLinesHop) / kOwnLinesHz);
  const auto transforms = std::make_unique<AxisTransforms>();
  Periodogram periodogram(kNoiseSegment);
  OwnLinesFound found;
  std::size_t segments = 0;
  for (std::size_t first = 0; first + kNoiseSegment <= axes[0].size(); first += kOwnLinesHop) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      NoiseSpectrum power;
      periodogram.transform(std::span(axes[axis]).subspan(first, kNoiseSegment), power);
      std::ranges::copy(periodogram.spectrum(), (*transforms)[axis].begin());
    }
    const auto before = own->lines();
    AxisSums sums;
    sums.add(*transforms);
    const bool changed = own->add(*transforms, sums);
    EXPECT_EQ(changed, own->lines() != before);
    if (changed && found.first_s == 0.0)
      found.first_s = static_cast<double>(first + kNoiseSegment) / kOwnLinesHz;
    if (gap_every > 0 && ++segments % gap_every == 0) own->interrupt();
  }
  found.lines = own->lines();
  return found;
}

std::size_t line_count(const OwnLinesFound& found) {
  return found.lines[0].line_count + found.lines[1].line_count + found.lines[2].line_count;
}

// As an ADIS16405's z axis has it at 20 Hz, 0.3 Hz to either side and a third of its power, under a road that is louder than the noise and slower.
TEST(OwnLines, FindsTheLineOfAnAxisUnderMotion) {
  auto axes = white_axes();
  axes[2] = testing::sum(axes[2], resonance(20.0, 0.3, 7), 0.7);
  const std::array<double, 2> road = {1.6, -0.8};
  for (std::size_t axis = 0; axis < 3; ++axis)
    axes[axis] = testing::sum(axes[axis],
                              testing::autoregressive(road, kSixMinutes, 20 + static_cast<unsigned>(axis)));
  const OwnLinesFound found = find_own_lines(axes);
  EXPECT_EQ(line_count(found), 1U);
  ASSERT_EQ(found.lines[2].line_count, 1U);
  EXPECT_NEAR(found.lines[2].line[0].cycles * kOwnLinesHz, 20.0, 0.15);
  // Its skirts, below half of what surrounds it, are not seen: up to a third of it.
  EXPECT_GT(found.lines[2].line[0].variance, 0.33);
  EXPECT_LT(found.lines[2].line[0].variance, 0.49);
  // Blocks of eight segments, a segment every 2.56 s and the first after twice that: two of them in a row, of three at most.
  EXPECT_GE(found.first_s, 17.0 * 2.56 - 0.01);
  EXPECT_LE(found.first_s, 25.0 * 2.56 + 0.01);
  EXPECT_FALSE(is_usable(found.lines[2])) << "nothing is known of the rest";
}

TEST(OwnLines, LeavesWhatAxesShare) {
  auto axes = white_axes();
  const Signal engine = resonance(20.0, 0.3, 7);
  axes[1] = testing::sum(axes[1], engine, 0.7);
  axes[2] = testing::sum(axes[2], engine, 0.5);
  EXPECT_EQ(line_count(find_own_lines(axes)), 0U);
}

TEST(OwnLines, LeavesWhatAxesThatAreCopiesShare) {
  auto axes = white_axes();
  axes[2] = testing::sum(axes[2], resonance(20.0, 0.3, 7), 0.7);
  axes[0] = axes[1] = axes[2];
  EXPECT_EQ(line_count(find_own_lines(axes)), 0U);
}

// A tone of a guard, a rotor: on one axis alone, and as strong now and then as it likes.
TEST(OwnLines, LeavesASineHoweverItsStrengthChanges) {
  auto steady = white_axes();
  steady[2] = testing::sum(steady[2], testing::tone(kSixMinutes, 0.2), 1.0);
  EXPECT_EQ(line_count(find_own_lines(steady)), 0U);
  auto changing = white_axes();
  Signal sine = testing::tone(kSixMinutes, 0.2);
  const Signal strength = resonance(0.05, 0.02, 9);
  for (std::size_t n = 0; n < kSixMinutes; ++n) sine[n] *= strength[n];
  changing[2] = testing::sum(changing[2], sine, 1.0);
  EXPECT_EQ(line_count(find_own_lines(changing)), 0U);
}

// Two rotors, so near to one another that they look like one line of some width.
TEST(OwnLines, LeavesTwoSinesSideBySide) {
  auto axes = white_axes();
  for (const double bins : {102.0, 103.2})
    axes[2] = testing::sum(axes[2], testing::tone(kSixMinutes, bins / kNoiseSegment), 1.0);
  EXPECT_EQ(line_count(find_own_lines(axes)), 0U);
}

// An engine at one speed wavers less than a sensor does: a third of a bin to either side.
TEST(OwnLines, LeavesWhatIsNarrowerThanASensorsLine) {
  auto axes = white_axes();
  axes[2] = testing::sum(axes[2], resonance(20.0, 0.07, 7), 1.0);
  EXPECT_EQ(line_count(find_own_lines(axes)), 0U);
}

TEST(OwnLines, ForgetsWhatEnds) {
  auto axes = white_axes();
  Signal line = resonance(20.0, 0.3, 7);
  axes[2] = testing::sum(axes[2], line, 0.7);
  EXPECT_EQ(line_count(find_own_lines(axes)), 1U);
  axes = white_axes();
  std::fill(line.begin() + 3 * kSixMinutes / 4, line.end(), 0.0);
  axes[2] = testing::sum(axes[2], line, 0.7);
  EXPECT_EQ(line_count(find_own_lines(axes)), 0U);
}

// What a knock makes ring: 20 Hz, decaying within a second, once in half a minute.
TEST(OwnLines, LeavesWhatKnocksMakeRing) {
  auto axes = white_axes();
  for (std::size_t knock = 1000; knock + 300 < kSixMinutes; knock += 3000) {
    for (std::size_t n = 0; n < 300; ++n)
      axes[2][knock + n] += 12.0 * std::exp(-0.02 * static_cast<double>(n)) *
                            std::cos(2.0 * std::numbers::pi * 0.2 * static_cast<double>(n));
  }
  EXPECT_EQ(line_count(find_own_lines(axes)), 0U);
}

TEST(OwnLines, LeavesAnAxisOfManyLines) {
  auto axes = white_axes();
  for (const double hz : {13.0, 20.0, 31.0})
    axes[2] = testing::sum(axes[2], resonance(hz, 0.3, static_cast<unsigned>(hz)), 0.7);
  EXPECT_EQ(line_count(find_own_lines(axes)), 0U);
}

// A glitch whose square no number holds is left out, and what was averaged stays.
TEST(OwnLines, LeavesOutWhatIsNotFinite) {
  auto axes = white_axes();
  axes[2] = testing::sum(axes[2], resonance(20.0, 0.3, 7), 0.7);
  axes[1][kSixMinutes / 2] = 1e200;
  EXPECT_EQ(line_count(find_own_lines(axes)), 1U);
}

TEST(OwnLines, FindsNothingInNoise) { EXPECT_EQ(line_count(find_own_lines(white_axes())), 0U); }

// Phases across a gap say nothing: a sine is then as good as any line, and is left.
TEST(OwnLines, TellsNothingWhereGapsAreTooMany) {
  auto axes = white_axes();
  axes[2] = testing::sum(axes[2], resonance(20.0, 0.3, 7), 0.7);
  EXPECT_EQ(line_count(find_own_lines(axes, 2)), 0U);
  EXPECT_EQ(line_count(find_own_lines(axes, 10)), 1U);
}

}  // namespace
}  // namespace gyrod::core
