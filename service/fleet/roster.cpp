#include "fleet/roster.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <iterator>

namespace gyrod::fleet {

bool ServingRule::serves(std::string_view sensor) const noexcept {
  return active && holds(own, sensor) &&
         std::ranges::none_of(left, [sensor](const Shard& other) { return holds(other, sensor); });
}

ServingRule both(const ServingRule& a, const ServingRule& b) {
  assert(a.own == b.own);
  ServingRule rule{a.own, a.active && b.active, a.left};
  std::ranges::copy_if(b.left, std::back_inserter(rule.left),
                       [&a](const Shard& shard) { return std::ranges::find(a.left, shard) == a.left.end(); });
  return rule;
}

void Roster::show(const std::string& id, const Announcement& announcement) {
  const auto known = peers_.find(id);
  if (known == peers_.end() && peers_.size() == kMostPeers) return;
  const bool was_left = known != peers_.end() && (awaited(known->second) || yields_to(known->second));
  if (state_ == State::kActive && !was_left && disputed_by(announcement)) ++disputes_;
  peers_.insert_or_assign(id, announcement);
}

bool Roster::greeted() const {
  return std::ranges::all_of(peers_, [this](const auto& peer) {
    return std::ranges::find(peer.second.greets, id_) != peer.second.greets.end();
  });
}

bool Roster::yields_to(const Announcement& peer) const noexcept {
  return peer.active && peer.shard.count > own_.count && overlap(own_, peer.shard);
}

bool Roster::awaited(const Announcement& peer) const {
  return peer.shard.count < own_.count && overlap(own_, peer.shard) &&
         std::ranges::find(peer.yields_to, id_) == peer.yields_to.end();
}

bool Roster::disputed_by(const Announcement& peer) const {
  if (awaited(peer)) return peer.active;
  return yields_to(peer) && std::ranges::find(peer.awaits, id_) == peer.awaits.end();
}

ServingRule Roster::rule() const {
  ServingRule rule{own_, state_ == State::kActive};
  for (const auto& [id, peer] : peers_) {
    if (yields_to(peer) || awaited(peer)) rule.left.push_back(peer.shard);
  }
  return rule;
}

Announcement Roster::announcement() const {
  assert(state_ != State::kListening);
  Announcement told{own_, state_ == State::kActive, {}};
  for (const auto& [id, peer] : peers_) {
    if (yields_to(peer)) told.yields_to.push_back(id);
    if (!peer.active) told.greets.push_back(id);
    if (awaited(peer)) told.awaits.push_back(id);
  }
  return told;
}

Standing Roster::standing() const {
  Standing standing{.active = state_ == State::kActive, .missing = missing(), .disputes = disputes_};
  for (const auto& [id, peer] : peers_) {
    if (!peer.active) continue;
    ++standing.peers;
    if (peer.shard == own_) {
      ++standing.twins;
    } else if (overlap(own_, peer.shard)) {
      ++standing.overlapping;
    }
  }
  return standing;
}

/// A sensor of shard j of n is served by an active daemon with index j and any count up to n; else by the one that had it before there
/// was a shard j, which can be any of the first j - 1.
std::size_t Roster::missing() const {
  constexpr std::uint32_t kNobody = kMaxShards + 1;
  std::array<std::uint32_t, kMaxShards + 1> smallest_count{};
  smallest_count.fill(kNobody);
  std::uint32_t largest = 0;
  const auto count_in = [&](const Shard& shard) {
    std::uint32_t& smallest = smallest_count[shard.index];
    smallest = std::min(smallest, shard.count);
    largest = std::max(largest, shard.count);
  };
  if (state_ == State::kActive) count_in(own_);
  for (const auto& [id, peer] : peers_) {
    if (peer.active) count_in(peer.shard);
  }
  std::array<std::size_t, kMaxShards + 1> missing_of{};
  for (std::uint32_t n = 1; n <= largest; ++n) {
    for (std::uint32_t j = 1; j <= n; ++j) {
      const bool before = j > 1 && missing_of[j - 1] == 0;
      if (smallest_count[j] > n && !before) ++missing_of[n];
    }
  }
  return missing_of[largest];
}

}  // namespace gyrod::fleet
