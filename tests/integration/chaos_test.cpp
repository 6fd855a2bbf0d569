// Daemons are killed, paused and stopped at random moments while sensors of several rates send: a subscriber misses nothing, and gets
// nothing twice but what docs/bus.md ("After a restart") and docs/standby.md say.
//
//   GYROD_CHAOS_SEED=7 GYROD_CHAOS_SECONDS=90 ... chaos_test      other moments, and for longer: tests/benchmark/chaos_study.sh
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "standby_pair.hpp"
#include "stream/method.hpp"
#include "support/arrivals.hpp"
#include "support/eventually.hpp"

namespace gyrod::testing {
namespace {

using Clock = std::chrono::steady_clock;

enum class Blow { kKill, kKillWhileStarting, kPause, kPauseAndKill, kStop };
constexpr std::array<const char*, 5> kBlowNames = {"killed", "killed while starting", "paused",
                                                   "killed while paused", "stopped"};
const char* name_of(Blow blow) { return kBlowNames[static_cast<std::size_t>(blow)]; }

struct Sensor {
  const char* name;
  int rate_hz;
  int batch;
};
constexpr std::array<Sensor, 4> kSensors = {
    {{"slow", 77, 1}, {"single", 200, 1}, {"batch", 500, 5}, {"odd", 333, 7}}};

double variable(const char* name, double otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtod(text, nullptr);
}

/// Shorter than the lease, after which a paused daemon is given up and what its sensors keep comes again (docs/bus.md).
constexpr int kLease_s = 4;
constexpr double kLongestPause_s = 2.0;

/// Sensors, what a subscriber gets of them, and blows.
class Chaos : public StandbyPair, public ::testing::WithParamInterface<const char*> {
 protected:
  Chaos() {
    write_loopback("network.xml", kLease_s);
    options_.method = GetParam();
  }

  void start_sensors(const std::string& keep, std::uint32_t ownership_strength) {
    bus::BusOptions options;
    options.ownership_strength = ownership_strength;
    for (const Sensor& sensor : kSensors) {
      outputs_.push_back(std::make_unique<Arrivals>(bus::Domain(domain_id(), path("network.xml")), options,
                                                    "gyro/denoised", sensor.name));
    }
    for (const auto& output : outputs_)
      ASSERT_TRUE(eventually([&] { return output->writers() == (ownership_strength > 0 ? 2U : 1U); }));
    for (const Sensor& sensor : kSensors) {
      sensors_.push_back(
          start_on_bus({"simulate", "--sensor", sensor.name, "--rate", std::to_string(sensor.rate_hz),
                        "--batch", std::to_string(sensor.batch), "--keep", keep, "--wait", "60"}));
    }
    ASSERT_TRUE(all_go_on());
  }

  /// So many more samples of each sensor have come; under method paper they come in bursts of a hop.
  [[nodiscard]] bool all_go_on(std::size_t samples = 40) const {
    std::vector<std::size_t> before;
    for (const auto& output : outputs_) before.push_back(output->count());
    return eventually([&] {
      for (std::size_t i = 0; i < outputs_.size(); ++i) {
        if (outputs_[i]->count() < before[i] + samples) return false;
      }
      return true;
    });
  }

  /// A random time, which no condition may shorten: the moments are what is tried.
  void let_pass(double least_s, double most_s) {
    std::this_thread::sleep_for(
        std::chrono::duration<double>(std::uniform_real_distribution<double>(least_s, most_s)(random_)));
  }
  template <std::size_t kCount>
  Blow any_of(const std::array<Blow, kCount>& blows) {
    return blows[std::uniform_int_distribution<std::size_t>(0, kCount - 1)(random_)];
  }

  /// @return whether the process is still there afterwards
  bool strike(Process& daemon, Blow blow, double longest_pause_s) {
    ++blows_;
    if (blow == Blow::kPause || blow == Blow::kPauseAndKill) {
      daemon.signal(SIGSTOP);
      let_pass(0.05, longest_pause_s);
    }
    if (blow == Blow::kPause) {
      daemon.signal(SIGCONT);
      return true;
    }
    daemon.signal(blow == Blow::kStop ? SIGTERM : SIGKILL);
    const int exit_code = daemon.wait();
    EXPECT_EQ(exit_code, blow == Blow::kStop ? 0 : 128 + SIGKILL) << daemon.err();
    return false;
  }

  /// Samples of each sensor that came twice since the last time.
  std::vector<std::size_t> news_of_duplicates() {
    std::vector<std::size_t> news;
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      const std::size_t now = outputs_[i]->duplicates();
      news.push_back(now - std::exchange(duplicates_[i], now));
    }
    return news;
  }
  void note(Blow blow, std::size_t duplicates) { worst_[blow] = std::max(worst_[blow], duplicates); }

  void expect_nothing_missing() const {
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      EXPECT_EQ(outputs_[i]->missing(), 0U) << kSensors[i].name << ": " << outputs_[i]->jumps();
      EXPECT_EQ(outputs_[i]->samples().front().sequence, 0U) << kSensors[i].name;
    }
  }
  void print_summary() const {
    std::string text;
    for (const auto& [blow, duplicates] : worst_)
      text += std::string(", ") + name_of(blow) + ": " + std::to_string(duplicates);
    std::printf("chaos, %s: seed %.0f, %d blows; came twice at the most%s\n", GetParam(), kSeed, blows_,
                text.c_str());
  }

