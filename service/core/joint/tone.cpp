#include "core/joint/tone.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace gyrod::core {
namespace {

/// Bins beyond a line, on each side, that tell what surrounds it.
constexpr std::size_t kAround = 16;
constexpr std::size_t kNeighbourhood = kToneReach + kAround;

double median_of(std::span<const double> bins) noexcept {
  std::array<double, kAround> values{};
  std::ranges::copy(bins, values.begin());
  const auto middle = values.begin() + kAround / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

bool is_peak(std::span<const double> periodogram, std::size_t k) noexcept {
  return periodogram[k] >= std::ranges::max(periodogram.subspan(k - kToneReach, 2 * kToneReach + 1));
}

double surroundings(std::span<const double> periodogram, std::size_t k) noexcept {
  return std::sqrt(median_of(periodogram.subspan(k - kNeighbourhood, kAround)) *
                   median_of(periodogram.subspan(k + kToneReach + 1, kAround)));
}

Tone tone_at(std::span<const double> periodogram, std::size_t k, double around) noexcept {
  double power = 0.0;
  double moment = 0.0;
  for (std::size_t bin = k - kToneReach; bin <= k + kToneReach; ++bin) {
    const double above = std::max(periodogram[bin] - around, 0.0);
    power += above;
    moment += above * static_cast<double>(bin);
  }
  const double samples = 2.0 * static_cast<double>(periodogram.size() - 1);
  // Its variance, amplitude^2 / 2, is the sum over the bins of both signs over their number.
  return {.frequency_cycles = moment / power / samples,
          .amplitude = std::sqrt(4.0 * power / samples),
          .prominence = periodogram[k] / around};
}

}  // namespace

Tone find_tone(std::span<const double> periodogram, double least_prominence) noexcept {
  std::size_t best = 0;
  double around = 0.0;
  double prominence = least_prominence;
  for (std::size_t k = kNeighbourhood; k + kNeighbourhood < periodogram.size(); ++k) {
    if (!is_peak(periodogram, k)) continue;
    const double beside = surroundings(periodogram, k);
    if (!(periodogram[k] > prominence * beside)) continue;
    best = k;
    around = beside;
    prominence = periodogram[k] / beside;
  }
  return best > 0 ? tone_at(periodogram, best, around) : Tone{};
}

}  // namespace gyrod::core
