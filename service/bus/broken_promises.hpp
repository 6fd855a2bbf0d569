/// What is counted of promises that writers do not keep.
#pragma once

#include <atomic>
#include <cstdint>

namespace gyrod::bus {

/// How often that was so, see QosProfile.
struct BrokenPromises {
  std::uint64_t deadlines_missed =
      0;  ///< each time a sensor let a deadline pass, again and again while it stays away
  std::uint64_t liveliness_lost = 0;  ///< writers, each time that one gave no sign of life
};

/// One thread counts, any reads.
class BrokenPromiseCounter {
 public:
  void count_deadline() noexcept { deadlines_missed_.fetch_add(1, std::memory_order_relaxed); }
  void set_losses(std::uint64_t losses) noexcept {
    liveliness_lost_.store(losses, std::memory_order_relaxed);
  }
  [[nodiscard]] BrokenPromises counts() const noexcept {
    return {.deadlines_missed = deadlines_missed_.load(std::memory_order_relaxed),
            .liveliness_lost = liveliness_lost_.load(std::memory_order_relaxed)};
  }

 private:
  std::atomic<std::uint64_t> deadlines_missed_{0};
  std::atomic<std::uint64_t> liveliness_lost_{0};
};

}  // namespace gyrod::bus
