/// One topic's writer. Internal to bus/.
#pragma once

#include <string>
#include <string_view>

#include "bus/entity.hpp"
#include "bus/qos.hpp"
#include "bus/topic_type.hpp"
#include "bus/wire.hpp"

namespace gyrod::bus {

/// @throws BusError naming topic, type and participant's answer
[[nodiscard]] Entity create_topic(dds_entity_t participant, const std::string& name,
                                  const dds_topic_descriptor_t& type);

/// @throws BusError naming topic and QoS
[[nodiscard]] Entity create_writer(dds_entity_t participant, dds_entity_t topic, const std::string& name,
                                   const Qos& qos);

/// Writes messages of one type. The process batches writes (see Domain): nothing is sure to leave before
/// flush(). Thread-safe.
template <class Message>
class TopicWriter {
 public:
  /// @throws BusError
  TopicWriter(dds_entity_t participant, const std::string& name, const Qos& qos)
      : topic_(create_topic(participant, name, *TopicType<Message>::kDescriptor)),
        writer_(create_writer(participant, topic_.get(), name, qos)) {}

  /// @return DDS_RETCODE_OK, or why the message was not written
  [[nodiscard]] dds_return_t write(const Message& message) const noexcept {
    return dds_write(writer_.get(), &message);
  }

  void flush() const noexcept { dds_write_flush(writer_.get()); }

  /// Readers that match in type and QoS.
  [[nodiscard]] std::size_t matched_readers() const noexcept {
    dds_publication_matched_status_t status{};
    (void)dds_get_publication_matched_status(writer_.get(), &status);
    return status.current_count;
  }

  /// Whether anyone listens.
  [[nodiscard]] bool has_readers() const noexcept { return matched_readers() > 0; }

  /// Tells the readers that this writer has no more of the sensor, and forgets it. @pre fits_wire(sensor)
  /// @return DDS_RETCODE_OK, or why that could not be written
  [[nodiscard]] dds_return_t end(std::string_view sensor) const noexcept {
    Message key{};
    set_sensor(key, sensor);
    const dds_return_t written = dds_unregister_instance(writer_.get(), &key);
    flush();
    return written;
  }

  [[nodiscard]] dds_entity_t get() const noexcept { return writer_.get(); }

 private:
  Entity topic_;
  Entity writer_;
};

}  // namespace gyrod::bus
