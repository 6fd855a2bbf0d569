/// Imu messages that wait for their denoised rates. Internal to bus/.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bus/imu_wire.hpp"

namespace gyrod::bus {

/// Copies of messages, oldest first, at most so many as said at first. All is allocated when it is made, but for frame ids longer
/// than those seen before. Not thread-safe.
class HeldMessages {
 public:
  /// Longest frame id, characters. It bounds the memory of a message; frames are names of parts of a robot.
  static constexpr std::size_t kMaxFrameIdLength = 255;

  explicit HeldMessages(std::size_t capacity) : slots_(capacity) { assert(capacity > 0); }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool full() const noexcept { return size_ == slots_.size(); }

  /// @pre not full, and the frame id is no longer than kMaxFrameIdLength
  void push(const Imu& message) {
    assert(!full());
    Slot& slot = slots_[(first_ + size_++) % slots_.size()];
    slot.message = message;
    slot.frame_id = frame_id_of(message);
    slot.message.header.frame_id = slot.frame_id.data();
    slot.may_stay = false;
  }

  /// The one with that stamp, looked for from the newest on; none if it is not there. Valid as the newest is.
  [[nodiscard]] const Imu* find(std::int64_t stamp_ns) const noexcept {
    const auto slot = slot_of(stamp_ns);
    return slot ? &slots_[*slot].message : nullptr;
  }
  /// Nobody misses the one with that stamp if it is never published.
  void let_stay(std::int64_t stamp_ns) noexcept {
    if (const auto slot = slot_of(stamp_ns)) slots_[*slot].may_stay = true;
  }
  /// Whether that is so of the oldest. @pre size() > 0
  [[nodiscard]] bool oldest_may_stay() const noexcept { return slots_[first_].may_stay; }

  /// The oldest and the newest, valid until dropped; so is the frame id that a copy points to. @pre size() > 0
  [[nodiscard]] const Imu& oldest() const noexcept { return slots_[first_].message; }
  [[nodiscard]] const Imu& newest() const noexcept {
    return slots_[(first_ + size_ - 1) % slots_.size()].message;
  }

  void drop_oldest() noexcept {
    assert(size_ > 0);
    first_ = (first_ + 1) % slots_.size();
    --size_;
  }
  void drop_newest() noexcept {
    assert(size_ > 0);
    --size_;
  }

  [[nodiscard]] static std::string_view frame_id_of(const Imu& message) noexcept {
    return message.header.frame_id == nullptr ? std::string_view{}
                                              : std::string_view{message.header.frame_id};
  }

 private:
  struct Slot {
    Imu message{};
    std::string frame_id;  ///< what message.header.frame_id points to
    bool may_stay = false;
  };

  [[nodiscard]] std::optional<std::size_t> slot_of(std::int64_t stamp_ns) const noexcept {
    for (std::size_t k = size_; k > 0; --k) {
      const std::size_t slot = (first_ + k - 1) % slots_.size();
      if (stamp_ns_of(slots_[slot].message) == stamp_ns) return slot;
    }
    return std::nullopt;
  }

  std::vector<Slot> slots_;
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace gyrod::bus
