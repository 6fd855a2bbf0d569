// The rules of many daemons against news that come late.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "fleet/roster.hpp"
#include "sensor_ids.hpp"

namespace gyrod::fleet {
namespace {

using State = Roster::State;

/// A fleet whose news travel late, each at its own time, in order from one daemon to another. Time is in steps of no particular length.
class Fleet {
 public:
  static constexpr int kLatest = 100;         ///< news take 1 to so many steps
  static constexpr int kState = kLatest + 1;  ///< for which a daemon listens, and then joins

  /// @param latest steps that news take at the most; above kLatest, daemons find one another too late to keep what is promised
  explicit Fleet(std::uint64_t seed, int latest = kLatest)
      : random_(seed), latest_(latest), newest_(seed % 2 == 0) {}

  void start(const Shard& shard) {
    const std::string id = std::to_string(next_id_++);
    Daemon& daemon = daemons_[id];
    daemon.roster = std::make_unique<Roster>(id, shard, State::kListening);
    daemon.shard = shard;
    daemon.rule = {shard};
    for (const auto& [other, peer] : daemons_) {
      if (other != id && peer.told) send(other, id);
    }
    at(now_ + kState, [this, id] { advance(id, State::kJoining); });
    at(now_ + 2 * kState, [this, id] { advance(id, State::kActive); });
  }

  void stop(const Shard& shard) {
    const auto found =
        std::ranges::find_if(daemons_, [&shard](const auto& entry) { return entry.second.shard == shard; });
    const std::string id = found->first;
    daemons_.erase(found);
    for (const auto& [other, peer] : daemons_)
      deliver(id, other, [](Roster& roster, const std::string& gone) { roster.forget(gone); });
  }

  [[nodiscard]] bool runs(const Shard& shard) const {
    return std::ranges::any_of(daemons_, [&shard](const auto& entry) { return entry.second.shard == shard; });
  }

  /// Until the next event, and what comes of it. @return false if there is none
  bool step() {
    if (events_.empty()) return false;
    auto event = events_.extract(events_.begin());
    now_ = event.key().first;
    event.mapped()();
    return true;
  }

  [[nodiscard]] int serving(const std::string& sensor) const {
    return static_cast<int>(std::ranges::count_if(
        daemons_, [&sensor](const auto& entry) { return entry.second.rule.serves(sensor); }));
  }
  [[nodiscard]] bool held(const std::string& sensor) const {
    return std::ranges::any_of(daemons_,
                               [&sensor](const auto& entry) { return holds(entry.second.shard, sensor); });
  }
  [[nodiscard]] const Roster* any() const {
    return daemons_.empty() ? nullptr : daemons_.begin()->second.roster.get();
  }
  [[nodiscard]] std::uint64_t disputes() const {
    std::uint64_t all = 0;
    for (const auto& [id, daemon] : daemons_) all += daemon.roster->standing().disputes;
    return all;
  }

 private:
  struct Daemon {
    std::unique_ptr<Roster> roster;
    Shard shard;
    ServingRule rule;                    ///< in force
    std::shared_ptr<Announcement> told;  ///< none yet while it listens
  };

  void at(int time, std::function<void()> event) { events_[{time, next_event_++}] = std::move(event); }

  void advance(const std::string& id, State state) {
    const auto found = daemons_.find(id);
    if (found == daemons_.end()) return;
    Roster& roster = *found->second.roster;
    if (state == State::kActive && !roster.greeted()) {
      at(now_ + kLatest, [this, id, state] { advance(id, state); });
      return;
    }
    roster.advance_to(state);
    settle(id, found->second);
  }

  /// What a daemon does about news: gives up, tells, takes.
  void settle(const std::string& id, Daemon& daemon) {
    const ServingRule rule = daemon.roster->rule();
    daemon.rule = both(daemon.rule, rule);
    if (daemon.roster->state() != State::kListening) {
      const Announcement told = daemon.roster->announcement();
      if (!daemon.told || *daemon.told != told) {
        daemon.told = std::make_shared<Announcement>(told);
        for (const auto& [other, peer] : daemons_) {
          if (other != id) send(id, other);
        }
      }
    }
    daemon.rule = rule;
  }

  /// As told now or, in every other fleet, as told when it arrives: where packets are lost only the newest is repeated.
  void send(const std::string& from, const std::string& to) {
    deliver(from, to, [this, told = daemons_.at(from).told](Roster& roster, const std::string& id) {
      const auto sender = daemons_.find(id);
      roster.show(id, newest_ && sender != daemons_.end() ? *sender->second.told : *told);
    });
  }

