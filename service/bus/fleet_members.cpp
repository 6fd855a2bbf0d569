#include "bus/fleet_members.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bus/entity.hpp"
#include "bus/loan.hpp"

namespace gyrod::bus {
namespace {

using Endpoint = dds_builtintopic_endpoint_t;
using State = fleet::Roster::State;

dds_duration_t duration_of(double seconds) noexcept {
  return static_cast<dds_duration_t>(seconds * static_cast<double>(DDS_NSECS_IN_SEC));
}

std::string text_of(const dds_guid_t& guid) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : guid.v) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15U];
  }
  return text;
}

std::string guid_of(dds_entity_t entity) {
  dds_guid_t guid{};
  check(dds_get_guid(entity, &guid), "name the writer of denoised samples");
  return text_of(guid);
}

/// Sorted; none at all is the partition without a name.
std::vector<std::string> partitions_of(const dds_qos_t* qos) {
  std::uint32_t count = 0;
  char** names = nullptr;
  std::vector<std::string> partitions;
  if (dds_qget_partition(qos, &count, &names)) {
    for (std::uint32_t k = 0; k < count; ++k) {
      partitions.emplace_back(names[k]);
      dds_free(names[k]);
    }
    dds_free(static_cast<void*>(names));
  }
  if (partitions.empty()) partitions.emplace_back();
  std::ranges::sort(partitions);
  return partitions;
}

std::vector<std::string> partitions_of_writer(dds_entity_t writer) {
  const std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)> qos(dds_create_qos(), dds_delete_qos);
  check(dds_get_qos(writer, qos.get()), "read the QoS of the writer of denoised samples");
  return partitions_of(qos.get());
}

std::optional<fleet::Announcement> announcement_of(const dds_qos_t* qos) {
  void* data = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(qos, &data, &size) || data == nullptr) return std::nullopt;
  const auto told = fleet::parse_announcement({static_cast<const char*>(data), size});
  dds_free(data);
  return told;
}

}  // namespace

