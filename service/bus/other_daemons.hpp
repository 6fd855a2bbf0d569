/// The other daemons that have the same output. Internal to bus/.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <span>

#include <dds/dds.h>

#include "bus/held_samples.hpp"
#include "bus/promise_watch.hpp"

namespace gyrod::bus {

/// Seconds of a clock that nobody sets.
[[nodiscard]] double steady_now_s() noexcept;

/// Pause between two looks at what others have published.
[[nodiscard]] double tick_s(double takeover_s) noexcept;

/// Those of other processes that write to one topic with an ownership strength, as a reader of that topic shows them. Times are of
/// steady_now_s(). Not thread-safe.
class OtherDaemons {
 public:
  /// @param strength of this daemon, > 0
  OtherDaemons(std::uint32_t strength, double takeover_s, double now_s)
      : strength_(strength), takeover_s_(takeover_s), looking_since_s_(now_s), looked_s_(now_s) {}

  /// Which of them gave no sign of life, or do again, in the order it happened. To be called each tick before look(), where their writers
  /// have a lease.
  void heed(std::span<const PromiseWatch::Event> signs);
  /// Who is there. To be called each tick.
  void look(dds_entity_t reader, double now_s);

  /// Whether this process has been stopped for so long that readers and others have taken it for dead: another may publish by now, and
  /// there has to be time to hear it. To be asked before anything is published. True once a pause.
  [[nodiscard]] bool was_stopped(double now_s) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return stronger_.size(); }
  /// Also of one that has left: its last messages may still have to be taken.
  [[nodiscard]] bool knows(dds_instance_handle_t writer) const {
    return stronger_.contains(writer) || left_.contains(writer);
  }
  [[nodiscard]] bool is_stronger(dds_instance_handle_t writer) const;
  /// One that has left is counted for a tick more: discovery and messages come on ways of their own, and what it sent last counts.
  [[nodiscard]] Others now(double now_s) const;

 private:
  struct Left {
    bool stronger = false;
    double since_s = 0.0;
  };

  std::uint32_t strength_;
  double takeover_s_;
  double looking_since_s_;
  double looked_s_;  ///< last
  double stronger_lived_s_ = std::numeric_limits<double>::lowest();
  std::map<dds_instance_handle_t, bool> stronger_;
  std::map<dds_instance_handle_t, Left> left_;  ///< the last ones
  std::set<dds_instance_handle_t> silent_;      ///< those that have let their lease end
};

}  // namespace gyrod::bus
