/// Raw samples from DDS.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "bus/broken_promises.hpp"
#include "bus/bus_options.hpp"
#include "bus/domain.hpp"
#include "stream/counters.hpp"
#include "stream/sample.hpp"

namespace gyrod::bus {

/// Where received samples go. Called by the subscriber's thread only.
class SampleHandler {
 public:
  virtual ~SampleHandler() = default;
  /// Samples of one sensor in the order its writer wrote them to the topic. May take its time: see
  /// Subscriber.
  /// @param sensor, samples valid during the call
  virtual void on_samples(std::string_view sensor, std::span<const stream::Sample> samples) noexcept = 0;
  /// The sensor has ended: its last writer disposed or unregistered it, or went away. Comes after the last of
  /// its samples and at most once until samples come again. @param sensor valid during the call
  virtual void on_end(std::string_view sensor) noexcept = 0;
  /// The sensor's writer was out of sight, and is back: where it keeps its newest samples for readers that come later, those that were handed
  /// over come once more, before the others. Comes before its samples.
  virtual void on_return(std::string_view sensor) noexcept = 0;
  /// Its writer did not keep what it promised (BusOptions::input). @param why kDeadlineMissed, or, after on_end(), kLivelinessLost
  virtual void on_broken_promise(std::string_view sensor, stream::ChannelState why) noexcept = 0;
};

/// Reads both raw topics on one thread of its own, and hands over in spans: consecutive samples of one sensor
/// in what was taken become one call. A sensor that uses both topics ends when it has ended on both.
///
/// While the handler takes its time, samples stay in the readers' caches; a full cache makes reliable writers
/// wait (History::kKeepAll) or loses a sensor's oldest samples (kKeepLast). Nothing is allocated for a
/// sample; the middleware allocates for a batch message.
///
/// start() and stop() belong to one thread; the counts may be read by any.
class Subscriber {
 public:
  /// The readers exist and fill their caches from now on. @param handler has to outlive the subscriber
  /// @throws BusError naming topic, QoS and DDS's answer
  Subscriber(const Domain& domain, const BusOptions& options, SampleHandler& handler);
  /// As by stop().
  ~Subscriber();
  Subscriber(const Subscriber&) = delete;
  Subscriber& operator=(const Subscriber&) = delete;

  /// Begins to hand over. Once.
  void start();

  /// Hands over all that the readers have confirmed to their writers, and leaves the topics; what comes later
  /// stays with its writer. Idempotent.
  void stop() noexcept;

  /// Writers that send to this subscriber, both topics together.
  [[nodiscard]] std::size_t matched_writers() const noexcept;

  /// Messages that were dropped whole: an empty sensor id, or more samples than
  /// BusOptions::max_batch_samples.
  [[nodiscard]] std::uint64_t malformed_messages() const noexcept;

  /// Times a message was refused because a cache was full or knew max_instances sensors; reliable writers try
  /// again. Grows while writers are held back.
  [[nodiscard]] std::uint64_t refusals() const noexcept;

  [[nodiscard]] BrokenPromises broken_promises() const noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::bus
