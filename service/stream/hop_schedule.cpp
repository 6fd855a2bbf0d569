#include "stream/hop_schedule.hpp"

namespace gyrod::stream {

unsigned doublings_at(double sample_rate_hz, std::size_t window_samples) noexcept {
  constexpr double kFast_hz = 216.0;
  unsigned doublings = 0;
  double fast_hz = kFast_hz;
  std::size_t longer = 2 * window_samples;
  while (doublings < kMostDoublings && sample_rate_hz >= fast_hz && longer <= kLongestWindow) {
    ++doublings;
    fast_hz *= 2.0;
    longer *= 2;
  }
  return doublings;
}

}  // namespace gyrod::stream
