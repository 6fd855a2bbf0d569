/// When a channel makes a window, which positions it holds, and which it releases.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "stream/model_fit.hpp"
#include "stream/noise_learner.hpp"
#include "stream/sample.hpp"
#include "stream/sample_ring.hpp"

namespace gyrod::stream {

/// Longest window, samples.
inline constexpr std::size_t kLongestWindow = 65'536;
/// Most doublings of the window.
inline constexpr unsigned kMostDoublings = 2;

/// How often the window of a model method doubles where a sensor is fast: the default of 1024 samples then lasts 4.7 to 9.5 s at 108 to 864 Hz.
/// Sensors of 208 and 416 Hz, or of 225 and 450 Hz, stay on their side. At most kMostDoublings, and no longer than kLongestWindow.
/// Source: docs/decisions/0007, "Windows of fast sensors".
/// @param sample_rate_hz 0 while unknown
[[nodiscard]] unsigned doublings_at(double sample_rate_hz, std::size_t window_samples) noexcept;

/// How often the hop is doubled with that: half as wide as it might be, as motion by hand changes within a hop.
[[nodiscard]] constexpr unsigned hop_doublings(unsigned window_doublings) noexcept {
  return window_doublings == 0 ? 0 : window_doublings - 1;
}

/// One window to work on.
struct WindowJob {
  Position begin = 0;  ///< window is [begin, end)
  Position end = 0;
  Position release_begin = 0;  ///< part to be released, within the window
  Position release_end = 0;
  std::uint32_t flags = 0;        ///< SampleFlag bits of the released samples
  std::uint32_t hop_samples = 0;  ///< hop in use
  unsigned doublings = 0;         ///< of the configured window
  std::uint64_t segment = 0;      ///< counts the unbroken stretches of a channel
  bool ends_stream = false;       ///< the sensor has ended with this window
  double sample_rate_hz = 0.0;    ///< 0 while unknown
  double submitted_s = 0.0;       ///< engine clock
  // As known when the window ended, so that they depend on sample numbers alone.
  ChannelNoise noise;
  std::optional<bool> at_rest;                           ///< none where nobody looks
  std::optional<std::array<ModelFit, kAxes>> model_fit;  ///< model methods only
  /// Of the denoised estimates since the window before, mean, (rad/s)^2; model methods only.
  std::optional<std::array<double, kAxes>> output_variance;
};

/// Cuts a channel's positions into windows. A window of at most window() positions ends every step() positions
/// of a segment (an unbroken stretch); it releases what has not been released up to `lag` before its end.
/// Closing a segment releases the rest. Depends on positions alone, and on how long windows are to be; never on time, except for widen(),
/// which is overload step 1.
class HopSchedule {
 public:
  struct Options {
    Position window = 1024;
    Position hop = 32;
    Position max_hop = 256;
    Position lag = 16;
  };

  explicit HopSchedule(const Options& options) noexcept : options_(options), hop_(options.hop) {}

  /// Longest window, and the hop between windows where it is not widened: as configured, the window doubled so many times.
  [[nodiscard]] Position window() const noexcept { return options_.window << doublings_; }
  [[nodiscard]] Position step() const noexcept { return options_.hop << hop_doublings(doublings_); }
  [[nodiscard]] unsigned doublings() const noexcept { return doublings_; }

  /// True where a whole number of steps lies in the segment before `end`.
  [[nodiscard]] bool at_boundary(Position end) const noexcept { return (end - segment_begin_) % step() == 0; }

  /// True where, position `end - 1` having been appended, a window is due.
  [[nodiscard]] bool due(Position end) const noexcept { return at_boundary(end) && end - last_end_ >= hop_; }

