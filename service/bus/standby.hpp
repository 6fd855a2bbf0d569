/// Several daemons, one output.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "bus/bus_options.hpp"
#include "bus/domain.hpp"
#include "bus/publisher.hpp"
#include "stream/report.hpp"
#include "stream/sample.hpp"

namespace gyrod::bus {

/// What a daemon of several knows and has done.
struct StandbySnapshot {
  std::size_t others = 0;    ///< other daemons with the same output
  std::size_t sensors = 0;   ///< sensors that this one publishes
  std::size_t held = 0;      ///< samples that wait to be heard from another daemon
  std::uint64_t let_go = 0;  ///< samples that another one has published
  std::uint64_t takeovers =
      0;  ///< times a sensor was taken over because another daemon had stopped publishing it

  /// The sum; of the others, the larger number.
  friend StandbySnapshot operator+(const StandbySnapshot& a, const StandbySnapshot& b) noexcept {
    return {std::max(a.others, b.others), a.sensors + b.sensors, a.held + b.held, a.let_go + b.let_go,
            a.takeovers + b.takeovers};
  }
};

/// Stands between engine and publisher where daemons of one domain have the same output topics, read the same sensors, and differ in
/// BusOptions::ownership_strength: each sample leaves once, from the strongest daemon that lives (held_samples.hpp tells how). To know
/// what the others publish, it reads the batch topics of the output itself.
///
/// A thread of its own looks for the others and publishes what has been held for too long. All calls by any thread.
class Standby {
 public:
  /// Where samples go that are to be published. Called with a lock held that all calls here wait for.
  class Sink {
   public:
    virtual ~Sink() = default;
    virtual void publish(std::string_view sensor,
                         std::span<const stream::DenoisedSample> samples) noexcept = 0;
    virtual void publish_realtime(std::string_view sensor,
                                  std::span<const stream::DenoisedSample> samples) noexcept = 0;
    virtual void end(std::string_view sensor) noexcept = 0;
    /// This daemon publishes sensors, though it may have nothing of them at the moment.
    virtual void assert_liveliness() noexcept = 0;
  };

  /// @pre options.ownership_strength > 0
  /// @throws BusError naming topic, QoS and DDS's answer
  Standby(const Domain& domain, const BusOptions& options, Sink& sink);
  /// As by stop().
  ~Standby();
  Standby(const Standby&) = delete;
  Standby& operator=(const Standby&) = delete;

  /// The engine has released these.
  void release(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept;
  void release_realtime(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept;
  /// The sensor has ended; the sink is told when nothing is held of it any more.
  void end(std::string_view sensor) noexcept;
  /// Whether this daemon publishes the sensor.
  [[nodiscard]] bool publishes(std::string_view sensor) const noexcept;

  /// Waits, takeover_s and a little at the most, until all that is held has been heard or published, then ends the thread. Idempotent.
  void stop() noexcept;

  [[nodiscard]] StandbySnapshot snapshot() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::bus
