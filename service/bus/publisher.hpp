/// Denoised samples and noise reports to DDS.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "bus/bus_options.hpp"
#include "bus/domain.hpp"
#include "bus/topic_readers.hpp"
#include "stream/health.hpp"
#include "stream/report.hpp"
#include "stream/sample.hpp"

namespace gyrod::bus {

/// Publishes what the engine releases. Never waits for a reader on the network: it keeps the last messages of
/// every sensor and lets go of older ones. Every method may be called by several threads at once; one
/// sensor's samples stay in the order of the calls if its calls do not overlap (as with stream::Sink).
class Publisher {
 public:
  /// @throws BusError naming topic, QoS and DDS's answer
  Publisher(const Domain& domain, const BusOptions& options);
  ~Publisher();
  Publisher(Publisher&&) noexcept;
  Publisher& operator=(Publisher&&) noexcept;

  /// Writes every sample to the topic of singles and all of them, in batches, to the topic of batches; a
  /// topic without readers costs next to nothing. Everything has left when it returns. Allocates only a
  /// thread's first time.
  /// @pre fits_wire(sensor)
  void publish(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept;

  /// Writes estimates without look-ahead to topics of their own, in the same way: a batch message holds what one call brings.
  /// @pre fits_wire(sensor), BusOptions::realtime
  void publish_realtime(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept;

  /// Writes the report, also without a reader: a later one gets the newest. @pre fits_wire(sensor)
  void publish_report(std::string_view sensor, const stream::NoiseReport& report) noexcept;

  /// Writes a change of health, also without a reader: a later one gets the newest. @pre fits_wire(sensor)
  /// @param stamp_ns when, ns since the epoch
  void publish_health(std::string_view sensor, const stream::SensorHealth& before,
                      const stream::SensorHealth& now, std::int64_t stamp_ns) noexcept;

  /// The sensor is forgotten: its health, too. @pre fits_wire(sensor)
  void unregister_health(std::string_view sensor) noexcept;

  /// The sensor has ended: readers are told after what was published before, and what the writers keep of it
  /// is let go.
  /// @pre fits_wire(sensor)
  void unregister_sensor(std::string_view sensor) noexcept;

  /// Waits until every reliable reader has confirmed what was published; call it before the end, so that the
  /// last samples arrive.
  /// @return false if they did not in time
  bool wait_for_acknowledgements(std::chrono::milliseconds timeout) noexcept;

  /// Tells the readers that this publisher is alive, where BusOptions::ownership_strength is above 0: who neither says so nor publishes
  /// is replaced after half of takeover_s.
  void assert_liveliness() const noexcept;

  /// Messages that DDS did not take.
  [[nodiscard]] std::uint64_t write_errors() const noexcept;

  /// Of each topic that is written here.
  [[nodiscard]] std::vector<TopicReaders> matched_readers() const;

  /// The DDS handle of the writer of single denoised samples. For the other classes of bus/.
  [[nodiscard]] std::int32_t denoised_writer() const noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::bus
