/// Who serves what, as one daemon of a fleet sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "fleet/announcement.hpp"
#include "fleet/shard.hpp"

namespace gyrod::fleet {

/// Which sensors a daemon serves at one moment: those of its own shard, less what it leaves to others.
struct ServingRule {
  Shard own;
  bool active = false;           ///< false: none
  std::vector<Shard> left = {};  ///< what others serve, or have not given up yet

  [[nodiscard]] bool serves(std::string_view sensor) const noexcept;
  friend bool operator==(const ServingRule&, const ServingRule&) = default;
};

/// What both rules serve. @pre a.own == b.own
[[nodiscard]] ServingRule both(const ServingRule& a, const ServingRule& b);

/// The fleet in numbers, for logs and metrics. Daemons that are still joining are not in it, nor is this one unless said.
struct Standing {
  bool active = false;    ///< this daemon has joined
  std::size_t peers = 0;  ///< other daemons that write to the same topic
  std::size_t twins =
      0;  ///< those with this very shard: what both serve comes twice, unless readers choose by ownership
  std::size_t overlapping =
      0;  ///< those of another count whose shard overlaps this one: normal while the count changes
  std::size_t missing =
      0;  ///< shards, of the largest count there is, of which nobody serves every sensor; this daemon counts
  std::uint64_t disputes =
      0;  ///< times a daemon turned up that may have served sensors that this one served as well

  friend bool operator==(const Standing&, const Standing&) = default;
};

/// The rules of a fleet, for daemons that are started, stopped and reconfigured one by one. Each serves exactly what its rule() says,
/// tells all others its announcement(), and is shown theirs, late by less than the time for which it stays in each state before kActive.
///
/// Of several active daemons that hold a sensor the one with the largest count serves it, once every other that holds it says that it
/// has stopped. So at no moment two serve a sensor (but for twins), and as soon as news are round one does.
///
/// Why never two, A with the smaller count and B with the larger: A was announced, joining, for longer than news take before it served,
/// so B knew of A, and served only after A had told that it yields to B. A takes that back only when it has lost sight of B, and says
/// so before it serves again. Only daemons that lose sight of one another while both run, or find one another late (a broken network),
/// can serve the same sensor. When they meet, at least one of them counts that as a dispute: B, if A is shown that has not yielded to it,
/// or A, if B is shown that does not await it. News may overtake one another up to the newest, so B may never see A as it was.
///
/// One thread.
class Roster {
 public:
  enum class State {
    kListening,  ///< learns who is there; is announced to nobody
    kJoining,    ///< announced; those that serve go on
    kActive,     ///< serves; those with a smaller count yield
  };

  /// @param id of this daemon among all
  Roster(std::string id, const Shard& own, State state) : id_(std::move(id)), own_(own), state_(state) {}

  void advance_to(State state) noexcept { state_ = state; }
  [[nodiscard]] State state() const noexcept { return state_; }

  /// A daemon is there, or has news. More than kMostPeers are not taken notice of.
  void show(const std::string& id, const Announcement& announcement);
  /// It is gone, or does no longer announce a shard.
  void forget(const std::string& id) { peers_.erase(id); }

  /// Whether every daemon that this one knows has said that it has heard this one join: then none of them takes a sensor unawares. News
  /// may be late, where packets are lost; who is not greeted yet waits.
  [[nodiscard]] bool greeted() const;

  [[nodiscard]] ServingRule rule() const;
  /// To be told only when rule() is in force. @pre state() != kListening
  [[nodiscard]] Announcement announcement() const;
  [[nodiscard]] Standing standing() const;

 private:
  [[nodiscard]] bool yields_to(const Announcement& peer) const noexcept;
  /// A peer that has to give up, before this one may serve, what both hold.
  [[nodiscard]] bool awaited(const Announcement& peer) const;
  /// A peer that, as it tells, may serve what this one serves as long as it leaves it nothing.
  [[nodiscard]] bool disputed_by(const Announcement& peer) const;
  [[nodiscard]] std::size_t missing() const;

  std::string id_;
  Shard own_;
  State state_;
  std::map<std::string, Announcement> peers_;
  std::uint64_t disputes_ = 0;
};

}  // namespace gyrod::fleet
