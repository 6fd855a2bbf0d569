/// Gathers the samples of one sensor while messages are handed out. Internal to bus/.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bus/bus_options.hpp"
#include "bus/wire.hpp"

namespace gyrod::bus {

/// Turns messages into spans: consecutive samples of one sensor, over message borders, become one call of the
/// handler's on_samples(). Whoever adds calls flush() in the end. Allocates when it is made, not after.
template <class Sample, class Handler>
class SampleRun {
 public:
  explicit SampleRun(Handler& handler) : handler_(handler), samples_(kCapacity) {
    sensor_.reserve(kMaxSensorIdLength);
  }

  /// @param wire samples in wire form, of one sensor
  template <class Wire>
  void add(std::string_view sensor, std::span<const Wire> wire) {
    if (sensor != sensor_) {
      flush();
      sensor_ = sensor;
    }
    for (const Wire& sample : wire) {
      if (size_ == kCapacity) flush();
      from_wire(sample, samples_[size_++]);
    }
  }

  void flush() {
    if (size_ == 0) return;
    // Emptied first: a handler that throws leaves no sample to be handed over twice.
    const std::span<const Sample> run(samples_.data(), std::exchange(size_, 0));
    handler_.on_samples(sensor_, run);
  }

 private:
  static constexpr std::size_t kCapacity = 1024;

  Handler& handler_;
  std::vector<Sample> samples_;
  std::size_t size_ = 0;
  std::string sensor_;
};

}  // namespace gyrod::bus
