#include "support/imu_node.hpp"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "support/eventually.hpp"

namespace gyrod::testing {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

dds_entity_t checked(dds_entity_t entity, const std::string& what) {
  if (entity < 0) throw std::runtime_error(what + ": " + dds_strretcode(-entity));
  return entity;
}

dds_entity_t create_topic(dds_entity_t participant, const std::string& name) {
  return checked(
      dds_create_topic(participant, &sensor_msgs_msg_dds__Imu__desc, name.c_str(), nullptr, nullptr), name);
}

dds_qos_t* sensor_qos(bool reliable) {
  constexpr std::int32_t kDepth = 10000;
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_SECS(1));
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, kDepth);
  return qos;
}

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

ImuPublisher::ImuPublisher(dds_entity_t participant, const std::string& topic, bool reliable)
    : topic_(create_topic(participant, topic)) {
  dds_qos_t* qos = sensor_qos(reliable);
  writer_ = dds_create_writer(participant, topic_, qos, nullptr);
  dds_delete_qos(qos);
  checked(writer_, topic);
}

ImuPublisher::~ImuPublisher() {
  (void)dds_delete(writer_);
  (void)dds_delete(topic_);
}

void ImuPublisher::publish(const ImuMessage& message) const {
  auto fields = message.fields;
  std::string frame_id = message.frame_id;
  fields.header.frame_id = frame_id.data();
  checked(dds_write(writer_, &fields), "write");
  dds_write_flush(writer_);
}

bool ImuPublisher::wait_for_reader() const {
  return eventually([this] {
    dds_publication_matched_status_t status{};
    return dds_get_publication_matched_status(writer_, &status) == DDS_RETCODE_OK && status.current_count > 0;
  });
}

ImuSubscription::ImuSubscription(dds_entity_t participant, const std::string& topic, bool reliable)
    : topic_(create_topic(participant, topic)) {
  dds_qos_t* qos = sensor_qos(reliable);
  reader_ = dds_create_reader(participant, topic_, qos, nullptr);
  dds_delete_qos(qos);
  checked(reader_, topic);
}

ImuSubscription::~ImuSubscription() {
  (void)dds_delete(reader_);
  (void)dds_delete(topic_);
}

std::size_t ImuSubscription::matched_writers() const {
  dds_subscription_matched_status_t status{};
  checked(dds_get_subscription_matched_status(reader_, &status), "matched");
  return status.current_count;
}

bool ImuSubscription::wait_for_writer() const {
  return eventually([this] { return matched_writers() > 0; });
}

bool ImuSubscription::wait_for(std::size_t count) {
  return eventually([this, count] { return messages().size() >= count; });
}

const std::vector<ImuMessage>& ImuSubscription::messages() {
  constexpr std::size_t kMost = 64;
  std::array<dds_sample_info_t, kMost> infos;
  while (true) {
    std::array<void*, kMost> loans{};
    const dds_return_t taken = dds_take(reader_, loans.data(), infos.data(), kMost, kMost);
    if (taken <= 0) return messages_;
    for (std::size_t i = 0; i < static_cast<std::size_t>(taken); ++i) {
      if (!infos[i].valid_data) continue;
      const auto& fields = *static_cast<const sensor_msgs_msg_dds__Imu_*>(loans[i]);
      messages_.push_back({fields, fields.header.frame_id});
    }
    (void)dds_return_loan(reader_, loans.data(), taken);
  }
}

}  // namespace gyrod::testing