  /// True where windows can double: this one is full, and a whole number of the next steps lies in the segment before `end`.
  [[nodiscard]] bool can_double(Position end) const noexcept {
    const Position length = end - segment_begin_;
    return end - window_floor_ >= window() && length % (options_.hop << hop_doublings(doublings_ + 1)) == 0;
  }
  /// Windows may be twice as long from here on. They grow by what comes: nothing older than this window is looked at any more, as nobody has
  /// kept it. @pre can_double(end); before take(end)
  void double_windows(Position end) noexcept {
    window_floor_ = std::max(window_floor_, end - window());
    set_doublings(doublings_ + 1);
  }
  /// Windows are doubled so many times only. @pre at_boundary(end), doublings <= doublings(); before take(end)
  void shorten_windows(unsigned doublings, Position end) noexcept {
    set_doublings(doublings);
    last_end_ = std::max(last_end_, end - step());
  }

  /// The window that ends before `end`. @pre due(end), before windows were doubled at this end
  [[nodiscard]] WindowJob take(Position end) noexcept {
    const Position waited = end - last_end_;
    last_end_ = end;
    const bool full = end - segment_begin_ >= options_.window;
    std::uint32_t flags = full ? 0U : static_cast<std::uint32_t>(SampleFlag::kWarmingUp);
    // What counts is how long these samples waited, also where the hop has just come back to normal.
    if (waited > step()) flags |= static_cast<std::uint32_t>(SampleFlag::kHopWidened);
    return job(end, std::max(released_, end - options_.lag), flags);
  }

  /// Ends the segment before `end`: the window that releases what is left. Where nothing is left it is an
  /// empty window.
  [[nodiscard]] WindowJob close(Position end) noexcept {
    const bool full = end - segment_begin_ >= options_.window;
    std::uint32_t flags = static_cast<std::uint32_t>(SampleFlag::kTail);
    if (!full) flags |= static_cast<std::uint32_t>(SampleFlag::kWarmingUp);
    if (end - last_end_ >= step()) flags |= static_cast<std::uint32_t>(SampleFlag::kHopWidened);
    WindowJob last = job(end, end, flags);
    if (last.release_begin == end) last.begin = end;
    segment_begin_ = window_floor_ = last_end_ = released_ = end;
    set_doublings(0);
    ++segment_;
    return last;
  }

  /// Overload step 1: doubles the hop up to its maximum. @return false where it is there already
  bool widen() noexcept {
    const Position widest = options_.max_hop / options_.hop * step();
    if (hop_ >= widest) return false;
    hop_ = std::min(2 * hop_, widest);
    return true;
  }
  /// Recovery: back to one step.
  void narrow() noexcept { hop_ = step(); }

  [[nodiscard]] Position hop() const noexcept { return hop_; }
  [[nodiscard]] bool widened() const noexcept { return hop_ > step(); }
  [[nodiscard]] Position segment_begin() const noexcept { return segment_begin_; }
  [[nodiscard]] std::uint64_t segment() const noexcept { return segment_; }
  /// Oldest position that the next window can need.
  [[nodiscard]] Position oldest_needed(Position end) const noexcept {
    return std::max(window_floor_, end - window());
  }

 private:
  /// A widened hop stays as many steps.
  void set_doublings(unsigned doublings) noexcept {
    const Position steps = hop_ / step();
    doublings_ = doublings;
    hop_ = steps * step();
  }

  [[nodiscard]] WindowJob job(Position end, Position release_end, std::uint32_t flags) noexcept {
    WindowJob made;
    made.begin = oldest_needed(end);
    made.end = end;
    made.release_begin = released_;
    made.release_end = release_end;
    made.flags = flags;
    made.hop_samples = static_cast<std::uint32_t>(hop_);
    made.doublings = doublings_;
    made.segment = segment_;
    released_ = release_end;
    return made;
  }

  Options options_;
  unsigned doublings_ = 0;
  Position hop_;
  Position segment_begin_ = 0;
  Position window_floor_ = 0;  ///< no window reaches back beyond it
  Position last_end_ = 0;
  Position released_ = 0;
  std::uint64_t segment_ = 0;
};

}  // namespace gyrod::stream
