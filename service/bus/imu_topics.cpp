#include "bus/imu_topics.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>

#include "bus/imu_topics_impl.hpp"

namespace gyrod::bus {

ImuTopics::Impl::Impl(Domain domain, BusOptions options)
    : domain_(std::move(domain)), options_(std::move(options)), promises_(domain_) {
  for (const std::string& topic : options_.ros2.topics) {
    if (!ros2::is_pattern(topic) && is_ours(topic)) open(topic);
  }
  if (options_.ownership_strength > 0 && !options_.ros2.topics.empty()) {
    ticker_.emplace(tick_s(options_.takeover_s), [this] { for_each([](ImuTopic& topic) { topic.tend(); }); });
  }
}

void ImuTopics::Impl::stop_holding() noexcept {
  if (!ticker_) return;
  constexpr std::chrono::milliseconds kLook{5};
  const double give_up = steady_now_s() + kTimeToLook_s + options_.takeover_s;
  while (standby().held > 0 && steady_now_s() < give_up) std::this_thread::sleep_for(kLook);
  ticker_.reset();
}

StandbySnapshot ImuTopics::Impl::standby() const noexcept {
  StandbySnapshot standby;
  for_each([&standby](const ImuTopic& topic) { topic.add_to(standby); });
  return standby;
}

ImuTopic* ImuTopics::Impl::find(std::string_view name) const {
  const std::shared_lock lock(mutex_);
  const auto found = topics_.find(name);
  return found == topics_.end() ? nullptr : found->second.get();
}

bool ImuTopics::Impl::is_ours(std::string_view name) const noexcept {
  return !options_.shard || fleet::holds(*options_.shard, name);
}

bool ImuTopics::Impl::is_named(std::string_view name) const noexcept {
  const auto matches = [name](const std::string& topic) { return ros2::matches(topic, name); };
  return std::ranges::any_of(options_.ros2.topics, matches) && ros2::is_topic(name) &&
         !ros2::is_output(name, options_.ros2.outputs);
}

ImuTopic& ImuTopics::Impl::open(const std::string& name) {
  check_new(name);
  auto topic = std::make_unique<ImuTopic>(domain_, name, options_);
  const std::unique_lock lock(mutex_);
  return *topics_.emplace(name, std::move(topic)).first->second;
}

void ImuTopics::Impl::check_new(const std::string& name) const {
  const std::string attempt = "open ROS 2 topic '" + name + "': ";
  if (!fits_wire(name)) {
    throw BusError(attempt + "its name has " + std::to_string(name.size()) +
                   " characters; a sensor's id has at most " + std::to_string(kMaxSensorIdLength));
  }
  const std::string output = ros2::outputs_of(name, options_.ros2.outputs).denoised;
  const std::shared_lock lock(mutex_);
  if (topics_.size() >= options_.ros2.max_topics)
    throw BusError(attempt + std::to_string(topics_.size()) + " are open, no more are allowed");
  const auto same = std::ranges::find_if(
      topics_, [&output](const auto& entry) { return entry.second->outputs().denoised == output; });
  if (same == topics_.end()) return;
  throw BusError(attempt + "its output '" + output + "' is that of '" + same->first + "'");
}

ImuTopics::ImuTopics(const Domain& domain, const BusOptions& options)
    : impl_(std::make_unique<Impl>(domain, options)) {}
ImuTopics::~ImuTopics() = default;

bool ImuTopics::claims(std::string_view sensor) const noexcept { return impl_->is_named(sensor); }

bool ImuTopics::publish(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept {
  ImuTopic* topic = impl_->find(sensor);
  if (topic != nullptr) topic->publish(samples);
  return topic != nullptr;
}

bool ImuTopics::publish_realtime(std::string_view sensor,
                                 std::span<const stream::DenoisedSample> samples) noexcept {
  ImuTopic* topic = impl_->find(sensor);
  if (topic != nullptr) topic->publish_realtime(samples);
  return topic != nullptr;
}

bool ImuTopics::wait_for_acknowledgements(std::chrono::milliseconds timeout) noexcept {
  const dds_time_t deadline = dds_time() + DDS_MSECS(timeout.count());
  bool all = true;
  impl_->for_each([&](const ImuTopic& topic) { all = topic.wait_for_acknowledgements(deadline) && all; });
  return all;
}

bool ImuTopics::publishes(std::string_view sensor) const noexcept {
  const ImuTopic* topic = impl_->find(sensor);
  return topic != nullptr && topic->publishes();
}

void ImuTopics::stop_holding() noexcept { impl_->stop_holding(); }

ImuTopicsSnapshot ImuTopics::snapshot() const {
  ImuTopicsSnapshot snapshot;
  snapshot.refused_topics = impl_->refused();
  snapshot.broken_promises = impl_->broken_promises();
  snapshot.standby = impl_->standby();
  impl_->for_each([&snapshot](const ImuTopic& topic) {
    const ImuCounts counts = topic.counts();
    ++snapshot.topics;
    topic.add_matched_readers(snapshot.matched_readers);
    snapshot.matched_writers += topic.matched_writers();
    snapshot.malformed_messages += counts.malformed;
    snapshot.dropped_messages += counts.dropped;
    snapshot.write_errors += counts.write_errors;
  });
  return snapshot;
}

}  // namespace gyrod::bus
