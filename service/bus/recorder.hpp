/// Any of gyrod's sample topics as rows: for `gyrod record` and for tests.
#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "bus/bus_options.hpp"
#include "bus/domain.hpp"
#include "stream/sample.hpp"

namespace gyrod::bus {

/// Where recorded samples go. May throw; the exception leaves Recorder::poll().
class RecordHandler {
 public:
  virtual ~RecordHandler() = default;
  /// Samples of one sensor in the order they were written. Of raw topics: flags, noise floor and model epoch
  /// are 0.
  /// @param sensor, samples valid during the call
  virtual void on_samples(std::string_view sensor, std::span<const stream::DenoisedSample> samples) = 0;
  /// The sensor has ended, after the last of its samples.
  virtual void on_end(std::string_view sensor) = 0;
};

/// Reads one topic of type GyroSample, GyroBatch, DenoisedSample or DenoisedBatch, and keeps all until it is
/// polled: poll often. One thread at a time.
class Recorder {
 public:
  enum class Poll {
    kSamples,  ///< something was handed over
    kNothing,  ///< nothing came in time
    kEnded,  ///< there were writers, the last one has gone, and all it wrote was handed over. More may come.
  };

  /// A topic under its configured name has the type that belongs to it, and is read from this moment on. For
  /// any other topic, waits for a writer and takes the type, partitions and ownership it shows. Losses of reliable writers are repaired, others
  /// are read, too.
  /// @param discovery_timeout how long to wait for that writer
  /// @throws BusError naming the topic: no writer in time, or a type that is not one of the four (named)
  Recorder(const Domain& domain, const BusOptions& options, const std::string& topic,
           std::chrono::milliseconds discovery_timeout);
  ~Recorder();
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;

  /// Waits for samples and hands over what has come.
  Poll poll(std::chrono::milliseconds timeout, RecordHandler& handler);

  /// The type of the topic, e.g. "gyrod::DenoisedSample".
  [[nodiscard]] std::string_view type_name() const noexcept;
  /// Writers that send to this recorder.
  [[nodiscard]] std::size_t matched_writers() const noexcept;

 private:
  class Source;
  template <class Message>
  class TypedSource;
  static std::unique_ptr<Source> create(const Domain& domain, const BusOptions& options,
                                        const std::string& topic,
                                        std::chrono::milliseconds discovery_timeout);

  std::unique_ptr<Source> source_;
};

}  // namespace gyrod::bus
