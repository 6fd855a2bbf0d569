/// sensor_msgs/msg/Imu for Fast DDS, written by hand from idl/sensor_msgs_imu.idl.
#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>

namespace gyrod::testing {

/// Data is an ImuMessage; on the wire it is plain CDR (XCDR1) under the type name of ROS 2.
class FastDdsImuType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;

  FastDdsImuType();
  bool serialize(void* data, Payload* payload) override;
  bool deserialize(Payload* payload, void* data) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override;
  void deleteData(void* data) override;
  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool force_md5) override;
};

}  // namespace gyrod::testing
