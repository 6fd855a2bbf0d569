/// Where the answers of two windows meet.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stream/hop_schedule.hpp"
#include "stream/sample.hpp"

namespace gyrod::stream {

/// Lets the answer of a window fade into that of the next, so that their joint leaves no step. Of the first samples that a window
/// releases, as many as three quarters of the lag, the window before had answers of its own, not released as they were too near its end:
///   e[r + k] = w_k a[r + k] + (1 - w_k) b[r + k],   w_k = (1 + cos(pi (k + 1/2) / F)) / 2,   k = 0 .. F - 1, F = lag - floor(lag / 4),
/// a the window before, b this one, r the first position that it releases. No sample waits longer for it, and no answer is used beyond
/// what both windows say: e lies between them. Why not the whole lag: docs/method.md, "Streaming".
///
/// Of one channel, used by its owner, window by window. join() allocates nothing.
class Splice {
 public:
  explicit Splice(std::size_t lag_samples);

  /// @param denoised one axis of the job's window, of which the part to be released is changed in place. As it came it is remembered
  /// for the next window. Where that does not go on where this one ended (a gap, a window passed through between them) it stays as it is.
  void join(const WindowJob& job, std::size_t axis, std::span<double> denoised) noexcept;

 private:
  /// Answers not released.
  struct Ahead {
    Position begin = 0;
    std::uint64_t segment = 0;
    std::size_t size = 0;
    std::vector<double> answer;  ///< the first `size` of as many as there are weights
  };

  std::vector<double> weights_;
  std::array<Ahead, kAxes> ahead_;
};

}  // namespace gyrod::stream
