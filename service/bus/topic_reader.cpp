#include "bus/topic_reader.hpp"

namespace gyrod::bus {

Entity create_reader(dds_entity_t participant, dds_entity_t topic, const std::string& name, const Qos& qos) {
  return {dds_create_reader(participant, topic, qos.get(), nullptr),
          "create a reader of topic '" + name + "' (" + qos.text() + ")"};
}

Entity create_data_condition(dds_entity_t reader, const std::string& name) {
  return {dds_create_readcondition(reader, DDS_ANY_STATE), "wait for samples of topic '" + name + "'"};
}

}  // namespace gyrod::bus
