#include "core/noise/line_share.hpp"

#include <algorithm>

#include "core/noise/spectrum_floor.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kNeighbours = 12;
constexpr double kStandsOut = 2.5;

}  // namespace

double line_share(const NoiseSpectrum& power) noexcept {
  double lines = 0.0;
  double all = 0.0;
  for (std::size_t bin = kFirstNoiseBin; bin < kNoiseBins; ++bin) {
    all += power[bin];
    lines += std::max(0.0, power[bin] - kStandsOut * median_around(power, bin, kNeighbours));
  }
  return all > 0.0 ? lines / all : 0.0;
}

}  // namespace gyrod::core
