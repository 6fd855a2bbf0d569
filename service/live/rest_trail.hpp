/// When a sensor was at rest lately.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

namespace gyrod::live {

/// Of the sensor's clock, ns.
struct Interval {
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  friend bool operator==(const Interval&, const Interval&) = default;
};

/// Fed with what each report says at its last sample. Who feeds does not wait: while somebody reads, a report is passed over, and the next
/// one tells the same.
class RestTrail {
 public:
  static constexpr std::size_t kMost = 256;

  void note(std::int64_t stamp_ns, bool at_rest) noexcept;
  /// Oldest first, those that end after this stamp.
  [[nodiscard]] std::vector<Interval> since(std::int64_t stamp_ns) const;

 private:
  mutable std::mutex mutex_;
  std::vector<Interval> ring_ = std::vector<Interval>(kMost);
  std::size_t begun_ = 0;  ///< intervals, ever
  bool at_rest_ = false;
  std::optional<std::int64_t> last_ns_;
};

}  // namespace gyrod::live
