#include "bus/promise_watch.hpp"

#include <utility>

namespace gyrod::bus {
namespace {

/// Events that wait to be taken.
constexpr std::size_t kMostEvents = 65536;

}  // namespace

PromiseWatch::PromiseWatch(const Domain& domain)
    : guard_(dds_create_guardcondition(domain.participant()), "create a guard condition") {}

void PromiseWatch::watch(dds_entity_t reader, const QosProfile& asked, std::size_t source) {
  const bool deadline = asked.deadline_s > 0.0;
  const bool liveliness = asked.lease_s > 0.0;
  if (!deadline && !liveliness) return;
  ears_.push_back(std::make_unique<Ear>(Ear{this, source}));
  const std::unique_ptr<dds_listener_t, void (*)(dds_listener_t*)> listener(
      dds_create_listener(ears_.back().get()), dds_delete_listener);
  if (deadline) dds_lset_requested_deadline_missed(listener.get(), on_deadline_missed);
  if (liveliness) dds_lset_liveliness_changed(listener.get(), on_liveliness_changed);
  check(dds_set_listener(reader, listener.get()), "listen to deadlines and liveliness");
}

std::vector<PromiseWatch::Event> PromiseWatch::take() {
  const std::lock_guard lock(mutex_);
  if (events_.empty()) return {};
  (void)dds_set_guardcondition(guard_.get(), false);
  return std::exchange(events_, {});
}

void PromiseWatch::on_deadline_missed(dds_entity_t, dds_requested_deadline_missed_status_t status,
                                      void* ear) {
  const Ear& self = *static_cast<const Ear*>(ear);
  self.watch->add({Event::Kind::kDeadlineMissed, self.source, status.last_instance_handle});
}

void PromiseWatch::on_liveliness_changed(dds_entity_t, dds_liveliness_changed_status_t status, void* ear) {
  const Ear& self = *static_cast<const Ear*>(ear);
  if (status.not_alive_count_change == 0) return;
  const auto kind =
      status.not_alive_count_change > 0 ? Event::Kind::kLivelinessLost : Event::Kind::kWriterBack;
  self.watch->add({kind, self.source, status.last_publication_handle});
}

void PromiseWatch::add(const Event& event) {
  const std::lock_guard lock(mutex_);
  if (events_.size() == kMostEvents) return;
  events_.push_back(event);
  (void)dds_set_guardcondition(guard_.get(), true);
}

}  // namespace gyrod::bus