class FleetMembers::Impl {
 public:
  Impl(const Domain& domain, const Publisher& publisher, const BusOptions& options, FleetHandler& handler,
       const FleetTimes& times)
      : domain_(domain),
        times_(times),
        writer_(publisher.denoised_writer()),
        topic_(options.topics.denoised),
        partitions_(partitions_of_writer(writer_)),
        handler_(handler),
        roster_(guid_of(writer_), options.shard.value_or(fleet::Shard{}),
                options.shard ? State::kListening : State::kActive),
        id_(guid_of(writer_)),
        rule_{options.shard.value_or(fleet::Shard{})},
        waitset_(dds_create_waitset(domain.participant()), "create a waitset"),
        publications_(
            dds_create_reader(domain.participant(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
            "look for other daemons"),
        news_(dds_create_readcondition(publications_.get(), DDS_ANY_STATE), "look for other daemons"),
        participants_(
            dds_create_reader(domain.participant(), DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr),
            "look for other programs"),
        programs_(dds_create_readcondition(participants_.get(), DDS_ANY_STATE), "look for other programs") {
    check(dds_waitset_attach(waitset_.get(), waitset_.get(), 0), "wait for the stop");
    check(dds_waitset_attach(waitset_.get(), news_.get(), 0), "look for other daemons");
    check(dds_waitset_attach(waitset_.get(), programs_.get(), 0), "look for other programs");
    check(tell(""), "announce a shard on topic '" + topic_ + "'");
  }

  ~Impl() { leave(); }

  void start() {
    enter(roster_.state());
    settle();
    thread_ = std::thread([this] { work(); });
  }

  void leave() noexcept {
    if (!thread_.joinable()) return;
    stopping_.store(true, std::memory_order_relaxed);
    (void)dds_waitset_set_trigger(waitset_.get(), true);
    thread_.join();
    (void)tell("");
  }

  [[nodiscard]] fleet::Standing standing() const noexcept {
    const std::lock_guard lock(standing_mutex_);
    return standing_;
  }

 private:
  void work() noexcept {
    while (!stopping_.load(std::memory_order_relaxed)) {
      (void)dds_waitset_wait_until(waitset_.get(), nullptr, 0, next_look_);
      if (meet() && roster_.state() == State::kListening) quiet_since_ = dds_time();
      hear();
      advance();
      settle();
    }
  }

  void enter(State state) {
    roster_.advance_to(state);
    entered_ = quiet_since_ = dds_time();
    next_look_ = state == State::kActive ? DDS_NEVER : entered_;
  }

  /// From listening to joining, when nobody new has turned up for a while; from there on to serving, when all have heard of it.
  void advance() {
    const State state = roster_.state();
    if (state == State::kActive) return;
    const bool listening = state == State::kListening;
    const dds_time_t latest = entered_ + duration_of(times_.longest_s);
    const dds_time_t earliest =
        listening ? quiet_since_ + duration_of(times_.listening_s) : entered_ + duration_of(times_.joining_s);
    const dds_time_t now = dds_time();
    const bool ready = now >= earliest && (listening || roster_.greeted());
    if (ready || now >= latest) return enter(listening ? State::kJoining : State::kActive);
    next_look_ = now < earliest ? std::min(earliest, latest) : latest;
  }

  /// @return whether another program has appeared; what it writes may take a while to be known, where packets are lost
  bool meet() noexcept {
    bool met = false;
    while (true) {
      const Loan<dds_builtintopic_participant_t> loan(participants_.get());
      if (loan.size() == 0) return met;
      for (std::size_t i = 0; i < loan.size(); ++i)
        met = met || loan.info(i).instance_state == DDS_ALIVE_INSTANCE_STATE;
    }
  }

  /// Writers that appeared, have news, or are gone since the last time.
  void hear() noexcept {
    while (true) {
      const Loan<Endpoint> loan(publications_.get());
      if (loan.size() == 0) return;
      for (std::size_t i = 0; i < loan.size(); ++i) hear_of(loan.message(i), loan.info(i));
    }
  }

  void hear_of(const Endpoint& writer, const dds_sample_info_t& info) {
    if (!info.valid_data || info.instance_state != DDS_ALIVE_INSTANCE_STATE) {
      const auto gone = ids_.find(info.instance_handle);
      if (gone == ids_.end()) return;
      roster_.forget(gone->second);
      ids_.erase(gone);
      return;
    }
    if (writer.topic_name != topic_ || partitions_of(writer.qos) != partitions_) return;
    const std::string id = text_of(writer.key);
    if (id == id_) return;
    if (const auto told = announcement_of(writer.qos)) {
      ids_[info.instance_handle] = id;
      roster_.show(id, *told);
    } else {
      roster_.forget(id);
    }
  }

  /// First gives up what others are to serve, then says so, then takes what is new: whoever is told that something was given up may
  /// rely on it.
  void settle() noexcept {
    const fleet::ServingRule rule = roster_.rule();
    apply(both(rule_, rule));
    if (roster_.state() != State::kListening) {
      const std::string text = text_of(roster_.announcement());
      if (text != told_ && tell(text) == DDS_RETCODE_OK) told_ = text;
    }
    apply(rule);
    show(roster_.standing());
  }

  void apply(const fleet::ServingRule& rule) noexcept {
    if (told_handler_ && rule == rule_) return;
    told_handler_ = true;
    rule_ = rule;
    handler_.on_rule(rule);
  }

  void show(const fleet::Standing& standing) noexcept {
    {
      const std::lock_guard lock(standing_mutex_);
      if (standing == standing_) return;
      standing_ = standing;
    }
    handler_.on_standing(standing);
  }

  [[nodiscard]] dds_return_t tell(const std::string& text) const noexcept {
    // Nothing but what changes: a writer's other policies are fixed.
    const std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)> qos(dds_create_qos(), dds_delete_qos);
    dds_qset_userdata(qos.get(), text.data(), text.size());
    return dds_set_qos(writer_, qos.get());
  }

  Domain domain_;
  FleetTimes times_;
  dds_entity_t writer_;
  std::string topic_;
  std::vector<std::string> partitions_;
  FleetHandler& handler_;
  fleet::Roster roster_;
  std::string id_;
  fleet::ServingRule rule_;  ///< in force
  bool told_handler_ = false;
  std::string told_;
  std::map<dds_instance_handle_t, std::string> ids_;  ///< of those that announce a shard
  dds_time_t entered_ = 0;                            ///< the state that the roster is in
  dds_time_t quiet_since_ = 0;                        ///< nobody new since
  dds_time_t next_look_ = DDS_NEVER;
  Entity waitset_;
  Entity publications_;
  Entity news_;
  Entity participants_;
  Entity programs_;
  mutable std::mutex standing_mutex_;
  fleet::Standing standing_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

FleetMembers::FleetMembers(const Domain& domain, const Publisher& publisher, const BusOptions& options,
                           FleetHandler& handler, const FleetTimes& times)
    : impl_(std::make_unique<Impl>(domain, publisher, options, handler, times)) {}
FleetMembers::~FleetMembers() = default;

void FleetMembers::start() { impl_->start(); }
void FleetMembers::leave() noexcept { impl_->leave(); }
fleet::Standing FleetMembers::standing() const noexcept { return impl_->standing(); }

}  // namespace gyrod::bus
