/// Imu messages that wait for their denoised rates. Internal to bus/.
#pragma once

#include <cassert>
#include <cstddef>
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
  }

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
  };

  std::vector<Slot> slots_;
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace gyrod::bus
