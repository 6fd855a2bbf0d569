#include "bus/topic_discovery.hpp"

#include "bus/entity.hpp"
#include "bus/loan.hpp"
#include "bus/qos_match.hpp"

namespace gyrod::bus {
namespace {

using Endpoint = dds_builtintopic_endpoint_t;

bool is_exclusive(const Endpoint& writer) {
  dds_ownership_kind_t kind = DDS_OWNERSHIP_SHARED;
  (void)dds_qget_ownership(writer.qos, &kind);
  return kind == DDS_OWNERSHIP_EXCLUSIVE;
}

/// Looks through the writers that were discovered since the last call.
std::optional<TopicFound> look(dds_entity_t publications, const std::string& topic) {
  std::optional<TopicFound> found;
  while (!found) {
    const Loan<Endpoint> loan(publications);
    if (loan.size() == 0) return std::nullopt;
    for (std::size_t i = 0; i < loan.size() && !found; ++i) {
      if (!loan.info(i).valid_data || loan.message(i).topic_name != topic) continue;
      found = TopicFound{loan.message(i).type_name, partitions_of(loan.message(i).qos),
                         is_exclusive(loan.message(i))};
    }
  }
  return found;
}

}  // namespace

std::optional<TopicFound> find_topic(const Domain& domain, const std::string& topic,
                                     std::chrono::milliseconds timeout) {
  const std::string attempt = "look for writers of topic '" + topic + "'";
  const Entity publications(
      dds_create_reader(domain.participant(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr), attempt);
  const Entity news(dds_create_readcondition(publications.get(), DDS_ANY_STATE), attempt);
  const Entity waitset(dds_create_waitset(domain.participant()), attempt);
  check(dds_waitset_attach(waitset.get(), news.get(), 0), attempt);

  const dds_time_t deadline = dds_time() + DDS_MSECS(timeout.count());
  while (true) {
    if (auto found = look(publications.get(), topic)) return found;
    if (dds_waitset_wait_until(waitset.get(), nullptr, 0, deadline) <= 0) return std::nullopt;
  }
}

}  // namespace gyrod::bus
