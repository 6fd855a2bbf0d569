/// Imu messages for tests, without any middleware.
#pragma once

#include <array>
#include <cstdint>
#include <sensor_msgs_imu.h>
#include <string>
#include <vector>

namespace gyrod::testing {

/// A message that owns its frame id.
struct ImuMessage {
  sensor_msgs_msg_dds__Imu_ fields{};  ///< but for header.frame_id, which means nothing
  std::string frame_id;
};

/// Message number n, told apart from others by every bit of its fields, with these rates and stamp.
[[nodiscard]] ImuMessage imu_message(std::uint64_t n, std::int64_t stamp_ns,
                                     const std::array<double, 3>& rate_radps);

[[nodiscard]] std::int64_t stamp_ns_of(const ImuMessage& message);
[[nodiscard]] std::array<double, 3> rates_of(const ImuMessage& message);

/// `count` messages of a 100 Hz sensor with the rates of noisy_samples(), from November 2023 on.
[[nodiscard]] std::vector<ImuMessage> noisy_imu_messages(std::uint64_t count);
/// A recording of these messages as a ROS 2 node would write it: stamps, rates and accelerations, no number.
[[nodiscard]] std::string recording_of(const std::vector<ImuMessage>& messages);

/// Everything that gyrod must not touch, bit for bit.
struct UntouchedBits {
  std::string frame_id;
  std::vector<std::uint64_t> bits;
  bool operator==(const UntouchedBits&) const = default;
};
[[nodiscard]] UntouchedBits untouched_bits(const ImuMessage& message);

}  // namespace gyrod::testing
