#include "interop/fastdds_imu_type.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include "support/imu_message.hpp"

namespace gyrod::testing {
namespace {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

/// Header of the encapsulation, stamp, a frame id of at most 255 characters, 37 doubles, and room to align them.
constexpr std::uint32_t kMostBytes = 4 + 8 + 4 + 256 + 37 * 8 + 8;

ImuMessage& message_at(void* data) { return *static_cast<ImuMessage*>(data); }

/// Every member in the order of the wire, for reading and writing alike.
template <class Visit>
void visit_members(ImuMessage& message, const Visit& visit) {
  auto& fields = message.fields;
  visit(fields.header.stamp.sec);
  visit(fields.header.stamp.nanosec);
  visit(message.frame_id);
  visit(fields.orientation.x);
  visit(fields.orientation.y);
  visit(fields.orientation.z);
  visit(fields.orientation.w);
  for (double& element : fields.orientation_covariance) visit(element);
  visit(fields.angular_velocity.x);
  visit(fields.angular_velocity.y);
  visit(fields.angular_velocity.z);
  for (double& element : fields.angular_velocity_covariance) visit(element);
  visit(fields.linear_acceleration.x);
  visit(fields.linear_acceleration.y);
  visit(fields.linear_acceleration.z);
  for (double& element : fields.linear_acceleration_covariance) visit(element);
}

}  // namespace

FastDdsImuType::FastDdsImuType() {
  setName("sensor_msgs::msg::dds_::Imu_");
  m_typeSize = kMostBytes;
  m_isGetKeyDefined = false;
  auto_fill_type_object(false);  // as ROS 2 does: topic and type name decide
  auto_fill_type_information(false);
}

bool FastDdsImuType::serialize(void* data, Payload* payload) {
  FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->max_size);
  Cdr stream(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
  payload->encapsulation = stream.endianness() == Cdr::BIG_ENDIANNESS ? CDR_BE : CDR_LE;
  stream.serialize_encapsulation();
  visit_members(message_at(data), [&stream](auto& member) { stream << member; });
  payload->length = static_cast<std::uint32_t>(stream.getSerializedDataLength());
  return true;
}

bool FastDdsImuType::deserialize(Payload* payload, void* data) {
  FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
  Cdr stream(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
  stream.read_encapsulation();
  payload->encapsulation = stream.endianness() == Cdr::BIG_ENDIANNESS ? CDR_BE : CDR_LE;
  visit_members(message_at(data), [&stream](auto& member) { stream >> member; });
  return true;
}

std::function<std::uint32_t()> FastDdsImuType::getSerializedSizeProvider(void* /*data*/) {
  return [] { return kMostBytes; };
}

void* FastDdsImuType::createData() { return new ImuMessage; }
void FastDdsImuType::deleteData(void* data) { delete &message_at(data); }

bool FastDdsImuType::getKey(void* /*data*/, eprosima::fastrtps::rtps::InstanceHandle_t* /*handle*/,
                            bool /*force_md5*/) {
  return false;
}

}  // namespace gyrod::testing
