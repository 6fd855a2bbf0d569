/// The newest samples of one sensor, written by its samples' thread and read by whoever looks.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stream/sample.hpp"

namespace gyrod::live {

/// A sample as people look at it.
struct Point {
  std::int64_t stamp_ns = 0;
  std::array<float, stream::kAxes> rate_radps{};
};

/// Ring of the newest samples. One thread at a time adds, and never waits; any may read meanwhile, and gets what was added before, less
/// what is overwritten while it reads. Sized once, 24 bytes a sample.
class SampleTrail {
 public:
  /// Stamps that go back by more are of another clock: what was before is no longer read.
  static constexpr std::int64_t kClockStepNs = 1'000'000'000;

  /// What no gyro tells, rad/s.
  static constexpr double kMostRadps = 1e6;

  /// @pre capacity is a power of two
  explicit SampleTrail(std::size_t capacity) : slots_(capacity) {}

  /// Takes it if it is finite, possible and newer than the last one.
  void add(std::int64_t stamp_ns, const std::array<double, stream::kAxes>& rate_radps) noexcept;

  /// The place of the next point: points that were added, ever.
  [[nodiscard]] std::uint64_t end() const noexcept { return end_.load(std::memory_order_acquire); }
  /// Appends the points from a place on that are still there, of the clock in use. @return the place behind the last one
  std::uint64_t read(std::uint64_t from, std::vector<Point>& points) const;

 private:
  /// Torn while it is overwritten; its place tells, see read().
  struct Slot {
    std::atomic<std::int64_t> stamp_ns{0};
    std::array<std::atomic<float>, stream::kAxes> rate_radps{};
  };

  [[nodiscard]] const Slot& slot(std::uint64_t place) const { return slots_[place & (slots_.size() - 1)]; }
  [[nodiscard]] Slot& slot(std::uint64_t place) { return slots_[place & (slots_.size() - 1)]; }

  std::vector<Slot> slots_;
  std::atomic<std::uint64_t> begin_{0};    ///< of the clock in use
  std::atomic<std::uint64_t> claimed_{0};  ///< up to here slots are, or are being, written
  std::atomic<std::uint64_t> end_{0};
  std::int64_t last_ns_ = 0;  ///< the writer's
};

}  // namespace gyrod::live
