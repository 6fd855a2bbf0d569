/// One topic's reader. Internal to bus/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "bus/entity.hpp"
#include "bus/loan.hpp"
#include "bus/qos.hpp"
#include "bus/topic_type.hpp"
#include "bus/topic_writer.hpp"

namespace gyrod::bus {

/// @throws BusError naming topic and QoS
[[nodiscard]] Entity create_reader(dds_entity_t participant, dds_entity_t topic, const std::string& name,
                                   const Qos& qos);

/// A condition that holds while the reader's cache holds anything: for a waitset.
[[nodiscard]] Entity create_data_condition(dds_entity_t reader, const std::string& name);

/// The sensor of an instance. @return an empty text where the reader has forgotten it
template <class Message>
[[nodiscard]] std::string sensor_of(dds_entity_t reader, dds_instance_handle_t instance) {
  Message key{};
  return dds_instance_get_key(reader, instance, &key) == DDS_RETCODE_OK ? key.sensor : "";
}

/// Takes messages of one type. One thread takes; the counts are for any thread.
///
/// The state that DDS gives with a message is the state of the moment it is taken, not of the message: a
/// sensor can be shown as ended while more of its messages wait in the cache. Whoever acts on an end takes
/// the sensor's rest first (take_sensor), and looks at the state that came with that.
template <class Message>
class TopicReader {
 public:
  /// @throws BusError
  TopicReader(dds_entity_t participant, const std::string& name, const Qos& qos)
      : topic_(create_topic(participant, name, *TopicType<Message>::kDescriptor)),
        reader_(create_reader(participant, topic_.get(), name, qos)),
        condition_(create_data_condition(reader_.get(), name)) {}

  /// Takes up to kMaxLoan messages of all sensors; calls visit(message, info) for each. info.valid_data tells
  /// whether there are samples in it or a mere change of state. @return messages taken
  template <class Visit>
  std::size_t take(Visit&& visit) const {
    return hand_out(Loan<Message>(reader_.get()), visit);
  }

  /// The same, until nothing of this sensor is left. @pre fits_wire(sensor)
  template <class Visit>
  void take_sensor(std::string_view sensor, Visit&& visit) const {
    Message key{};
    set_sensor(key, sensor);
    const dds_instance_handle_t instance = dds_lookup_instance(reader_.get(), &key);
    if (instance == DDS_HANDLE_NIL) return;
    while (hand_out(Loan<Message>(reader_.get(), instance), visit) > 0) {
    }
  }

  [[nodiscard]] dds_subscription_matched_status_t matched() const noexcept {
    dds_subscription_matched_status_t status{};
    (void)dds_get_subscription_matched_status(reader_.get(), &status);
    return status;
  }

  /// Times a message was refused because the cache or its sensors were at their limit. A reliable writer
  /// sends it again.
  [[nodiscard]] std::uint64_t refusals() const noexcept {
    dds_sample_rejected_status_t status{};
    (void)dds_get_sample_rejected_status(reader_.get(), &status);
    return status.total_count;
  }

  [[nodiscard]] dds_entity_t get() const noexcept { return reader_.get(); }
  [[nodiscard]] dds_entity_t data_condition() const noexcept { return condition_.get(); }

 private:
  template <class Visit>
  static std::size_t hand_out(const Loan<Message>& loan, Visit& visit) {
    for (std::size_t i = 0; i < loan.size(); ++i) visit(loan.message(i), loan.info(i));
    return loan.size();
  }

  Entity topic_;
  Entity reader_;
  Entity condition_;
};

}  // namespace gyrod::bus
