/// From the fleet to the engine and the log.
#pragma once

#include <string>

#include "app/engine_feed.hpp"
#include "bus/fleet_members.hpp"

namespace gyrod::app {

/// Puts into force what is to be served, and logs what changes in the fleet.
class FleetLink final : public bus::FleetHandler {
 public:
  explicit FleetLink(EngineInlet& inlet) : inlet_(inlet) {}
  std::vector<bus::GivenUp> on_rule(const fleet::ServingRule& rule, bool told) noexcept override;
  std::vector<bus::GivenUp> on_leave() noexcept override;
  void on_given_up(std::span<const bus::GivenUp> given) noexcept override;
  void on_standing(const fleet::Standing& now) noexcept override;

 private:
  EngineInlet& inlet_;
  std::string shard_;
  fleet::Standing last_;  ///< that was told
};

}  // namespace gyrod::app
