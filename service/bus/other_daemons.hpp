/// The other daemons that have the same output. Internal to bus/.
#pragma once

#include <cstdint>
#include <map>

#include <dds/dds.h>

#include "bus/held_samples.hpp"

namespace gyrod::bus {

/// Seconds of a clock that nobody sets.
[[nodiscard]] double steady_now_s() noexcept;

/// Time for one that starts, or was stopped for a while, to find those that run and to hear what they have published.
inline constexpr double kTimeToLook_s = 1.0;

/// Pause between two looks at what others have published.
[[nodiscard]] double tick_s(double takeover_s) noexcept;

/// Those of other processes that write to one topic with an ownership strength, as a reader of that topic shows them. Times are of
/// steady_now_s(). Not thread-safe.
class OtherDaemons {
 public:
  /// @param strength of this daemon, > 0
  OtherDaemons(std::uint32_t strength, double takeover_s, double now_s)
      : strength_(strength), takeover_s_(takeover_s), looking_since_s_(now_s), looked_s_(now_s) {}

  /// Who is there. To be called each tick.
  void look(dds_entity_t reader, double now_s);

  /// Whether this process has been stopped for so long that readers and others have taken it for dead: another may publish by now, and
  /// there has to be time to hear it. To be asked before anything is published. True once a pause.
  [[nodiscard]] bool was_stopped(double now_s) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return stronger_.size(); }
  [[nodiscard]] bool knows(dds_instance_handle_t writer) const { return stronger_.contains(writer); }
  [[nodiscard]] bool is_stronger(dds_instance_handle_t writer) const {
    const auto found = stronger_.find(writer);
    return found != stronger_.end() && found->second;
  }
  [[nodiscard]] Others now(double now_s) const;

 private:
  std::uint32_t strength_;
  double takeover_s_;
  double looking_since_s_;
  double looked_s_;  ///< last
  std::map<dds_instance_handle_t, bool> stronger_;
};

}  // namespace gyrod::bus
