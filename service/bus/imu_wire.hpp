/// Between ROS 2's Imu message (idl/sensor_msgs_imu.idl) and the engine's samples. Internal to bus/. Nothing here allocates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sensor_msgs_imu.h>

#include "stream/sample.hpp"

namespace gyrod::bus {

using Imu = sensor_msgs_msg_dds__Imu_;

/// ns since the Unix epoch. Exact: 2^31 s are less than 2^63 ns.
inline std::int64_t stamp_ns_of(const Imu& message) noexcept {
  constexpr std::int64_t kNsPerS = 1'000'000'000;
  return std::int64_t{message.header.stamp.sec} * kNsPerS + std::int64_t{message.header.stamp.nanosec};
}

/// ROS 2's way to say that a message does not tell the quantity to which this covariance belongs. Exact, by its definition.
inline bool is_not_measured(const double (&covariance)[9]) noexcept { return covariance[0] == -1.0; }

/// The message as the engine sees it. ROS 2 counts nothing, so the sequence number stays 0: the engine then goes by stamps. A
/// message that says it has no angular velocity has NaN, and is refused like one that holds NaN. Its linear acceleration is what the
/// accelerometer measured, gravity included: the specific force; a message can say that it has none.
inline stream::Sample sample_of(const Imu& message) noexcept {
  stream::Sample sample;
  sample.stamp_ns = stamp_ns_of(message);
  sample.rate_radps = {message.angular_velocity.x, message.angular_velocity.y, message.angular_velocity.z};
  if (is_not_measured(message.angular_velocity_covariance))
    sample.rate_radps.fill(std::numeric_limits<double>::quiet_NaN());
  if (!is_not_measured(message.linear_acceleration_covariance)) {
    const auto& force = message.linear_acceleration;
    sample.specific_force_mps2 = {force.x, force.y, force.z};
  }
  return sample;
}

/// Whether the deviations of a sample can be relied on: a model is in use (before the first one they are guesses from a few samples),
/// and each is known.
inline bool has_deviations(const stream::DenoisedSample& sample) noexcept {
  const auto is_known = [](double deviation) { return deviation > 0.0 && std::isfinite(deviation); };
  return sample.model_epoch > 0 &&
         std::all_of(sample.rate_std_radps.begin(), sample.rate_std_radps.end(), is_known);
}

/// Puts the sample's rates into the message, and their variances, (rad/s)^2, on the diagonal of the covariance: the squares of
/// rate_std_radps, or all 0, which in ROS 2 says unknown. What passed through undenoised leaves the message as it is.
inline void set_rates(Imu& message, const stream::DenoisedSample& sample) noexcept {
  if ((sample.flags & static_cast<std::uint32_t>(stream::SampleFlag::kPassThrough)) != 0) return;
  message.angular_velocity = {sample.rate_radps[0], sample.rate_radps[1], sample.rate_radps[2]};
  std::fill(std::begin(message.angular_velocity_covariance), std::end(message.angular_velocity_covariance),
            0.0);
  if (!has_deviations(sample)) return;
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    const double deviation = sample.rate_std_radps[axis];
    message.angular_velocity_covariance[axis * (stream::kAxes + 1)] = deviation * deviation;
  }
}

}  // namespace gyrod::bus
