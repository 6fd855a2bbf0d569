#include "core/denoise/significance.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "core/denoise/noise_line.hpp"

namespace gyrod::core {
namespace {

// nu T / N
// From 5000 windows of N = 4096 samples of white noise, IMF 1 where the noise's level is known, the others in parts of the level that IMF 1
// of the same window gives:
//   emd_noise_line 5000
// (tests/benchmark/emd_noise_line.cpp). At N = 512, 1024 and 2048 the values for IMF 2..8 are within 11 % of these
// wherever nu is above 5; of the tails that matters little (docs/method.md, The noise line, has the rates).
constexpr std::array<double, 9> kShape = {1.61, 0.93, 0.93, 0.95, 1.02, 1.04, 1.09, 1.07, 1.10};

double two_sided_tail(double deviations) noexcept { return std::erfc(deviations / std::numbers::sqrt2); }

/// Where the two-sided tail of a normal variable has this probability, by halving.
double deviations_of(double probability) noexcept {
  double low = 0.0;
  double high = 6.0;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (two_sided_tail(middle) > probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Variance of the cube root of the excess; 1 less this is its mean.
double cube_root_variance(std::size_t imf, std::size_t samples) noexcept {
  return 2.0 / (9.0 * noise_freedom(imf, samples));
}

double cube(double value) noexcept { return value * value * value; }

}  // namespace

double noise_freedom(std::size_t imf, std::size_t samples) noexcept {
  assert(imf >= 1);
  const double shape = kShape[std::min(imf, kShape.size()) - 1];
  return std::max(1.0, shape * static_cast<double>(samples) / noise_line_period(imf));
}

SignificanceTest::SignificanceTest(double false_alarm_rate) : deviations_(deviations_of(false_alarm_rate)) {
  if (!(false_alarm_rate >= 1e-6 && false_alarm_rate <= 0.5)) {
    throw std::invalid_argument("false-alarm rate is " + std::to_string(false_alarm_rate) +
                                ", expected 1e-6 to 0.5");
  }
}

NoiseBand SignificanceTest::band(std::size_t imf, std::size_t samples) const noexcept {
  const double v = cube_root_variance(imf, samples);
  const double reach = deviations_ * std::sqrt(v);
  return {.lower = cube(std::max(0.0, 1.0 - v - reach)), .upper = cube(1.0 - v + reach)};
}

double SignificanceTest::p_value(double excess, std::size_t imf, std::size_t samples) noexcept {
  if (!(excess >= 0.0)) return 0.0;
  const double v = cube_root_variance(imf, samples);
  return two_sided_tail(std::abs(std::cbrt(excess) - (1.0 - v)) / std::sqrt(v));
}

void SignificanceTest::judge(ImfFigures& figures, std::size_t imf, std::size_t samples) const noexcept {
  const NoiseBand of_noise = band(imf, samples);
  figures.noise_excess_low = of_noise.lower;
  figures.noise_excess_high = of_noise.upper;
  figures.noise_probability = p_value(figures.excess, imf, samples);
}

}  // namespace gyrod::core
