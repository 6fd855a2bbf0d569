#include "core/signal/periodogram.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "support/signals.hpp"

namespace gyrod::core {
namespace {

using testing::Signal;

std::vector<double> power_of(const Signal& signal) {
  Periodogram periodogram(signal.size());
  std::vector<double> power(periodogram.bins());
  periodogram.transform(signal, power);
  return power;
}

TEST(Periodogram, OfWhiteNoiseIsItsVarianceAtEveryFrequency) {
  // 2000 segments: a bin has a standard error of 1 / sqrt(2000) = 2.2 %, the mean of all 254 bins one of 0.2 %.
  Periodogram periodogram(512);
  std::vector<double> power(periodogram.bins());
  std::vector<double> sum(periodogram.bins());
  const Signal noise = testing::times(testing::white_noise(2000 * 512, 3), 2.0);
  for (std::size_t i = 0; i < 2000; ++i) {
    periodogram.transform(std::span(noise).subspan(i * 512, 512), power);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += power[k] / 2000.0;
  }
  double all = 0.0;
  for (std::size_t k = 3; k < sum.size(); ++k) {
    // The bin at half the sample rate is real, of twice the relative variance.
    EXPECT_NEAR(sum[k], 4.0, 4.0 * 5.0 * 0.032) << k;
    all += sum[k] / 254.0;
  }
  EXPECT_NEAR(all, 4.0, 4.0 * 4.0 * 0.002);
}

TEST(Periodogram, IgnoresAStraightLine) {
  const Signal noise = testing::white_noise(512, 5);
  Signal leaning = noise;
  for (std::size_t n = 0; n < leaning.size(); ++n) leaning[n] += 100.0 - 0.3 * static_cast<double>(n);
  const auto expected = power_of(noise);
  const auto found = power_of(leaning);
  // Rounding only: 1e-13 of the line's 153, squared against powers near 1.
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-10) << k;
}

TEST(Periodogram, KeepsAToneWithinThreeBins) {
  // A tone of amplitude 1 on bin 100 has power 1/2; Hann's side lobes vanish at whole bins beyond the next one.
  const auto power = power_of(testing::tone(512, 100.0 / 512.0));
  const double total = 2.0 * std::accumulate(power.begin(), power.end(), 0.0) / 512.0;
  EXPECT_NEAR(2.0 * (power[99] + power[100] + power[101]) / 512.0, total, 1e-3 * total);
  EXPECT_GT(power[100], power[99]);
  EXPECT_LT(power[140], 1e-6 * power[100]);
}

TEST(Periodogram, ReturnsTheVarianceAboutTheLine) {
  Signal line(64);
  std::iota(line.begin(), line.end(), 0.0);
  Periodogram periodogram(64);
  std::vector<double> power(33);
  EXPECT_NEAR(periodogram.transform(line, power), 0.0, 1e-25);
  const Signal tone = testing::tone(64, 0.25);  // 1, 0, -1, 0: mean square 1/2, and next to no line
  EXPECT_NEAR(periodogram.transform(tone, power), 0.5, 1e-3);
}

}  // namespace
}  // namespace gyrod::core
