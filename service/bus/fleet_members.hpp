/// The other daemons that write to the same topic, and what this one serves beside them.
#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <vector>

#include "bus/bus_options.hpp"
#include "bus/domain.hpp"
#include "bus/given_up.hpp"
#include "bus/publisher.hpp"
#include "fleet/roster.hpp"

namespace gyrod::bus {

/// Told what to serve. Called by one thread at a time.
class FleetHandler {
 public:
  virtual ~FleetHandler() = default;
  /// Serve this from now on. When it returns, nothing is taken any more of what the rule leaves out.
  /// @param told whether all who served what is served here now have told how far they were (on_given_up)
  /// @return what was served until now and is no more
  virtual std::vector<GivenUp> on_rule(const fleet::ServingRule& rule, bool told) noexcept = 0;
  /// Nothing is taken any more, as this daemon leaves. @return what was served
  virtual std::vector<GivenUp> on_leave() noexcept = 0;
  /// Others serve these no more: told before the rule by which they are served here.
  virtual void on_given_up(std::span<const GivenUp> given) noexcept = 0;
  /// The fleet has changed.
  virtual void on_standing(const fleet::Standing& standing) noexcept = 0;
};

/// How long a daemon with a shard stays in each state before it serves.
struct FleetTimes {
  double listening_s = 1.0;  ///< without anybody new
  double joining_s = 1.0;    ///< at least, and until all that are known have greeted it
  double longest_s = 10.0;   ///< in either state, whoever is new or does not greet
  double hand_over_s = 5.0;  ///< for which a hand-over that was announced is waited for
};

/// Tells others by the user data of the writer of denoised samples which shard is served here, hears the same of every writer of that
/// topic in the same partitions, and keeps a fleet::Roster of it. News travel by DDS discovery, which is reliable, and the end of a daemon
/// is told or found out as that of any writer (a killed one after its lease, 10 s by default). How far a daemon has served what it gives
/// up goes by a topic of its own (gyrod::HandOver in the IDL); where our permissions forbid that, a warning says so and sensors change
/// hands by time alone.
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
  /// Waits until the other daemons have confirmed what they were told of sensors that were given up here. After leave().
  void wait_for_acknowledgements(std::chrono::milliseconds timeout) const noexcept;

  [[nodiscard]] fleet::Standing standing() const noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::bus
