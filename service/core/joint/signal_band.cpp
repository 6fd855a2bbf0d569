#include "core/joint/signal_band.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/signal/portable_math.hpp"
#include "core/signal/sums.hpp"

namespace gyrod::core {
namespace {

constexpr double kPeriods = 8.0;
constexpr int kSignificantBits = 10;

double rounded(double cycles) noexcept {
  int exponent = 0;
  const double significand = std::frexp(cycles, &exponent);
  return std::ldexp(std::round(std::ldexp(significand, kSignificantBits)), exponent - kSignificantBits);
}

}  // namespace

void SignalBand::set(double cycles) noexcept {
  cycles = cycles > 0.0 && cycles < 0.5 ? std::min(rounded(cycles), 0.5) : 0.5;
  if (cycles == cycles_) return;
  cycles_ = cycles;
  reach_ = limits() ? static_cast<std::size_t>(std::min<double>(kPeriods / cycles, kMaxReach)) : 0;
  taps_ = {1.0};
  if (!limits()) return;
  const auto reach = static_cast<double>(reach_);
  double sum = 0.0;
  for (std::size_t i = 0; i <= 2 * reach_; ++i) {
    const double j = static_cast<double>(i) - reach;
    const double window = 0.54 + 0.46 * portable_sine_cosine(0.5 * j / (reach + 0.5)).cosine;
    const double sinc =
        i == reach_ ? 2.0 * cycles : portable_sine_cosine(cycles * j).sine / (std::numbers::pi * j);
    taps_[i] = window * sinc;
    sum += taps_[i];
  }
  for (double& tap : taps_) tap /= sum;
}

double SignalBand::gain(double cycles) const noexcept {
  const double cosine = portable_sine_cosine(cycles).cosine;
  double before = 1.0;
  double now = cosine;
  double sum = taps_[reach_];
  for (std::size_t j = 1; j <= reach_; ++j) {
    sum += 2.0 * taps_[reach_ + j] * now;
    const double next = 2.0 * cosine * now - before;
    before = now;
    now = next;
  }
  return sum;
}

std::vector<double> low_passed(std::span<const double> x, const SignalBand& band) {
  const std::span<const double> taps = band.taps();
  std::vector<double> result(x.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t first = 0; first + taps.size() <= x.size(); ++first)
    result[first + band.reach()] = dot(taps, x.subspan(first, taps.size()));
  return result;
}

}  // namespace gyrod::core
