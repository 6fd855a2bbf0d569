/// From an IDL type to its topic descriptor, at compile time. Internal to bus/.
#pragma once

#include <gyrod.h>
#include <sensor_msgs_imu.h>

namespace gyrod::bus {

/// kDescriptor is the type's descriptor as idlc made it; its m_typename is the type's name on the wire.
template <class Message>
struct TopicType;

template <>
struct TopicType<gyrod_GyroSample> {
  static constexpr const dds_topic_descriptor_t* kDescriptor = &gyrod_GyroSample_desc;
};
template <>
struct TopicType<gyrod_GyroBatch> {
  static constexpr const dds_topic_descriptor_t* kDescriptor = &gyrod_GyroBatch_desc;
};
template <>
struct TopicType<gyrod_DenoisedSample> {
  static constexpr const dds_topic_descriptor_t* kDescriptor = &gyrod_DenoisedSample_desc;
};
template <>
struct TopicType<gyrod_DenoisedBatch> {
  static constexpr const dds_topic_descriptor_t* kDescriptor = &gyrod_DenoisedBatch_desc;
};
template <>
struct TopicType<gyrod_NoiseReport> {
  static constexpr const dds_topic_descriptor_t* kDescriptor = &gyrod_NoiseReport_desc;
};
template <>
struct TopicType<gyrod_HealthReport> {
  static constexpr const dds_topic_descriptor_t* kDescriptor = &gyrod_HealthReport_desc;
};
template <>
struct TopicType<gyrod_HandOver> {
  static constexpr const dds_topic_descriptor_t* kDescriptor = &gyrod_HandOver_desc;
};
template <>
struct TopicType<sensor_msgs_msg_dds__Imu_> {
  static constexpr const dds_topic_descriptor_t* kDescriptor = &sensor_msgs_msg_dds__Imu__desc;
};

}  // namespace gyrod::bus