  const double kSeed = variable("GYROD_CHAOS_SEED", 1.0);
  const Clock::time_point kEnd =
      Clock::now() + std::chrono::milliseconds(std::llround(1e3 * variable("GYROD_CHAOS_SECONDS", 2.0)));
  std::mt19937_64 random_{static_cast<std::uint64_t>(kSeed)};
  std::vector<std::unique_ptr<Arrivals>> outputs_;
  std::vector<std::unique_ptr<Process>> sensors_;

 private:
  std::array<std::size_t, kSensors.size()> duplicates_{};
  std::map<Blow, std::size_t> worst_;
  int blows_ = 0;
};

class ChaosAlone : public Chaos {
 protected:
  ChaosAlone() {
    options_.patch = R"({"bus": {"network": "network.xml", "input": {"durability": "transient_local"},
                                 "output": {"history_depth": 16384}},
                         "restart": {"published_file": "published"}})";
  }

  /// The next one is killed on its way up, and the one after it serves.
  void start_again(Blow blow) {
    if (blow == Blow::kKillWhileStarting) {
      const auto next = start({"run", "--config", config()});
      let_pass(0.0, 0.4);
      next->signal(SIGKILL);
      next->wait();
    }
    let_pass(0.0, 0.5);
    daemon_ = start_daemon(options_);
  }

  /// A release of the sensor at the most.
  static std::size_t allowed(Blow blow, const Sensor& sensor) {
    if (blow == Blow::kPause || blow == Blow::kStop) return 0;
    constexpr std::size_t kHop = 32;
    return std::max<std::size_t>(
        static_cast<std::size_t>(sensor.batch),
        std::string_view(GetParam()) == "paper" ? kHop : stream::kMaxModelReleaseSamples);
  }

  std::unique_ptr<Process> daemon_;
};

TEST_P(ChaosAlone, NothingIsMissingAfterAnyBlowAndARestartIsSeenAndCountersAddUp) {
  daemon_ = start_daemon(options_);
  ASSERT_NO_FATAL_FAILURE(start_sensors("8000", 0));
  constexpr std::array kBlows = {Blow::kKill, Blow::kKillWhileStarting, Blow::kPause, Blow::kPauseAndKill,
                                 Blow::kStop};
  do {
    let_pass(0.0, 1.5);
    const double epoch = of(*daemon_, "process_start_time_seconds");
    const Blow blow = any_of(kBlows);
    if (!strike(*daemon_, blow, kLongestPause_s)) {
      start_again(blow);
      EXPECT_GT(of(*daemon_, "process_start_time_seconds"), epoch);
    }
    ASSERT_TRUE(all_go_on()) << name_of(blow) << ": " << daemon_->err();
    const auto duplicates = news_of_duplicates();
    for (std::size_t i = 0; i < kSensors.size(); ++i) {
      note(blow, duplicates[i]);
      EXPECT_LE(duplicates[i], allowed(blow, kSensors[i]))
          << name_of(blow) << ": " << kSensors[i].name << ": " << outputs_[i]->jumps();
    }
  } while (Clock::now() < kEnd);

  EXPECT_TRUE(eventually([&] { return is_balanced(*daemon_); }));
  EXPECT_EQ(of(*daemon_, "gyrod_samples_missing_total"), 0.0);
  EXPECT_EQ(stop_daemon(*daemon_), 0) << daemon_->err();
  expect_nothing_missing();
  print_summary();
}

class ChaosPair : public Chaos {
 protected:
  ChaosPair() {
    options_.patch = R"({"bus": {"network": "network.xml", "output": {"history_depth": 16384}}})";
  }

  /// The first publishes all, the second is ready, and neither waits for one that is dead.
  [[nodiscard]] bool on_duty() const {
    return eventually([this] {
      return publishes(*first_, static_cast<double>(kSensors.size())) && publishes(*second_, 0.0) &&
             of(*first_, "gyrod_standby_others") == 1.0 && of(*second_, "gyrod_standby_others") == 1.0;
    });
  }
};

TEST_P(ChaosPair, NothingIsMissingWhicheverOfTheTwoIsStruck) {
  start_two();
  ASSERT_NO_FATAL_FAILURE(start_sensors("0", 1));
  constexpr std::array kBlows = {Blow::kKill, Blow::kPause, Blow::kPauseAndKill, Blow::kStop};
  do {
    ASSERT_TRUE(on_duty()) << first_->err() << second_->err();
    (void)news_of_duplicates();
    let_pass(0.0, 0.5);
    const bool strikes_first = random_() % 3 != 0;
    auto& victim = strikes_first ? first_ : second_;
    const Blow blow = any_of(kBlows);
    if (!strike(*victim, blow, kLongestPause_s)) {
      let_pass(0.0, 1.5);
      victim = start_one(strikes_first ? kFirst : kSecond);
    }
    ASSERT_TRUE(on_duty() && all_go_on()) << name_of(blow) << ": " << first_->err() << second_->err();
    for (const std::size_t duplicates : news_of_duplicates()) note(blow, duplicates);
  } while (Clock::now() < kEnd);

  for (const auto* daemon : {&first_, &second_}) {
    EXPECT_TRUE(eventually([&] { return is_balanced(**daemon); }));
    EXPECT_EQ(stop_daemon(**daemon), 0) << (*daemon)->err();
  }
  expect_nothing_missing();
  print_summary();
}

INSTANTIATE_TEST_SUITE_P(Method, ChaosAlone, ::testing::Values("joint", "paper"),
                         [](const auto& method) { return std::string(method.param); });
INSTANTIATE_TEST_SUITE_P(Method, ChaosPair, ::testing::Values("joint", "paper"),
                         [](const auto& method) { return std::string(method.param); });

}  // namespace
}  // namespace gyrod::testing
