#include "core/joint/tone.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gyrod::core {
namespace {

/// Bins that a line spreads over to each side, and that its neighbourhood then reaches beyond.
constexpr std::size_t kLine = 6;
constexpr std::size_t kAround = 16;
constexpr std::size_t kFirstBin = 16;

/// Median of the bins kLine+1 .. kLine+kAround away on one side.
double median_beside(std::span<const double> periodogram, std::size_t begin) noexcept {
  std::array<double, kAround> values{};
  std::copy_n(periodogram.begin() + static_cast<std::ptrdiff_t>(begin), kAround, values.begin());
  const auto middle = values.begin() + kAround / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

Tone find_tone(std::span<const double> periodogram) noexcept {
  constexpr std::size_t kReach = kLine + kAround;
  const std::size_t first = std::max(kFirstBin, kReach);
  if (periodogram.size() <= first + kReach) return {};
  const std::size_t last = periodogram.size() - kReach - 1;
  const auto begin = periodogram.begin();
  const auto peak =
      std::max_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(last));
  const auto k = static_cast<std::size_t>(peak - begin);
  const double floor =
      std::max(median_beside(periodogram, k - kReach), median_beside(periodogram, k + kLine + 1));
  if (!(*peak > kToneRatio * floor)) return {};
  double power = 0.0;
  double moment = 0.0;
  for (std::size_t bin = k - kLine; bin <= k + kLine; ++bin) {
    const double above = std::max(periodogram[bin] - floor, 0.0);
    power += above;
    moment += above * static_cast<double>(bin);
  }
  const double samples = 2.0 * static_cast<double>(periodogram.size() - 1);
  // Its variance, amplitude^2 / 2, is the sum over the bins of both signs over their number.
  return {moment / power / samples, std::sqrt(4.0 * power / samples)};
}

}  // namespace gyrod::core
