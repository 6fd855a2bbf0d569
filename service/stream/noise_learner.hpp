/// What is known beforehand of a channel's own noise, and who finds out more while samples flow.
#pragma once

#include <array>
#include <optional>

#include "core/noise/noise_model.hpp"
#include "stream/rest_evidence.hpp"
#include "stream/sample.hpp"

namespace gyrod::stream {

/// Noise of one sensor, and where that comes from.
struct ChannelNoise {
  /// Of all three axes: the weakest of theirs. kNone: the models mean nothing, and methods judge by the window itself.
  NoiseSource source = NoiseSource::kNone;
  /// x, y, z, (rad/s)^2; usable (core::is_usable) unless the source is kNone, or kImf1 and of an axis lines at most are known.
  std::array<core::NoiseModel, kAxes> axis{};

  friend bool operator==(const ChannelNoise&, const ChannelNoise&) = default;
};

/// Learns the noise of one channel from its samples. One a channel, called by the thread that pushes. A pure function of the calls:
/// no clock, no random numbers, so that what it finds is used from the same sample on, live and offline, with any number of workers
/// and any batching. After construction it allocates nothing.
class NoiseLearner {
 public:
  virtual ~NoiseLearner() = default;
  /// Takes the next position of the uniform time base.
  /// @param measured false for a bridged position: its rates are interpolated, number and stamp those of the sample before
  /// @param sample_rate_hz of the channel as known by now: configured or from the stamps, which may change it; 0 while unknown
  virtual void step(const Sample& sample, bool measured, double sample_rate_hz) noexcept = 0;
  /// Asked after every step: the noise to use from here on, where the step has changed what is known. Windows that end with this
  /// sample or later are given it; those that wait for a worker keep what they had.
  [[nodiscard]] virtual std::optional<ChannelNoise> update() noexcept = 0;
  /// The unbroken stretch has ended: the next sample is not the neighbour of the last. What was learned stays.
  virtual void reset_segment() noexcept = 0;
  /// The sensor is at rest as far as the samples tell.
  [[nodiscard]] virtual bool at_rest() const noexcept = 0;
  /// Asked after every step: what a block of samples says, where the step has ended one; else nullptr. Valid until the next step.
  [[nodiscard]] virtual const RestEvidence* evidence() const noexcept { return nullptr; }
};

}  // namespace gyrod::stream
