/// What of the engine's counts is news of the daemon itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "stream/counters.hpp"

namespace gyrod::live {

/// Finds overload, and samples of more sensors than are taken. One thread.
class DaemonWatch {
 public:
  /// An overload step is left only after so long, s: one that comes and goes is one.
  static constexpr double kCalmS = 10.0;
  /// Refused samples are told once in so long, s, in sum.
  static constexpr double kSumS = 60.0;

  /// To be called about once a second. @param now_s of a steady clock
  /// @return a sentence each of what has happened since the last call
  [[nodiscard]] std::vector<std::string> look(double now_s, const stream::EngineSnapshot& now,
                                              std::size_t max_channels);

 private:
  void look_for_overload(double now_s, const stream::EngineSnapshot& now, std::vector<std::string>& news);
  void look_at_refusals(double now_s, std::uint64_t refused, std::size_t max_channels,
                        std::vector<std::string>& news);

  unsigned step_ = 0;    ///< told last
  double busy_s_ = 0.0;  ///< when that was last so
  std::uint64_t hops_widened_ = 0;
  std::uint64_t overloads_ = 0;
  std::uint64_t refused_ = 0;  ///< told so far
  double next_sum_s_ = 0.0;
};

}  // namespace gyrod::live
