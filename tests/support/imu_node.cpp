#include "support/imu_node.hpp"

#include <array>
#include <stdexcept>

#include "support/eventually.hpp"

namespace gyrod::testing {
namespace {

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

}  // namespace

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
