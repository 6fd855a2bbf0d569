#include "support/imu_message.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <sstream>

#include "support/samples.hpp"

namespace gyrod::testing {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

template <std::size_t n>
void append_bits(const double (&values)[n], std::vector<std::uint64_t>& bits) {
  std::transform(std::begin(values), std::end(values), std::back_inserter(bits),
                 [](double value) { return std::bit_cast<std::uint64_t>(value); });
}

}  // namespace

ImuMessage imu_message(std::uint64_t n, std::int64_t stamp_ns, const std::array<double, 3>& rate_radps) {
  const auto value = static_cast<double>(n);
  ImuMessage message;
  auto& fields = message.fields;
  fields.header.stamp = {static_cast<std::int32_t>(stamp_ns / kNsPerS),
                         static_cast<std::uint32_t>(stamp_ns % kNsPerS)};
  message.frame_id = "imu_link_" + std::to_string(n % 3);
  fields.orientation = {value / 3.0, -value, -0.0, 1.0 / (value + 1.0)};
  fields.angular_velocity = {rate_radps[0], rate_radps[1], rate_radps[2]};
  fields.linear_acceleration = {0.1 * value, 9.81, -value / 7.0};
  for (std::size_t i = 0; i < 9; ++i) {
    fields.orientation_covariance[i] = i == 0 ? -1.0 : value + static_cast<double>(i);
    fields.angular_velocity_covariance[i] = 1e-3 * static_cast<double>(i + 1);
    fields.linear_acceleration_covariance[i] = value * static_cast<double>(i) / 11.0;
  }
  return message;
}

std::int64_t stamp_ns_of(const ImuMessage& message) {
  return message.fields.header.stamp.sec * kNsPerS + message.fields.header.stamp.nanosec;
}

std::array<double, 3> rates_of(const ImuMessage& message) {
  const auto& rate = message.fields.angular_velocity;
  return {rate.x, rate.y, rate.z};
}

std::vector<ImuMessage> noisy_imu_messages(std::uint64_t count) {
  constexpr std::int64_t kFirstStampNs = 1'700'000'000 * kNsPerS;
  std::vector<ImuMessage> messages;
  for (const stream::Sample& sample : noisy_samples(count))
    messages.push_back(imu_message(sample.sequence, kFirstStampNs + sample.stamp_ns, sample.rate_radps));
  return messages;
}

std::string recording_of(const std::vector<ImuMessage>& messages) {
  std::ostringstream text;
  text.precision(17);
  text << "stamp_ns,gyro_x_radps,gyro_y_radps,gyro_z_radps,accel_x_mps2,accel_y_mps2,accel_z_mps2\n";
  for (const ImuMessage& message : messages) {
    const auto rates = rates_of(message);
    text << stamp_ns_of(message) << ',' << rates[0] << ',' << rates[1] << ',' << rates[2];
    const auto& force = message.fields.linear_acceleration;
    text << ',' << force.x << ',' << force.y << ',' << force.z << '\n';
  }
  return text.str();
}

UntouchedBits untouched_bits(const ImuMessage& message) {
  const auto& fields = message.fields;
  UntouchedBits untouched{.frame_id = message.frame_id, .bits = {}};
  untouched.bits = {static_cast<std::uint32_t>(fields.header.stamp.sec), fields.header.stamp.nanosec};
  append_bits({fields.orientation.x, fields.orientation.y, fields.orientation.z, fields.orientation.w},
              untouched.bits);
  append_bits(fields.orientation_covariance, untouched.bits);
  append_bits({fields.linear_acceleration.x, fields.linear_acceleration.y, fields.linear_acceleration.z},
              untouched.bits);
  append_bits(fields.linear_acceleration_covariance, untouched.bits);
  return untouched;
}

}  // namespace gyrod::testing
