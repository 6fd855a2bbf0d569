/// Raw samples to DDS: what a gyroscope's driver does, for `gyrod replay` and `gyrod simulate`.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "bus/bus_options.hpp"
#include "bus/domain.hpp"
#include "stream/sample.hpp"

namespace gyrod::bus {

/// Publishes raw samples of any number of sensors, reliably and keeping all: slow readers slow the writer
/// down, nothing is lost. One thread at a time.
class RawWriter {
 public:
  /// @param batch_samples 1 writes to the topic of single samples; 2..max_batch_samples to the topic of
  /// batches, with that many
  ///        samples a message at the most
  /// @param past messages of every sensor that are kept for readers that come later; 0: none
  /// @throws BusError naming topic, QoS and DDS's answer
  RawWriter(const Domain& domain, const BusOptions& options, std::size_t batch_samples = 1,
            std::size_t past = 0);
  ~RawWriter();
  RawWriter(RawWriter&&) noexcept;
  RawWriter& operator=(RawWriter&&) noexcept;

  /// Writes the samples, oldest first, waiting while readers hold the writer back, but no longer than 1 s a
  /// message.
  /// @return samples written; fewer than given means that readers held back for 1 s: call again with the
  /// rest, or give up
  /// @throws BusError if the sensor id does not fit the wire, or for any other refusal
  [[nodiscard]] std::size_t publish(std::string_view sensor, std::span<const stream::Sample> samples);

  /// Tells the readers that the sensor has ended, after all that was published.
  /// @return false if readers held back for 1 s: call again
  /// @throws BusError as publish()
  [[nodiscard]] bool end(std::string_view sensor);

  /// @return whether a reader has matched by then. Samples published without one are lost.
  [[nodiscard]] bool wait_for_subscriber(std::chrono::milliseconds timeout);

  /// @return whether every reader on the network has confirmed all that was published
  [[nodiscard]] bool wait_for_acknowledgements(std::chrono::milliseconds timeout);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::bus
