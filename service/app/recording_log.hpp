/// What came, sensor by sensor, and what did not.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace gyrod::app {

/// Finds gaps by sequence number: the middleware itself does not tell of samples lost on the network. One
/// thread.
class RecordingLog {
 public:
  struct Account {
    std::uint64_t samples = 0;
    std::uint64_t last_sequence = 0;
    std::uint64_t missing = 0;          ///< sequence numbers that were left out
    std::uint64_t gaps = 0;             ///< places where that was so
    std::uint64_t first_gap_after = 0;  ///< sequence number before the first of them
    std::uint64_t restarts = 0;         ///< times the number did not go up
    bool ended = false;
  };

  void add(std::string_view sensor, std::uint64_t sequence);
  /// The sensor has ended; it may come back.
  void end(std::string_view sensor);

  [[nodiscard]] const std::map<std::string, Account, std::less<>>& sensors() const noexcept {
    return sensors_;
  }
  /// Sensors came, and every one has ended.
  [[nodiscard]] bool all_ended() const;

 private:
  std::map<std::string, Account, std::less<>> sensors_;
};

}  // namespace gyrod::app
