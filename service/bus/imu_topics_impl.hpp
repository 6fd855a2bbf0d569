/// Inside of ImuTopics, for the subscriber. Internal to bus/.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <shared_mutex>
#include <string>
#include <string_view>

#include "bus/imu_topic.hpp"
#include "bus/imu_topics.hpp"
#include "bus/promise_watch.hpp"
#include "bus/ticker.hpp"

namespace gyrod::bus {

class ImuTopics::Impl {
 public:
  Impl(Domain domain, BusOptions options);

  [[nodiscard]] const Domain& domain() const noexcept { return domain_; }
  [[nodiscard]] const Ros2Options& options() const noexcept { return options_.ros2; }
  /// The open topic of that name, or none. It stays.
  [[nodiscard]] ImuTopic* find(std::string_view name) const;
  /// Whether the name is one of those to read, by name or pattern, and not that of an output.
  [[nodiscard]] bool is_named(std::string_view name) const noexcept;
  /// Whether it is one of this daemon's shard besides.
  [[nodiscard]] bool is_wanted(std::string_view name) const noexcept {
    return is_named(name) && is_ours(name);
  }

  /// Opens a topic that is not open yet. @throws BusError saying why not
  ImuTopic& open(const std::string& name);
  void count_refused() noexcept { ++refused_; }

  template <class Visit>
  void for_each(const Visit& visit) const {
    const std::shared_lock lock(mutex_);
    for (const auto& [name, topic] : topics_) visit(*topic);
  }
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }
  /// As ImuTopics::stop_holding().
  void stop_holding() noexcept;
  [[nodiscard]] StandbySnapshot standby() const noexcept;

  /// Outlives the topics, whose readers it listens to.
  [[nodiscard]] PromiseWatch& promises() noexcept { return promises_; }
  [[nodiscard]] BrokenPromiseCounter& broken_promise_counter() noexcept { return broken_promises_; }
  [[nodiscard]] BrokenPromises broken_promises() const noexcept { return broken_promises_.counts(); }

 private:
  [[nodiscard]] bool is_ours(std::string_view name) const noexcept;
  void check_new(const std::string& name) const;

  Domain domain_;
  BusOptions options_;
  PromiseWatch promises_;
  BrokenPromiseCounter broken_promises_;
  mutable std::shared_mutex mutex_;
  std::map<std::string, std::unique_ptr<ImuTopic>, std::less<>> topics_;
  std::atomic<std::uint64_t> refused_{0};
  std::optional<Ticker> ticker_;  ///< beside other daemons; ends before the topics go
};

}  // namespace gyrod::bus
