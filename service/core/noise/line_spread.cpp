#include "core/noise/line_spread.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace gyrod::core {

NoiseSpectrum spread_lines(const NoiseSpectrum& power) noexcept {
  std::array<double, kNoiseBins + 1> below{};  // power of all bins before this one
  std::partial_sum(power.begin(), power.end(), below.begin() + 1);
  NoiseSpectrum result{};
  double sum = 0.0;
  for (std::size_t k = 0; k < kNoiseBins; ++k) {
    const auto reach = static_cast<std::size_t>(std::lround(kLineSpread * static_cast<double>(k)));
    const std::size_t first = k - reach;
    const std::size_t end = std::min(k + reach, kNoiseBins - 1) + 1;
    result[k] = reach == 0 ? power[k] : (below[end] - below[first]) / static_cast<double>(end - first);
    sum += result[k];
  }
  if (!(sum > 0.0)) return power;
  const double kept = below.back() / sum;
  for (double& bin : result) bin *= kept;
  return result;
}

}  // namespace gyrod::core
