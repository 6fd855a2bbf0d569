#include "core/noise/line_share.hpp"

#include <algorithm>

#include "core/noise/spectrum_floor.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kNeighbours = 12;
constexpr double kStandsOut = 2.5;

constexpr int kLinesOfASensor = 2;
constexpr std::size_t kLineReach = 4;
constexpr std::size_t kLineReachShare = 16;

/// What stands out, bin by bin. @return the power of all bins
double find_excess(const NoiseSpectrum& power, NoiseSpectrum& excess) noexcept {
  double all = 0.0;
  for (std::size_t bin = kFirstNoiseBin; bin < kNoiseBins; ++bin) {
    all += power[bin];
    excess[bin] = std::max(0.0, power[bin] - kStandsOut * median_around(power, bin, kNeighbours));
  }
  return all;
}

double share_of(const NoiseSpectrum& excess, double all) noexcept {
  double lines = 0.0;
  for (std::size_t bin = kFirstNoiseBin; bin < kNoiseBins; ++bin) lines += excess[bin];
  return all > 0.0 ? lines / all : 0.0;
}

void take_out_strongest(NoiseSpectrum& excess) noexcept {
  const auto strongest = static_cast<std::size_t>(
      std::max_element(excess.begin() + kFirstNoiseBin, excess.end()) - excess.begin());
  const std::size_t reach = std::max(kLineReach, strongest / kLineReachShare);
  const std::size_t first = std::max(kFirstNoiseBin, strongest > reach ? strongest - reach : 0);
  const std::size_t end = std::min(strongest + reach + 1, kNoiseBins);
  for (std::size_t bin = first; bin < end; ++bin) excess[bin] = 0.0;
}

}  // namespace

LineShares line_shares(const NoiseSpectrum& power) noexcept {
  NoiseSpectrum excess;
  const double all = find_excess(power, excess);
  LineShares shares{.all = share_of(excess, all)};
  for (int line = 0; line < kLinesOfASensor; ++line) take_out_strongest(excess);
  shares.further = share_of(excess, all);
  return shares;
}

}  // namespace gyrod::core
