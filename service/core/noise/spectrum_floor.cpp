#include "core/noise/spectrum_floor.hpp"

#include <algorithm>

namespace gyrod::core {

double median_around(const NoiseSpectrum& power, std::size_t bin, std::size_t reach) noexcept {
  const std::size_t first = std::max(bin, kFirstNoiseBin + reach) - reach;
  const std::size_t end = std::min(bin + reach + 1, kNoiseBins);
  NoiseSpectrum near{};
  const auto count = static_cast<std::ptrdiff_t>(end - first);
  std::copy_n(power.begin() + static_cast<std::ptrdiff_t>(first), count, near.begin());
  std::nth_element(near.begin(), near.begin() + count / 2, near.begin() + count);
  return near[static_cast<std::size_t>(count / 2)];
}

}  // namespace gyrod::core
