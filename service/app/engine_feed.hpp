/// From the bus into the engine.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "app/understudy.hpp"
#include "bus/given_up.hpp"
#include "bus/imu_subscriber.hpp"
#include "bus/imu_topics.hpp"
#include "bus/subscriber.hpp"
#include "fleet/roster.hpp"
#include "fleet/succession.hpp"
#include "live/tap.hpp"
#include "stream/engine.hpp"

namespace gyrod::app {

/// The engine takes samples from one thread at a time; gyrod's own topics and those of ROS 2 have a thread each.
class EngineInlet {
 public:
  EngineInlet(stream::Engine& engine, live::Tap& tap) : engine_(engine), tap_(tap) {}
  /// As Engine::push(), of sensors that are served here; what comes of others that may come here is kept for a while.
  /// @return what becomes of the last sample
  bus::Fate push(std::string_view sensor, std::span<const stream::Sample> samples) noexcept;
  void end(std::string_view sensor) noexcept;
  /// As Engine::come_again().
  void come_again(std::string_view sensor) noexcept;
  /// As Engine::fall_silent().
  void fall_silent(std::string_view sensor, stream::ChannelState why) noexcept;
  /// As Engine::tend(), unless somebody pushes at the moment: then at the next call.
  void tend() noexcept;

  /// Takes samples of these sensors only from now on; the rest is passed over and counted. What was taken of others before is released,
  /// and their sensors end.
  /// @param told whether heed() was told up to where the sensors that are new here were served: then they go on behind that. Else what may
  ///   have been served is left out by time.
  /// @return what is served no more, and up to where it was
  std::vector<bus::GivenUp> serve(const fleet::ServingRule& rule, bool told) noexcept;
  /// What is served, and up to where it is.
  [[nodiscard]] std::vector<bus::GivenUp> served() noexcept;
  /// Others have served these sensors until now.
  void heed(std::span<const bus::GivenUp> given) noexcept;
  /// Samples passed over, since others serve their sensors.
  [[nodiscard]] std::uint64_t foreign() const noexcept { return foreign_.load(std::memory_order_relaxed); }

 private:
  [[nodiscard]] std::vector<bus::GivenUp> given_up_by(const fleet::ServingRule& rule) const;
  bus::Fate take(std::string_view sensor, std::span<const stream::Sample> samples) noexcept;
  [[nodiscard]] std::size_t served_before(std::string_view sensor, std::span<const stream::Sample> samples,
                                          std::int64_t now) noexcept;

  /// Taken before all others, and held while push() waits for workers: then both threads wait.
  std::mutex mutex_;
  stream::Engine& engine_;
  live::Tap& tap_;
  fleet::ServingRule rule_{.own = {}, .active = true};
  fleet::Succession succession_;
  Understudy understudy_;
  std::atomic<std::uint64_t> foreign_{0};
};

/// What comes from gyrod's own topics.
class FeedFromBus final : public bus::SampleHandler {
 public:
  /// @param discovery where a sensor that comes back has more to tell than what is new: how long readers are given that were lost with it
  FeedFromBus(EngineInlet& inlet, const bus::ImuTopics& imu_topics, std::chrono::milliseconds discovery)
      : inlet_(inlet), imu_topics_(imu_topics), discovery_(discovery) {}
  /// An id that is the name of a ROS 2 topic is taken: such samples are refused and counted as of no id.
  void on_samples(std::string_view sensor, std::span<const stream::Sample> samples) noexcept override;
  void on_end(std::string_view sensor) noexcept override;
  void on_return(std::string_view sensor) noexcept override;
  void on_broken_promise(std::string_view sensor, stream::ChannelState why) noexcept override;

 private:
  EngineInlet& inlet_;
  const bus::ImuTopics& imu_topics_;
  std::chrono::milliseconds discovery_;
  std::optional<std::chrono::steady_clock::time_point> waited_;  ///< last
};

/// What comes from ROS 2. Logs the topics that were opened and refused.
class FeedFromRos2 final : public bus::ImuHandler {
 public:
  explicit FeedFromRos2(EngineInlet& inlet) : inlet_(inlet) {}
  [[nodiscard]] bus::Fate on_sample(std::string_view sensor, const stream::Sample& sample) noexcept override;
  void on_end(std::string_view sensor) noexcept override;
  void on_broken_promise(std::string_view sensor, stream::ChannelState why) noexcept override;
  void on_topic(std::string_view topic, const ros2::Outputs& outputs) noexcept override;
  void on_refused_topic(std::string_view reason) noexcept override;

 private:
  EngineInlet& inlet_;
};

}  // namespace gyrod::app
