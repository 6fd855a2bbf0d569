/// Samples of one or several sensors to DDS, at the pace of their stamps: what `replay` and `simulate` share.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "app/flags.hpp"
#include "app/interrupt.hpp"
#include "app/pacer.hpp"
#include "bus/domain.hpp"
#include "bus/raw_writer.hpp"
#include "settings/settings.hpp"
#include "stream/sample.hpp"

namespace gyrod::app {

struct SendFlags {
  std::string sensor;
  std::size_t sensors = 1;  ///< more than one: `sensor` and "_1", "_2", ...
  std::size_t batch = 1;
  double wait_s = 10.0;
  std::size_t keep = 0;  ///< samples
  SpeedFlag speed;

  /// Adds --batch, --wait, --keep and --speed; --sensor differs from command to command.
  void add_to(CLI::App& command);
};

/// One thread.
class SampleSender {
 public:
  /// Joins the domain and waits for a reader.
  /// @throws CLI::ValidationError for a batch above settings.max_batch_samples; bus::BusError; Incomplete if nobody reads within flags.wait_s
  SampleSender(const settings::BusSettings& settings, const SendFlags& flags, Interrupt& interrupt);

  /// Sends the sample when it is due, together with its batch.
  /// @param sensor 0..flags.sensors - 1; their due times come in order
  /// @return false if that was interrupted
  /// @throws bus::BusError; Incomplete if the readers take nothing for a minute
  [[nodiscard]] bool send(const stream::Sample& sample, std::size_t sensor = 0);

  /// Sends the rest, tells that the sensors have ended, and waits until all of it has arrived.
  /// @throws as send()
  void finish();

  /// Samples handed to DDS.
  [[nodiscard]] std::uint64_t sent() const noexcept { return sent_; }

 private:
  /// What waits to be sent together.
  struct Source {
    std::string sensor;
    std::vector<stream::Sample> waiting;
  };

  [[nodiscard]] bool flush(Source& source);
  template <class Attempt>
  [[nodiscard]] bool insist(const Attempt& attempt);

  std::string topic_;
  std::size_t chunk_;  ///< samples sent together
  Interrupt& interrupt_;
  Pacer pacer_;
  bus::Domain domain_;
  bus::RawWriter writer_;
  std::vector<Source> sources_;
  std::uint64_t sent_ = 0;
};

}  // namespace gyrod::app