  template <class News>
  void deliver(const std::string& from, const std::string& to, News news) {
    int& last = last_delivery_[{from, to}];
    last = std::max(last, now_ + std::uniform_int_distribution<int>(1, latest_)(random_));
    at(last, [this, from, to, news] {
      const auto found = daemons_.find(to);
      if (found == daemons_.end()) return;
      news(*found->second.roster, from);
      settle(to, found->second);
    });
  }

  std::mt19937_64 random_;
  int latest_;
  bool newest_;
  int now_ = 0;
  int next_id_ = 0;
  int next_event_ = 0;
  std::map<std::string, Daemon> daemons_;
  std::map<std::pair<int, int>, std::function<void()>> events_;
  std::map<std::pair<std::string, std::string>, int> last_delivery_;
};

void expect_nobody_serves_what_another_serves(const Fleet& fleet) {
  for (const std::string& sensor : sensors()) ASSERT_LE(fleet.serving(sensor), 1) << sensor;
}

void expect_all_that_is_held_is_served(const Fleet& fleet) {
  std::size_t unserved = 0;
  for (const std::string& sensor : sensors()) {
    ASSERT_EQ(fleet.serving(sensor), fleet.held(sensor) ? 1 : 0) << sensor;
    unserved += fleet.held(sensor) ? 0U : 1U;
  }
  if (fleet.any() != nullptr) {
    ASSERT_EQ(fleet.any()->standing().missing == 0, unserved == 0);
  }
}

/// Daemons of counts 1 to 4 start and stop at any moment, many at once, in any order.
TEST(Roster, AtEveryMomentOneServesASensorAtTheMostAndOneDoesWhenNewsHaveGoneRound) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    const auto below = [&random](std::uint32_t limit) {
      return std::uniform_int_distribution<std::uint32_t>(0, limit - 1)(random);
    };
    Fleet fleet(seed);
    for (int change = 0; change < 30; ++change) {
      const std::uint32_t count = 1 + below(4);
      const Shard shard{1 + below(count), count};
      if (fleet.runs(shard)) {
        fleet.stop(shard);
      } else {
        fleet.start(shard);
      }
      for (std::uint32_t events = below(12); events > 0 && fleet.step(); --events)
        ASSERT_NO_FATAL_FAILURE(expect_nobody_serves_what_another_serves(fleet));
      if (below(5) != 0) continue;
      while (fleet.step()) ASSERT_NO_FATAL_FAILURE(expect_nobody_serves_what_another_serves(fleet));
      ASSERT_NO_FATAL_FAILURE(expect_all_that_is_held_is_served(fleet));
    }
    EXPECT_EQ(fleet.disputes(), 0U);
  }
}

TEST(Roster, WhatIsServedTwiceBecauseNewsCameTooLateIsADispute) {
  int fleets_with_two = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Fleet fleet(seed, 5 * Fleet::kLatest);
    for (const Shard& shard : {Shard{1, 1}, Shard{2, 2}, Shard{1, 2}}) {
      fleet.start(shard);
      for (std::uint64_t events = seed % 7; events > 0 && fleet.step(); --events) {
      }
    }
    bool two = false;
    while (fleet.step())
      two = two || std::ranges::any_of(sensors(), [&fleet](const auto& s) { return fleet.serving(s) > 1; });
    EXPECT_TRUE(!two || fleet.disputes() > 0) << seed;
    fleets_with_two += two ? 1 : 0;
  }
  EXPECT_GT(fleets_with_two, 30) << "else nothing was tested";
}

TEST(Roster, FromTwoToThreeAndBackSeamlesslyByStartingTheNewFirst) {
  Fleet fleet(1);
  const auto start_all = [&fleet](std::uint32_t count) {
    for (std::uint32_t i = 1; i <= count; ++i) fleet.start({i, count});
  };
  const auto all_served = [](const Fleet& served) {
    return std::ranges::count_if(sensors(), [&served](const auto& s) { return served.serving(s) == 1; });
  };
  const auto all = static_cast<std::ptrdiff_t>(sensors().size());
  start_all(2);
  while (fleet.step()) {
  }
  ASSERT_EQ(all_served(fleet), all);
  start_all(3);
  while (fleet.step()) {
  }
  ASSERT_EQ(all_served(fleet), all);
  for (std::uint32_t i = 1; i <= 2; ++i) fleet.stop({i, 2});
  while (fleet.step()) ASSERT_EQ(all_served(fleet), all) << "those of two had nothing to do any more";
  start_all(2);
  while (fleet.step()) ASSERT_EQ(all_served(fleet), all) << "those of three go on";
}

}  // namespace
}  // namespace gyrod::fleet
