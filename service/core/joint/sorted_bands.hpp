/// The bands of a spectrum, quietest first. Internal to core/joint.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>

#include "core/joint/noise_shape.hpp"
#include "core/signal/moments.hpp"

namespace gyrod::core {

/// Where all bands are louder than believed, and so many of the quietest no further apart than this, these hold noise: roads differ by more.
/// Source: docs/decisions/0007, "A level that is far too low".
inline constexpr std::size_t kAlikeBands = 4;
inline constexpr double kAlike = 1.25;

/// A believed spectrum falls below this part of its second greatest band, as the greatest may be that of a line, where a sensor's low-pass stops:
/// what is left there, no model says to a quarter.
inline constexpr double kStopped = 0.1;

/// Where a believed spectrum is below this, a band tells nothing.
[[nodiscard]] inline double least_telling(BandPower believed) noexcept {
  std::ranges::nth_element(believed, believed.begin() + 1, std::greater{});
  return kStopped * believed[1];
}

/// The bands that tell something, quietest first.
class SortedBands {
 public:
  SortedBands(const BandPower& power, const BandPower& believed) noexcept {
    const double least = least_telling(believed);
    for (std::size_t band = 0; band < kNoiseBands; ++band) {
      if (believed[band] >= least) power_[count_++] = power[band];
    }
    std::sort(power_.begin(), power_.begin() + static_cast<std::ptrdiff_t>(count_));
  }
  [[nodiscard]] std::span<const double> all() const noexcept { return std::span(power_).first(count_); }

 private:
  BandPower power_{};
  std::size_t count_ = 0;
};

/// The quietest bands, or where the quietest is apart, as that of a line which is believed to be there, those next to it: so many, if they are
/// within a factor of one another; else none.
[[nodiscard]] inline std::span<const double> alike(std::span<const double> sorted, std::size_t count,
                                                   double factor) noexcept {
  for (std::size_t first = 0; first < 2 && first + count <= sorted.size(); ++first) {
    if (sorted[first + count - 1] <= factor * sorted[first]) return sorted.subspan(first, count);
  }
  return {};
}

/// Mean of the quietest bands, whether they are alike or not.
[[nodiscard]] inline double quietest_of(std::span<const double> sorted) noexcept {
  return mean(sorted.first(std::min(kAlikeBands, sorted.size())));
}

/// Mean of the quietest that are alike, else of the quietest.
[[nodiscard]] inline double quiet_level(std::span<const double> sorted) noexcept {
  const auto four = alike(sorted, kAlikeBands, kAlike);
  return four.empty() ? quietest_of(sorted) : mean(four);
}

}  // namespace gyrod::core
