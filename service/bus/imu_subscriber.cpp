#include "bus/imu_subscriber.hpp"

#include <atomic>
#include <cstddef>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "bus/imu_topics_impl.hpp"
#include "bus/log.hpp"
#include "bus/lost_writers.hpp"
#include "bus/sensor_states.hpp"

namespace gyrod::bus {
namespace {

constexpr std::size_t kImuReaders = InputReader<Imu>::kSides;
static_assert(kImuReaders <= SensorStates::kMaxSources);

}  // namespace

class ImuSubscriber::Impl {
 public:
  Impl(ImuTopics::Impl& topics, ImuHandler& handler)
      : topics_(topics),
        handler_(handler),
        book_(topics.domain(), {TopicType<Imu>::kDescriptor->m_typename}),
        waitset_(dds_create_waitset(topics.domain().participant()), "create a waitset") {
    attach(waitset_.get(), "wait for the stop");
    attach(book_.condition(), "look for ROS 2 publishers");
    attach(topics_.promises().condition(), "wait for broken promises");
    topics_.for_each([this](ImuTopic& topic) { read(topic); });
  }

  ~Impl() { stop(); }

  void start() {
    thread_ = std::thread([this] { work(); });
  }

  void stop() noexcept {
    if (!thread_.joinable()) return;
    stopping_.store(true, std::memory_order_relaxed);
    (void)dds_waitset_set_trigger(waitset_.get(), true);
    thread_.join();
    take_rest();
  }

 private:
  void attach(dds_entity_t condition, const std::string& attempt) const {
    check(dds_waitset_attach(waitset_.get(), condition, 0), attempt);
  }

  void read(ImuTopic& topic) {
    topic.reader().attend({waitset_.get(), &topics_.promises()}, topics_.options().input,
                          sources_.size() * kImuReaders);
    sources_.push_back(&topic);
  }

  void work() noexcept {
    while (!stopping_.load(std::memory_order_relaxed)) {
      (void)dds_waitset_wait(waitset_.get(), nullptr, 0, DDS_INFINITY);
      look_for_topics();
      heed_broken_promises();
      for (ImuTopic* topic : sources_) take(*topic);
    }
  }

  /// Opens the topics of those publishers that have appeared.
  void look_for_topics() noexcept {
    for (const WriterBook::Writer& writer : book_.take_news()) {
      meet(writer.topic);
      if (ImuTopic* topic = topics_.find(writer.topic)) serve(*topic, writer);
    }
  }

  /// Where DDS refuses a reader for best-effort publishers, the first one stays the only one.
  static void serve(ImuTopic& topic, const WriterBook::Writer& writer) {
    try {
      topic.reader().serve(writer);
    } catch (const BusError& error) {
      log(LogLevel::kWarning, error.what());
    }
  }

  void meet(const std::string& topic) {
    if (!topics_.is_wanted(topic) || topics_.find(topic) != nullptr || refused_.contains(topic)) return;
    try {
      ImuTopic& opened = topics_.open(topic);
      read(opened);
      handler_.on_topic(opened.name(), opened.outputs());
    } catch (const BusError& error) {
      refuse(topic, error.what());
    }
  }

  /// Told once a topic; a flood of names must fill neither memory nor log.
  void refuse(const std::string& topic, std::string_view reason) {
    constexpr std::size_t kMostRemembered = 1024;
    topics_.count_refused();
    if (refused_.size() == kMostRemembered) return;
    refused_.insert(topic);
    handler_.on_refused_topic(reason);
  }

  void heed_broken_promises() noexcept {
    for (const PromiseWatch::Event& event : topics_.promises().take()) {
      if (event.kind == PromiseWatch::Event::Kind::kDeadlineMissed) {
        heed_deadline(sources_[event.source / kImuReaders]->name(), event.source % kImuReaders);
      } else if (event.kind == PromiseWatch::Event::Kind::kLivelinessLost) {
        const std::vector<std::string> sensors = lost_writers_.lose(event.handle);
        topics_.broken_promise_counter().set_losses(lost_writers_.losses());
        for (const std::string& sensor : sensors)
          handler_.on_broken_promise(sensor, stream::ChannelState::kLivelinessLost);
      } else {
        lost_writers_.forget(event.handle);
      }
    }
  }

  void heed_deadline(const std::string& topic, std::size_t side) noexcept {
    if (!states_.sends_by(topic, side)) return;
    topics_.broken_promise_counter().count_deadline();
    handler_.on_broken_promise(topic, stream::ChannelState::kDeadlineMissed);
  }

  /// Takes once from a topic. The state that comes with a message is that of the moment: what else the cache holds comes before an
  /// end, and a new publisher undoes it.
  std::size_t take(ImuTopic& topic) noexcept {
    const auto receive_one = [&](std::size_t side, const Imu& message, const dds_sample_info_t& info) {
      if (info.valid_data) receive(topic, message);
      if (info.valid_data || states_.knows(topic.name()))
        states_.show(topic.name(), side, info.instance_state == DDS_ALIVE_INSTANCE_STATE,
                     info.publication_handle);
    };
    const std::size_t taken = topic.reader().take(book_, receive_one);
    for (const SensorStates::Ending& ending : states_.take_ending()) {
      while (topic.reader().take(book_, receive_one) > 0) {
      }
      if (states_.forget_if_ended(topic.name())) end(ending);
    }
    return taken;
  }

  void end(const SensorStates::Ending& ending) noexcept {
    handler_.on_end(ending.sensor);
    if (lost_writers_.end(ending.sensor, ending.writer))
      handler_.on_broken_promise(ending.sensor, stream::ChannelState::kLivelinessLost);
  }

  void receive(ImuTopic& topic, const Imu& message) noexcept {
    if (!topic.hold(message)) return;
    const stream::Sample sample = sample_of(message);
    const Fate fate = handler_.on_sample(topic.name(), sample);
    if (fate == Fate::kDoesNot) topic.give_up(sample.stamp_ns);
    if (fate == Fate::kMayLeave) topic.let_stay(sample.stamp_ns);
  }

  /// A publisher may never pause: no more than a cache of each topic.
  void take_rest() noexcept {
    for (ImuTopic* topic : sources_) {
      for (std::size_t taken = 0; taken < topics_.options().depth;) {
        const std::size_t more = take(*topic);
        if (more == 0) break;
        taken += more;
      }
    }
  }

  ImuTopics::Impl& topics_;
  ImuHandler& handler_;
  WriterBook book_;
  Entity waitset_;
  std::vector<ImuTopic*> sources_;
  SensorStates states_;  ///< of the topics, by reader
  LostWriters lost_writers_;
  std::set<std::string> refused_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

ImuSubscriber::ImuSubscriber(ImuTopics& topics, ImuHandler& handler) {
  if (!topics.impl_->options().topics.empty()) impl_ = std::make_unique<Impl>(*topics.impl_, handler);
}
ImuSubscriber::~ImuSubscriber() = default;

void ImuSubscriber::start() {
  if (impl_) impl_->start();
}
void ImuSubscriber::stop() noexcept {
  if (impl_) impl_->stop();
}

}  // namespace gyrod::bus
