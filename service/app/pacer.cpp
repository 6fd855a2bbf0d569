#include "app/pacer.hpp"

namespace gyrod::app {

bool Pacer::wait_until_due(std::int64_t stamp_ns) noexcept {
  if (speed_ <= 0.0) return !interrupt_.requested();
  const Clock::time_point now = Clock::now();
  if (!origin_ns_) {
    origin_ns_ = stamp_ns;
    begin_ = now;
  }
  // In double: stamps of broken recordings may lie further apart than 64 bits count.
  const double due_s = (static_cast<double>(stamp_ns) - static_cast<double>(*origin_ns_)) * 1e-9 / speed_;
  double pause_s = due_s - std::chrono::duration<double>(now - begin_).count();
  if (pause_s > std::chrono::duration<double>(kLongestPause).count() || pause_s < -1.0) {
    // A jump either way: the stamps that follow count from here.
    pause_s = pause_s > 0.0 ? std::chrono::duration<double>(kLongestPause).count() : 0.0;
    origin_ns_ = stamp_ns;
    begin_ = now + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(pause_s));
  }
  if (pause_s <= 0.0) return !interrupt_.requested();
  return !interrupt_.wait_for(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(pause_s)));
}

}  // namespace gyrod::app
