#include "bus/peer_watch.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <map>

#include "bus/entity.hpp"
#include "bus/loan.hpp"
#include "bus/repeat_filter.hpp"

namespace gyrod::bus {
namespace {

using Participant = dds_builtintopic_participant_t;
using Endpoint = dds_builtintopic_endpoint_t;
using Key = std::array<std::uint8_t, 16>;

Key key_of(const dds_guid_t& guid) {
  Key key{};
  std::ranges::copy(guid.v, key.begin());
  return key;
}

bool has_identity(const Key& key) { return (key.front() & 0x80U) != 0; }

/// A property of a participant, as far as it tells: printable and not endless.
std::string property(const Participant& participant, const char* name) {
  constexpr std::size_t kLongest = 100;
  char* value = nullptr;
  if (!dds_qget_prop(participant.qos, name, &value) || value == nullptr) return "?";
  std::string text(value);
  dds_free(value);
  text.resize(std::min(text.size(), kLongest));
  std::ranges::replace_if(
      text, [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

Entity builtin_reader(const Domain& domain, dds_entity_t topic) {
  return {dds_create_reader(domain.participant(), topic, nullptr, nullptr),
          "watch the domain's participants"};
}

}  // namespace

class PeerWatch::Impl {
 public:
  explicit Impl(const Domain& domain)
      : domain_(domain),
        participants_(builtin_reader(domain, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT)),
        writers_(builtin_reader(domain, DDS_BUILTIN_TOPIC_DCPSPUBLICATION)),
        readers_(builtin_reader(domain, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION)) {
    dds_guid_t own{};
    check(dds_get_guid(domain.participant(), &own), "ask for the participant's id");
    own_ = key_of(own);
  }

  std::vector<std::string> look(Clock::time_point now) {
    std::vector<std::string> lines;
    meet(now, lines);
    for (const Entity* endpoints : {&writers_, &readers_}) welcome(endpoints->get());
    for (auto& [key, peer] : peers_) {
      if (peer.settled || now - peer.since < kPatience) continue;
      peer.settled = true;
      tell(lines,
           "a peer at " + peer.address + " has shown no topic for " + std::to_string(kPatience.count()) +
               " s: one of the two sides refuses the other's certificate, permissions or governance, "
               "or it has no topic; "
               "its own log may say why",
           now);
    }
    return lines;
  }

  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }

 private:
  struct Peer {
    Clock::time_point since;
    std::string address;
    bool settled = false;  ///< let in, or told
  };

  void meet(Clock::time_point now, std::vector<std::string>& lines) {
    while (true) {
      const Loan<Participant> loan(participants_.get());
      if (loan.size() == 0) return;
      for (std::size_t i = 0; i < loan.size(); ++i) {
        const Key key = key_of(loan.message(i).key);
        if (loan.info(i).instance_state != DDS_ALIVE_INSTANCE_STATE) {
          peers_.erase(key);
        } else if (loan.info(i).valid_data && key != own_ && !peers_.contains(key) &&
                   peers_.size() < kMostPeers) {
          meet(key, loan.message(i), now, lines);
        }
      }
    }
  }

  void meet(const Key& key, const Participant& participant, Clock::time_point now,
            std::vector<std::string>& lines) {
    Peer& peer = peers_[key];
    peer = {now, property(participant, "__NetworkAddresses"), !has_identity(key)};
    if (has_identity(key)) return;
    tell(lines,
         "a peer without DDS Security is kept out: process '" + property(participant, "__ProcessName") +
             "', pid " + property(participant, "__Pid") + ", host '" + property(participant, "__Hostname") +
             "', at " + peer.address,
         now);
  }

  /// Whoever has told us of a topic is let in.
  void welcome(dds_entity_t endpoints) {
    while (true) {
      const Loan<Endpoint> loan(endpoints);
      if (loan.size() == 0) return;
      for (std::size_t i = 0; i < loan.size(); ++i) {
        if (!loan.info(i).valid_data) continue;
        const auto found = peers_.find(key_of(loan.message(i).participant_key));
        if (found != peers_.end()) found->second.settled = true;
      }
    }
  }

  void tell(std::vector<std::string>& lines, const std::string& line, Clock::time_point now) {
    if (auto passed = filter_.pass(line, now)) lines.push_back(std::move(*passed));
    refused_.fetch_add(1, std::memory_order_relaxed);
  }

  Domain domain_;
  Entity participants_;
  Entity writers_;
  Entity readers_;
  Key own_{};
  std::map<Key, Peer> peers_;
  RepeatFilter filter_;  // who makes up participants must not fill the log
  std::atomic<std::uint64_t> refused_{0};
};

PeerWatch::PeerWatch(const Domain& domain) : impl_(std::make_unique<Impl>(domain)) {}
PeerWatch::~PeerWatch() = default;

std::vector<std::string> PeerWatch::look(Clock::time_point now) { return impl_->look(now); }
std::uint64_t PeerWatch::refused() const noexcept { return impl_->refused(); }

}  // namespace gyrod::bus
