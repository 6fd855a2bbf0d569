#include "app/fleet_link.hpp"

#include <spdlog/spdlog.h>

namespace gyrod::app {

std::vector<bus::GivenUp> FleetLink::on_rule(const fleet::ServingRule& rule, bool told) noexcept {
  shard_ = text_of(rule.own);
  return inlet_.serve(rule, told);
}

std::vector<bus::GivenUp> FleetLink::on_leave() noexcept { return inlet_.served(); }

void FleetLink::on_given_up(std::span<const bus::GivenUp> given) noexcept { inlet_.heed(given); }

void FleetLink::on_standing(const fleet::Standing& now) noexcept {
  const fleet::Standing before = last_;  // nothing is told before this daemon is one of them
  if (now.active) last_ = now;
  if (now.disputes > before.disputes) {
    spdlog::warn(
        "shard {}: a daemon turned up that may have served the same sensors: their samples may have come "
        "twice",
        shard_);
  }
  if (!now.active) return;
  if (now.peers != before.peers || (!before.active && shard_ != "1/1"))
    spdlog::info("shard {}: served here; {} other daemons write to the same topic", shard_, now.peers);
  if (now.twins > before.twins) {
    spdlog::warn(
        "shard {}: served by {} other daemons as well: readers get its samples from each of them, unless "
        "they choose by ownership",
        shard_, now.twins);
  }
  if (now.overlapping > before.overlapping)
    spdlog::info("shard {}: daemons of another count overlap ({}); who has the largest count serves", shard_,
                 now.overlapping);
  if (now.missing != before.missing && now.missing > 0)
    spdlog::warn("shard {}: nobody serves {} of the shards", shard_, now.missing);
  if (before.missing > 0 && now.missing == 0) spdlog::info("shard {}: every shard is served", shard_);
}

}  // namespace gyrod::app
