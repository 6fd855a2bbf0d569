/// How fast the engine works now: rates over the last seconds, times of the last minute.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>

#include "stream/counters.hpp"

namespace gyrod::live {

/// The time that this share of a histogram's entries does not exceed, interpolated within its bucket as Prometheus does; of the last
/// bucket, which has no end, its lower bound. None of an empty histogram. @param share 0..1
[[nodiscard]] std::optional<double> quantile(const stream::TimeHistogram& times, double share) noexcept;

/// Fed with the engine's sums about once a second by one thread; any thread may read. Fixed memory.
class Recent {
 public:
  /// Rates are taken over so long, s, or less after a start.
  static constexpr double kRateWindowS = 10.0;

  void note(double now_s, const stream::EngineSnapshot& engine);

  struct Figures {
    std::optional<double> samples_per_s;  ///< received; none before the second note
    std::optional<double> windows_per_s;
    stream::TimeHistogram window_time;    ///< of the last minute
    stream::TimeHistogram added_latency;  ///< of the last minute
  };
  [[nodiscard]] Figures figures() const;

 private:
  struct Note {
    double time_s = 0.0;
    std::uint64_t received = 0;
    std::uint64_t windows = 0;
    stream::TimeHistogram window_time;
    stream::TimeHistogram added_latency;
  };
  static constexpr std::size_t kNotes = 61;

  [[nodiscard]] const Note& back(std::size_t notes) const { return notes_[(noted_ - 1 - notes) % kNotes]; }

  mutable std::mutex mutex_;
  std::array<Note, kNotes> notes_{};
  std::size_t noted_ = 0;
};

}  // namespace gyrod::live
