/// What other programs send, for integration tests.
#pragma once

#include <dds/dds.h>
#include <gtest/gtest.h>

#include "support/eventually.hpp"

namespace gyrod::testing {

/// A writer of a type under the name of another: what a program of another version, or a hostile one, sends.
class ForeignWriter {
 public:
  ForeignWriter(dds_entity_t participant, const dds_topic_descriptor_t& type, const char* name,
                const char* topic)
      : type_{.m_size = type.m_size,
              .m_align = type.m_align,
              .m_flagset = type.m_flagset & ~DDS_TOPIC_XTYPES_METADATA,
              .m_nkeys = type.m_nkeys,
              .m_typename = name,
              .m_keys = type.m_keys,
              .m_nops = type.m_nops,
              .m_ops = type.m_ops,
              .m_meta = type.m_meta,
              .type_information = {},
              .type_mapping = {},
              .restrict_data_representation = type.restrict_data_representation} {
    participant_ = dds_create_participant(domain_of(participant), nullptr, nullptr);
    topic_ = dds_create_topic(participant_, &type_, topic, nullptr, nullptr);
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
    dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
    writer_ = dds_create_writer(participant_, topic_, qos, nullptr);
    dds_delete_qos(qos);
  }
  ~ForeignWriter() { (void)dds_delete(participant_); }
  ForeignWriter(const ForeignWriter&) = delete;
  ForeignWriter& operator=(const ForeignWriter&) = delete;

  [[nodiscard]] bool wait_for_reader() const {
    return eventually([this] {
      dds_publication_matched_status_t status{};
      (void)dds_get_publication_matched_status(writer_, &status);
      return status.current_count > 0;
    });
  }
  template <class Message>
  void write(const Message& message) const {
    EXPECT_EQ(dds_write(writer_, &message), DDS_RETCODE_OK);
    dds_write_flush(writer_);
  }

 private:
  static dds_domainid_t domain_of(dds_entity_t participant) {
    dds_domainid_t id = 0;
    (void)dds_get_domainid(participant, &id);
    return id;
  }
  dds_topic_descriptor_t type_;
  dds_entity_t participant_ = 0;
  dds_entity_t topic_ = 0;
  dds_entity_t writer_ = 0;
};

}  // namespace gyrod::testing
