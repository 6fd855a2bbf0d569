#include "bus/topic_writer.hpp"

namespace gyrod::bus {

Entity create_topic(dds_entity_t participant, const std::string& name, const dds_topic_descriptor_t& type) {
  return {dds_create_topic(participant, &type, name.c_str(), nullptr, nullptr),
          "create topic '" + name + "' of type " + type.m_typename};
}

Entity create_writer(dds_entity_t participant, dds_entity_t topic, const std::string& name, const Qos& qos) {
  return {dds_create_writer(participant, topic, qos.get(), nullptr),
          "create a writer of topic '" + name + "' (" + qos.text() + ")"};
}

}  // namespace gyrod::bus
