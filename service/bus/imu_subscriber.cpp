#include "bus/imu_subscriber.hpp"

#include <atomic>
#include <cstddef>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "bus/imu_topics_impl.hpp"

namespace gyrod::bus {
namespace {

using Endpoint = dds_builtintopic_endpoint_t;

const char* const kImuType = TopicType<Imu>::kDescriptor->m_typename;

}  // namespace

class ImuSubscriber::Impl {
 public:
  Impl(ImuTopics::Impl& topics, ImuHandler& handler)
      : topics_(topics),
        handler_(handler),
        waitset_(dds_create_waitset(topics.domain().participant()), "create a waitset"),
        publications_(dds_create_reader(topics.domain().participant(), DDS_BUILTIN_TOPIC_DCPSPUBLICATION,
                                        nullptr, nullptr),
                      "look for ROS 2 publishers"),
        news_(dds_create_readcondition(publications_.get(), DDS_ANY_STATE), "look for ROS 2 publishers") {
    attach(waitset_.get(), "wait for the stop");
    attach(news_.get(), "look for ROS 2 publishers");
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
  /// A topic that is read, and whether a message of it came since its last end.
  struct Source {
    ImuTopic* topic;
    bool alive = false;
  };

  void attach(dds_entity_t condition, const std::string& attempt) const {
    check(dds_waitset_attach(waitset_.get(), condition, 0), attempt);
  }

  void read(ImuTopic& topic) {
    attach(topic.reader().data_condition(), "wait for topic '" + topic.name() + "'");
    sources_.push_back({&topic});
  }

  void work() noexcept {
    while (!stopping_.load(std::memory_order_relaxed)) {
      (void)dds_waitset_wait(waitset_.get(), nullptr, 0, DDS_INFINITY);
      look_for_topics();
      for (Source& source : sources_) take(source);
    }
  }

  /// Opens the topics of those publishers that have appeared.
  void look_for_topics() noexcept {
    while (true) {
      const Loan<Endpoint> loan(publications_.get());
      if (loan.size() == 0) return;
      for (std::size_t i = 0; i < loan.size(); ++i) {
        if (loan.info(i).valid_data && loan.message(i).type_name == std::string_view(kImuType))
          meet(loan.message(i).topic_name);
      }
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

  /// Takes once from a topic. The state that comes with a message is that of the moment: what else the cache holds comes before an
  /// end, and a new publisher undoes it.
  std::size_t take(Source& source) noexcept {
    bool ended = false;
    const auto receive_one = [&](const Imu& message, const dds_sample_info_t& info) {
      if (info.valid_data) receive(source, message);
      ended = info.instance_state != DDS_ALIVE_INSTANCE_STATE;
    };
    const TopicReader<Imu>& reader = source.topic->reader();
    const std::size_t taken = reader.take(receive_one);
    while (ended && reader.take(receive_one) > 0) {
    }
    if (ended && source.alive) {
      source.alive = false;
      handler_.on_end(source.topic->name());
    }
    return taken;
  }

  void receive(Source& source, const Imu& message) noexcept {
    source.alive = true;
    if (!source.topic->hold(message)) return;
    if (!handler_.on_sample(source.topic->name(), sample_of(message))) source.topic->give_up_newest();
  }

  /// A publisher may never pause: no more than a cache of each topic.
  void take_rest() noexcept {
    for (Source& source : sources_) {
      for (std::size_t taken = 0; taken < topics_.options().depth;) {
        const std::size_t more = take(source);
        if (more == 0) break;
        taken += more;
      }
    }
  }

  ImuTopics::Impl& topics_;
  ImuHandler& handler_;
  Entity waitset_;
  Entity publications_;
  Entity news_;
  std::vector<Source> sources_;
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
