/// What metrics and JSON API tell of a sensor in the same way: one place decides what is known and what is not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "stream/counters.hpp"

namespace gyrod::monitor {

using Value = std::optional<double>;

/// Nothing for a figure whose 0 means "not known".
[[nodiscard]] inline Value known(double value) { return value > 0.0 ? Value(value) : std::nullopt; }

[[nodiscard]] inline bool has_report(const stream::ChannelSnapshot& sensor) {
  return sensor.last_report.model_epoch > 0;
}

/// 0 normal, 1 hop widened, 2 passed through.
[[nodiscard]] inline int overload_step(const stream::ChannelSnapshot& sensor) {
  if (sensor.pass_through) return 2;
  const bool widened =
      (sensor.last_report.flags & static_cast<std::uint32_t>(stream::SampleFlag::kHopWidened)) != 0;
  return widened ? 1 : 0;
}

/// x, y, z, rad/s; 0 where it is not known.
[[nodiscard]] inline std::array<double, stream::kAxes> noise_floors(const stream::ChannelSnapshot& sensor) {
  const auto& axis = sensor.last_report.axis;
  return {axis[0].noise_floor, axis[1].noise_floor, axis[2].noise_floor};
}

/// Hz, of the narrow tone that stands out most in the last window.
[[nodiscard]] inline Value tone_frequency(const stream::ChannelSnapshot& sensor, std::size_t axis) {
  const stream::NoiseReport& report = sensor.last_report;
  return has_report(sensor) ? known(report.axis[axis].tone_frequency_cycles * report.sample_rate_hz)
                            : std::nullopt;
}

[[nodiscard]] inline Value coefficient(const stream::ChannelSnapshot& sensor, std::size_t axis,
                                       core::NoiseTerm term) {
  const core::Coefficient& found = sensor.coefficients[axis][term];
  return found.observable ? Value(found.value) : std::nullopt;
}

/// Terms of one sample are a sample apart.
[[nodiscard]] inline Value rest_seconds(const stream::ChannelSnapshot& sensor) {
  if (!(sensor.curves_rate_hz > 0.0)) return std::nullopt;
  return static_cast<double>(sensor.curves[0].terms[0]) / sensor.curves_rate_hz;
}

}  // namespace gyrod::monitor
