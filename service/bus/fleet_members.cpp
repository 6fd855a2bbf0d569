#include "bus/fleet_members.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bus/entity.hpp"
#include "bus/fleet_hand_overs.hpp"
#include "bus/loan.hpp"
#include "bus/log.hpp"
#include "bus/writer_identity.hpp"

namespace gyrod::bus {
namespace {

using Endpoint = dds_builtintopic_endpoint_t;
using State = fleet::Roster::State;

dds_duration_t duration_of(double seconds) noexcept {
  return static_cast<dds_duration_t>(seconds * static_cast<double>(DDS_NSECS_IN_SEC));
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
        partitions_(place_of(writer_)),
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
    open_hand_overs(options);
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
    const std::vector<GivenUp> given = handler_.on_leave();
    // The message is confirmed before this process ends; discovery's own news may be lost on their way.
    if (hand_overs_ && !hand_overs_->tell(given, true)) hand_overs_.reset();
    (void)tell(hand_overs_ ? fleet::text_of_leaving(hand_overs_->told()) : "");
  }

  void wait_for_acknowledgements(std::chrono::milliseconds timeout) const noexcept {
    if (hand_overs_) hand_overs_->wait_for_acknowledgements(timeout);
  }

  [[nodiscard]] fleet::Standing standing() const noexcept {
    const std::lock_guard lock(standing_mutex_);
    return standing_;
  }

 private:
  void work() noexcept {
    while (!stopping_.load(std::memory_order_relaxed)) {
      (void)dds_waitset_wait_until(waitset_.get(), nullptr, 0, next_wake());
      if (meet() && roster_.state() == State::kListening) quiet_since_ = dds_time();
      hear();
      hear_hand_overs();
      advance();
      settle();
    }
  }

  void open_hand_overs(const BusOptions& options) {
    try {
      hand_overs_.emplace(domain_, for_topic(options, topic_), id_, duration_of(times_.hand_over_s));
    } catch (const SecurityError& error) {
      return log(
          LogLevel::kWarning,
          std::string(error.what()) + ". Samples may be missing where sensors change hands between daemons");
    }
    check(dds_waitset_attach(waitset_.get(), hand_overs_->data_condition(), 0), "hear of hand-overs");
  }

  void hear_hand_overs() {
    if (!hand_overs_) return;
    hand_overs_->take([this](const std::string& id, std::span<const GivenUp> given, bool leaves) {
      // What daemons told before this one began to listen is of the past.
      if (roster_.state() != State::kListening) handler_.on_given_up(given);
      if (!leaves) return;
      if (left_.size() == fleet::kMostPeers) left_.clear();
      left_.insert(id);
      roster_.forget(id);
    });
  }

  [[nodiscard]] dds_time_t next_wake() const noexcept {
    return hand_overs_ ? std::min(next_look_, hand_overs_->waits_until()) : next_look_;
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
    const std::string text = info.valid_data ? user_data_of(writer.qos) : "";
    const auto told = fleet::parse_announcement(text);
    if (!info.valid_data || info.instance_state != DDS_ALIVE_INSTANCE_STATE) {
      if (!told)
        let_go(info.instance_handle, fleet::parse_handed(text));  // its last words may come with its end
      return let_go(info.instance_handle, std::nullopt);
    }
    if (writer.topic_name != topic_ || place_of(writer.qos) != partitions_) return;
    const std::string id = text_of(writer.key);
    if (id == id_ || left_.contains(id)) return;
    if (!told) return let_go(info.instance_handle, fleet::parse_handed(text));
    // By the same news it has given up sensors, perhaps.
    if (hand_overs_ && told->handed) hand_overs_->expect(id, *told->handed);
    untold_ = untold_ || !told->handed;
    ids_[info.instance_handle] = id;
    roster_.show(id, *told);
  }

  /// A daemon serves no more. @param handed the hand-overs it has told, where it has left in order
  void let_go(dds_instance_handle_t writer, std::optional<std::uint64_t> handed) {
    const auto known = ids_.find(writer);
    if (known == ids_.end()) return;
    const bool has_told = left_.erase(known->second) > 0;
    if (hand_overs_ && handed && !has_told) {
      hand_overs_->expect(known->second, *handed);
    } else if (hand_overs_) {
      hand_overs_->forget(known->second);
    }
    if (!handed && !has_told) untold_ = true;
    roster_.forget(known->second);
    ids_.erase(known);
  }

  /// First gives up what others are to serve, then says so, then takes what is new: whoever is told that something was given up may
  /// rely on it. What is new is taken when all have told how far they were.
  void settle() noexcept {
    const fleet::ServingRule rule = roster_.rule();
    hand_over(apply(both(rule_, rule), true));
    if (roster_.state() != State::kListening) {
      fleet::Announcement announcement = roster_.announcement();
      if (hand_overs_) announcement.handed = hand_overs_->told();
      const std::string text = text_of(announcement);
      if (text != told_ && tell(text) == DDS_RETCODE_OK) told_ = text;
    }
    if (!hand_overs_ || !hand_overs_->must_wait(dds_time())) {
      // Who served before this one began to may be anybody.
      apply(rule, hand_overs_ && hand_overs_->all_have_told() && !untold_ && rule_.active);
      untold_ = false;
    }
    show(roster_.standing());
  }

  /// Who cannot tell how far it was says so by not announcing hand-overs any more.
  void hand_over(const std::vector<GivenUp>& given) noexcept {
    if (hand_overs_ && !given.empty() && !hand_overs_->tell(given, false)) hand_overs_.reset();
  }

  std::vector<GivenUp> apply(const fleet::ServingRule& rule, bool told) noexcept {
    if (told_handler_ && rule == rule_) return {};
    told_handler_ = true;
    rule_ = rule;
    return handler_.on_rule(rule, told);
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
  std::set<std::string> left_;                        ///< have told that they stop, and may still be seen
  bool untold_ = false;         ///< somebody has stopped to serve, perhaps, and will not tell how far it was
  dds_time_t entered_ = 0;      ///< the state that the roster is in
  dds_time_t quiet_since_ = 0;  ///< nobody new since
  dds_time_t next_look_ = DDS_NEVER;
  Entity waitset_;
  Entity publications_;
  Entity news_;
  Entity participants_;
  Entity programs_;
  std::optional<FleetHandOvers> hand_overs_;  ///< none: our permissions forbid it
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
void FleetMembers::wait_for_acknowledgements(std::chrono::milliseconds timeout) const noexcept {
  impl_->wait_for_acknowledgements(timeout);
}
fleet::Standing FleetMembers::standing() const noexcept { return impl_->standing(); }

}  // namespace gyrod::bus
