#include "core/joint/noise_peak.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace gyrod::core {
namespace {

constexpr double kStandsOut = 2.5;
/// In parts of the bins.
constexpr std::size_t kSlowShare = 20;

struct Band {
  std::size_t first;
  std::size_t end;
};

Band around(std::size_t peak, std::size_t bins) noexcept {
  const auto reach = static_cast<std::size_t>(std::lround(NoisePeak::kReach * static_cast<double>(peak)));
  return {peak - reach, std::min(peak + reach + 1, bins)};
}

}  // namespace

bool NoisePeak::reaches(double centre_cycles) const noexcept {
  return power > 0.0 && std::abs(centre_cycles - cycles) <= kReach * cycles;
}

NoisePeak noise_peak(std::span<const double> spectrum) noexcept {
  assert(spectrum.size() >= 64);
  const std::size_t bins = spectrum.size();
  const std::size_t first = bins / kSlowShare;
  const auto highest =
      std::max_element(spectrum.begin() + static_cast<std::ptrdiff_t>(first), spectrum.end());
  const auto peak = static_cast<std::size_t>(highest - spectrum.begin());
  const Band band = around(peak, bins);
  double elsewhere = 0.0;
  double count = 0.0;
  for (std::size_t k = first; k < bins; ++k) {
    if (k >= band.first && k < band.end) continue;
    elsewhere += spectrum[k];
    ++count;
  }
  if (!(count > 0.0) || !(*highest * count > kStandsOut * elsewhere)) return {};
  NoisePeak result{.cycles = 0.5 * static_cast<double>(peak) / static_cast<double>(bins - 1),
                   .surroundings = elsewhere / count,
                   .first_bin = band.first,
                   .end_bin = band.end};
  for (std::size_t k = band.first; k < band.end; ++k)
    result.power += std::max(0.0, spectrum[k] - result.surroundings) / static_cast<double>(bins);
  return result;
}

void share_with_line(const NoisePeak& peak, double expected, std::span<ModeNearLine> modes) noexcept {
  // Innovation over variance, the spectral flatness: 0 for a line, 1 for white noise.
  std::ranges::sort(modes, {}, [](const ModeNearLine& near) { return near.mode->drive / near.power; });
  double missing = std::max(peak.power - expected, 0.0);
  double left = std::max(NoisePeak::kMostPower * peak.power - expected, 0.0);
  for (const auto& [mode, power] : modes) {
    double line = power;
    if (power > left) line = std::lerp(left, std::min(missing, left), std::min(power / left - 1.0, 1.0));
    left -= line;
    missing = std::max(missing - line, 0.0);
    mode->share = 1.0 - line / power;
  }
}

}  // namespace gyrod::core
