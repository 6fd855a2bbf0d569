/// The other daemons that write to the same topic, and what this one serves beside them.
#pragma once

#include <memory>

#include "bus/bus_options.hpp"
#include "bus/domain.hpp"
#include "bus/publisher.hpp"
#include "fleet/roster.hpp"

namespace gyrod::bus {

/// Told what to serve. Called by one thread at a time.
class FleetHandler {
 public:
  virtual ~FleetHandler() = default;
  /// Serve this from now on. When it returns, nothing is taken any more of what the rule leaves out.
  virtual void on_rule(const fleet::ServingRule& rule) noexcept = 0;
  /// The fleet has changed.
  virtual void on_standing(const fleet::Standing& standing) noexcept = 0;
};

/// How long a daemon with a shard stays in each state before it serves.
struct FleetTimes {
  double listening_s = 1.0;  ///< without anybody new
  double joining_s = 1.0;    ///< at least, and until all that are known have greeted it
  double longest_s = 10.0;   ///< in either state, whoever is new or does not greet
};

/// Tells others by the user data of the writer of denoised samples which shard is served here, hears the same of every writer of that
/// topic in the same partitions, and keeps a fleet::Roster of it. News travel by DDS discovery, which is reliable: no message of ours,
/// no topic, and the end of a daemon is told or found out as that of any writer (a killed one after its lease, 10 s by default).
///
/// A daemon with a shard listens, is announced as joining, and serves from then on (FleetTimes); one without serves at once as shard 1/1.
///
/// start() and leave() belong to one thread; standing() is for any.
class FleetMembers {
 public:
  /// Asks discovery now, tells nothing yet. @param handler has to outlive this
  /// @throws BusError
  FleetMembers(const Domain& domain, const Publisher& publisher, const BusOptions& options,
               FleetHandler& handler, const FleetTimes& times = {});
  /// As by leave().
  ~FleetMembers();
  FleetMembers(const FleetMembers&) = delete;
  FleetMembers& operator=(const FleetMembers&) = delete;

  /// Hands over the first rule, then those that follow from a thread of its own. Once.
  void start();
  /// Tells that nothing is served here any more, so that others may. To be called when that is so. Idempotent.
  void leave() noexcept;

  [[nodiscard]] fleet::Standing standing() const noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::bus
