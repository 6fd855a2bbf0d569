/// Sensors whose writer gave no sign of life. Internal to bus/.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

namespace gyrod::bus {

/// DDS ends the sensors of a writer that lost its liveliness, as of one that is gone, and tells the reason for itself, sooner or later than
/// that. This brings the two together. Holds the last ends only.
class LostWriters {
 public:
  /// The writer has lost its liveliness. @return the sensors that have ended with it; nothing where that was known
  [[nodiscard]] std::vector<std::string> lose(std::uint64_t writer) {
    std::vector<std::string> sensors;
    if (!lost_.insert(writer).second) return sensors;
    ++losses_;
    for (const End& end : ends_) {
      if (end.writer == writer) sensors.push_back(end.sensor);
    }
    std::erase_if(ends_, [writer](const End& end) { return end.writer == writer; });
    return sensors;
  }
  /// It lives again, or is gone for good.
  void forget(std::uint64_t writer) { lost_.erase(writer); }

  /// A sensor has ended, this was its writer. @return whether that had lost its liveliness
  [[nodiscard]] bool end(std::string_view sensor, std::uint64_t writer) {
    if (lost_.contains(writer)) return true;
    ends_.push_back({std::string(sensor), writer});
    if (ends_.size() > kMostEnds) ends_.pop_front();
    return false;
  }

  /// Writers so far, each time that one lost it.
  [[nodiscard]] std::uint64_t losses() const noexcept { return losses_; }

 private:
  struct End {
    std::string sensor;
    std::uint64_t writer;
  };
  static constexpr std::size_t kMostEnds = 4096;

  std::unordered_set<std::uint64_t> lost_;
  std::deque<End> ends_;
  std::uint64_t losses_ = 0;
};

}  // namespace gyrod::bus
