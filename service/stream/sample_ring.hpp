/// The recent samples of one channel, by position.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "stream/sample.hpp"

namespace gyrod::stream {

/// Number of a place on a channel's uniform time base. Counts up for the life of the channel; bridged places
/// count too.
using Position = std::int64_t;

/// Ring of the newest `capacity` positions: angular rates per axis, sequence number, stamp. One thread
/// appends; others may at the same time read positions appended before, handed to them through a lock, as
/// long as the appender keeps `capacity` between the oldest position still needed and the newest. Allocates nothing but in grow().
class SampleRing {
 public:
  explicit SampleRing(std::size_t capacity) : stamps_(capacity), sequences_(capacity), released_(capacity) {
    for (auto& axis : rates_) axis.resize(capacity);
  }

  /// Makes room for more positions; those that it holds stay, and older ones are lost. @pre nobody else reads @throws std::bad_alloc, as it was before
  void grow(std::size_t capacity) {
    if (capacity <= this->capacity()) return;
    SampleRing larger(capacity);
    const auto held = std::min(end_, static_cast<Position>(this->capacity()));
    larger.end_ = end_ - held;
    for (Position position = end_ - held; position < end_; ++position)
      larger.append(at(position), released(position));
    *this = std::move(larger);
  }

  [[nodiscard]] std::size_t capacity() const noexcept { return stamps_.size(); }
  /// The position that comes next.
  [[nodiscard]] Position end() const noexcept { return end_; }

  /// @param released false for a position that never leaves: a bridged one, or one that was published before
  void append(const Sample& sample, bool released) noexcept {
    const std::size_t slot = slot_of(end_);
    for (std::size_t axis = 0; axis < kAxes; ++axis) rates_[axis][slot] = sample.rate_radps[axis];
    sequences_[slot] = sample.sequence;
    stamps_[slot] = sample.stamp_ns;
    released_[slot] = released ? 1 : 0;
    ++end_;
  }

  /// Whether the position is to leave.
  [[nodiscard]] bool released(Position position) const noexcept { return released_[slot_of(position)] != 0; }

  [[nodiscard]] Sample at(Position position) const noexcept {
    const std::size_t slot = slot_of(position);
    return {sequences_[slot], stamps_[slot], {rates_[0][slot], rates_[1][slot], rates_[2][slot]}};
  }

  /// Copies one axis of positions [begin, begin + out.size()) into a contiguous window.
  void copy(std::size_t axis, Position begin, std::span<double> out) const noexcept {
    const std::size_t first = slot_of(begin);
    const std::size_t head = std::min(out.size(), capacity() - first);
    const auto& ring = rates_[axis];
    std::copy_n(ring.begin() + static_cast<std::ptrdiff_t>(first), head, out.begin());
    std::copy_n(ring.begin(), out.size() - head, out.begin() + static_cast<std::ptrdiff_t>(head));
  }

 private:
  [[nodiscard]] std::size_t slot_of(Position position) const noexcept {
    return static_cast<std::size_t>(position) % capacity();
  }

  std::array<std::vector<double>, kAxes> rates_;
  std::vector<std::int64_t> stamps_;
  std::vector<std::uint64_t> sequences_;
  std::vector<std::uint8_t> released_;
  Position end_ = 0;
};

}  // namespace gyrod::stream
