#include "stream/splice.hpp"

#include <algorithm>
#include <cmath>

#include "core/signal/portable_math.hpp"

namespace gyrod::stream {

Splice::Splice(std::size_t lag_samples) : weights_(lag_samples - lag_samples / 4) {
  const auto size = static_cast<double>(weights_.size());
  for (std::size_t k = 0; k < weights_.size(); ++k)
    weights_[k] =
        (1.0 + core::portable_sine_cosine(0.5 * (static_cast<double>(k) + 0.5) / size).cosine) / 2.0;
  for (Ahead& ahead : ahead_) ahead.answer.resize(weights_.size());
}

void Splice::join(const WindowJob& job, std::size_t axis, std::span<double> denoised) noexcept {
  Ahead& ahead = ahead_[axis];
  const auto released = denoised.subspan(static_cast<std::size_t>(job.release_begin - job.begin));
  const auto next = denoised.subspan(static_cast<std::size_t>(job.release_end - job.begin));
  if (ahead.segment == job.segment && ahead.begin == job.release_begin) {
    const std::size_t both = std::min(ahead.size, released.size() - next.size());
    for (std::size_t k = 0; k < both; ++k) released[k] = std::lerp(released[k], ahead.answer[k], weights_[k]);
  }
  ahead.begin = job.release_end;
  ahead.segment = job.segment;
  ahead.size = std::min(next.size(), weights_.size());
  std::copy_n(next.begin(), ahead.size, ahead.answer.begin());
}

}  // namespace gyrod::stream
