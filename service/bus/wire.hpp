/// Between the wire's structs (idl/gyrod.idl) and the engine's (stream/). Internal to bus/. Nothing here
/// allocates.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <gyrod.h>
#include <span>
#include <string_view>

#include "bus/bus_options.hpp"
#include "core/denoise/window_report.hpp"
#include "stream/health.hpp"
#include "stream/report.hpp"
#include "stream/sample.hpp"

namespace gyrod::bus {

static_assert(gyrod_FLAG_WARMING_UP == static_cast<int>(stream::SampleFlag::kWarmingUp));
static_assert(gyrod_FLAG_TAIL == static_cast<int>(stream::SampleFlag::kTail));
static_assert(gyrod_FLAG_PASS_THROUGH == static_cast<int>(stream::SampleFlag::kPassThrough));
static_assert(gyrod_FLAG_HOP_WIDENED == static_cast<int>(stream::SampleFlag::kHopWidened));
static_assert(gyrod_FLAG_MODEL_MISFIT == static_cast<int>(stream::SampleFlag::kModelMisfit));
static_assert(gyrod_NOISE_SOURCE_NONE == static_cast<int>(stream::NoiseSource::kNone));
static_assert(gyrod_NOISE_SOURCE_IMF1 == static_cast<int>(stream::NoiseSource::kImf1));
static_assert(gyrod_NOISE_SOURCE_STANDSTILL == static_cast<int>(stream::NoiseSource::kStandstill));
static_assert(gyrod_NOISE_SOURCE_CALIBRATED == static_cast<int>(stream::NoiseSource::kCalibrated));
static_assert(gyrod_IMF_NOISE == static_cast<int>(core::ImfClass::kNoise));
static_assert(gyrod_IMF_MIXED == static_cast<int>(core::ImfClass::kMixed));
static_assert(gyrod_IMF_SIGNAL == static_cast<int>(core::ImfClass::kSignal));
static_assert(gyrod_HEALTH_OK == static_cast<int>(stream::Health::kOk));
static_assert(gyrod_HEALTH_WARMING_UP == static_cast<int>(stream::Health::kWarmingUp));
static_assert(gyrod_HEALTH_DEGRADED == static_cast<int>(stream::Health::kDegraded));
static_assert(gyrod_HEALTH_LOSSY == static_cast<int>(stream::Health::kLossy));
static_assert(gyrod_HEALTH_DRIFTING == static_cast<int>(stream::Health::kDrifting));
static_assert(gyrod_HEALTH_NOISY == static_cast<int>(stream::Health::kNoisy));
static_assert(gyrod_HEALTH_SATURATED == static_cast<int>(stream::Health::kSaturated));
static_assert(gyrod_HEALTH_STUCK == static_cast<int>(stream::Health::kStuck));
static_assert(gyrod_HEALTH_SILENT == static_cast<int>(stream::Health::kSilent));
static_assert(sizeof(gyrod_GyroSample::sensor) == kMaxSensorIdLength + 1);

/// Writes the key of a message. @pre fits_wire(sensor)
template <class Message>
void set_sensor(Message& message, std::string_view sensor) noexcept {
  assert(fits_wire(sensor));
  *std::copy(sensor.begin(), sensor.end(), message.sensor) = '\0';
}

/// A message's samples, whether it holds one or many. Valid as long as the message.
inline std::span<const gyrod_GyroSample> samples_of(const gyrod_GyroSample& message) noexcept {
  return {&message, 1};
}
inline std::span<const gyrod_GyroElement> samples_of(const gyrod_GyroBatch& message) noexcept {
  return {message.samples._buffer, message.samples._length};
}
inline std::span<const gyrod_DenoisedSample> samples_of(const gyrod_DenoisedSample& message) noexcept {
  return {&message, 1};
}
inline std::span<const gyrod_DenoisedElement> samples_of(const gyrod_DenoisedBatch& message) noexcept {
  return {message.samples._buffer, message.samples._length};
}

/// The fields that raw samples share, from a GyroSample or GyroElement. Denoised has them too.
template <class Wire, class Sample>
void copy_raw_fields(const Wire& wire, Sample& sample) noexcept {
  sample.sequence = wire.sequence_number;
  sample.stamp_ns = wire.stamp_ns;
  std::copy_n(wire.rate_radps, stream::kAxes, sample.rate_radps.begin());
}

inline void from_wire(const gyrod_GyroSample& wire, stream::Sample& sample) noexcept {
  copy_raw_fields(wire, sample);
}
inline void from_wire(const gyrod_GyroElement& wire, stream::Sample& sample) noexcept {
  copy_raw_fields(wire, sample);
}

/// A raw sample as a row of a recording: no flags, no noise floor.
template <class Wire>
void from_wire(const Wire& wire, stream::DenoisedSample& sample) noexcept {
  sample = stream::DenoisedSample{};
  copy_raw_fields(wire, sample);
  if constexpr (requires { wire.model_epoch; }) {
    std::copy_n(wire.rate_std_radps, stream::kAxes, sample.rate_std_radps.begin());
    sample.flags = wire.flags;
    sample.noise_source = static_cast<stream::NoiseSource>(wire.noise_source);
    std::copy_n(wire.noise_floor_radps, stream::kAxes, sample.noise_floor_radps.begin());
    sample.model_epoch = wire.model_epoch;
  }
}

/// Into a GyroSample or GyroElement; the key of a message is left as it is.
template <class Wire>
void to_wire(const stream::Sample& sample, Wire& wire) noexcept {
  wire.sequence_number = sample.sequence;
  wire.stamp_ns = sample.stamp_ns;
  std::copy_n(sample.rate_radps.begin(), stream::kAxes, wire.rate_radps);
}

/// Into a DenoisedSample or DenoisedElement; the key of a message is left as it is.
template <class Wire>
void to_wire(const stream::DenoisedSample& sample, Wire& wire) noexcept {
  wire.sequence_number = sample.sequence;
  wire.stamp_ns = sample.stamp_ns;
  std::copy_n(sample.rate_radps.begin(), stream::kAxes, wire.rate_radps);
  std::copy_n(sample.rate_std_radps.begin(), stream::kAxes, wire.rate_std_radps);
  wire.flags = sample.flags;
  wire.noise_source = static_cast<std::uint32_t>(sample.noise_source);
  std::copy_n(sample.noise_floor_radps.begin(), stream::kAxes, wire.noise_floor_radps);
  wire.model_epoch = sample.model_epoch;
}

/// The IMFs of a report in wire form; what a NoiseReport message's sequences point into.
using ImfReports = std::array<std::array<gyrod_ImfReport, core::kMaxImfs>, stream::kAxes>;

/// Fills all but the key. The message's sequences point into `imfs` and `report`, which have to outlive its
/// use.
void to_wire(const stream::NoiseReport& report, ImfReports& imfs, gyrod_NoiseReport& wire) noexcept;

/// Fills all but the key.
void to_wire(const stream::SensorHealth& before, const stream::SensorHealth& now, std::int64_t stamp_ns,
             gyrod_HealthReport& wire) noexcept;

}  // namespace gyrod::bus
