#include "core/noise/line_share.hpp"

#include <algorithm>

namespace gyrod::core {
namespace {

constexpr std::size_t kFirst = 3;  ///< below it are bias and drift
constexpr std::size_t kNeighbours = 12;
constexpr double kStandsOut = 2.5;

double median_around(const NoiseSpectrum& power, std::size_t bin) noexcept {
  const std::size_t first = std::max(kFirst + kNeighbours, bin) - kNeighbours;
  const std::size_t last = std::min(bin + kNeighbours, kNoiseBins - 1);
  std::array<double, 2 * kNeighbours + 1> near{};
  const auto begin = power.begin() + static_cast<std::ptrdiff_t>(first);
  const auto count = static_cast<std::ptrdiff_t>(last - first + 1);
  std::copy_n(begin, count, near.begin());
  std::nth_element(near.begin(), near.begin() + count / 2, near.begin() + count);
  return near[static_cast<std::size_t>(count / 2)];
}

}  // namespace

double line_share(const NoiseSpectrum& power) noexcept {
  double lines = 0.0;
  double all = 0.0;
  for (std::size_t bin = kFirst; bin < kNoiseBins; ++bin) {
    all += power[bin];
    lines += std::max(0.0, power[bin] - kStandsOut * median_around(power, bin));
  }
  return all > 0.0 ? lines / all : 0.0;
}

}  // namespace gyrod::core
