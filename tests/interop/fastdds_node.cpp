// A ROS 2 node on Fast DDS: publishes an Imu on one topic, subscribes to what gyrod makes of it, and checks that nothing but rates
// and their covariance has changed. Prints what it was given, one message a line: "denoised" or "realtime", and the rates.
//
//   fastdds_node DOMAIN STEM COUNT GO
//
// STEM_raw out, STEM_denoised and STEM_realtime in, over this machine's loopback interface only. Says "found" on standard error
// when it has found gyrod, and begins when the file GO is there: gyrod has to have found it, too.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "interop/fastdds_imu_type.hpp"
#include "support/eventually.hpp"
#include "support/imu_message.hpp"

namespace gyrod::testing {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

template <class T>
T* made(T* object, const std::string& what) {
  if (object == nullptr) throw std::runtime_error("Fast DDS does not make " + what);
  return object;
}

void require(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error(what);
}

/// Loopback alone, and the ports at which participants of a domain without multicast wait for others (RTPS 2.3, 9.6.1.1).
dds::DomainParticipantQos loopback_qos(std::uint32_t domain) {
  constexpr std::uint32_t kParticipants = 10;
  dds::DomainParticipantQos qos;
  const auto transport = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  transport->interfaceWhiteList.emplace_back("127.0.0.1");
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(transport);
  for (std::uint32_t participant = 0; participant < kParticipants; ++participant) {
    rtps::Locator_t peer;
    rtps::IPLocator::setIPv4(peer, "127.0.0.1");
    peer.port = 7400 + 250 * domain + 10 + 2 * participant;
    qos.wire_protocol().builtin.initialPeersList.push_back(peer);
  }
  return qos;
}

template <class Qos>
Qos sensor_qos(Qos qos) {
  qos.reliability().kind = dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind = dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 1000;
  return qos;
}

class Node {
 public:
  explicit Node(std::uint32_t domain)
      : participant_(made(
            dds::DomainParticipantFactory::get_instance()->create_participant(domain, loopback_qos(domain)),
            "a participant")),
        publisher_(made(participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT), "a publisher")),
        subscriber_(made(participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT), "a subscriber")) {
    type_.register_type(participant_);
  }
  ~Node() {
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  dds::DataWriter* writer(const std::string& name) {
    return made(publisher_->create_datawriter(topic(name), sensor_qos(dds::DATAWRITER_QOS_DEFAULT)),
                "a writer");
  }
  dds::DataReader* reader(const std::string& name) {
    return made(subscriber_->create_datareader(topic(name), sensor_qos(dds::DATAREADER_QOS_DEFAULT)),
                "a reader");
  }
  void end(dds::DataWriter* writer) { publisher_->delete_datawriter(writer); }

 private:
  dds::Topic* topic(const std::string& name) {
    return made(participant_->create_topic(name, type_.get_type_name(), dds::TOPIC_QOS_DEFAULT),
                "topic " + name);
  }

  dds::DomainParticipant* participant_;
  dds::Publisher* publisher_;
  dds::Subscriber* subscriber_;
  dds::TypeSupport type_{new FastDdsImuType};
};

bool has_reader(dds::DataWriter& writer) {
  dds::PublicationMatchedStatus status;
  writer.get_publication_matched_status(status);
  return status.current_count > 0;
}

bool has_writer(dds::DataReader& reader) {
  dds::SubscriptionMatchedStatus status;
  reader.get_subscription_matched_status(status);
  return status.current_count > 0;
}

/// Takes and checks what comes back on one topic.
class Answers {
 public:
  Answers(std::string name, dds::DataReader& reader, const std::vector<ImuMessage>& sent)
      : name_(std::move(name)), reader_(reader), sent_(sent) {}

  /// Waits until so many messages have come in all.
  void wait_for(std::size_t count) {
    const bool came = eventually([&] {
      take();
      return next_ >= count;
    });
    require(came, name_ + ": " + std::to_string(next_) + " messages came, expected " + std::to_string(count));
  }

 private:
  void take() {
    ImuMessage message;
    dds::SampleInfo info;
    while (reader_.take_next_sample(&message, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) check(message);
    }
  }

  void check(const ImuMessage& message) {
    require(next_ < sent_.size() && untouched_bits(message) == untouched_bits(sent_[next_]),
            name_ + ": message " + std::to_string(next_) + " is not what was sent");
    const auto rates = rates_of(message);
    std::printf("%s %.17g %.17g %.17g\n", name_.c_str(), rates[0], rates[1], rates[2]);
    ++next_;
  }

  std::string name_;
  dds::DataReader& reader_;
  const std::vector<ImuMessage>& sent_;
  std::size_t next_ = 0;
};

/// Publishes all, never far ahead of what comes back at once: sensor data are best effort, and sockets have an end.
void publish(dds::DataWriter& writer, const std::vector<ImuMessage>& messages, Answers& realtime) {
  constexpr std::size_t kAhead = 20;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    ImuMessage message = messages[i];
    require(writer.write(&message), "message " + std::to_string(i) + " was not written");
    realtime.wait_for(i - std::min(i, kAhead));
  }
  realtime.wait_for(messages.size());
}

void run(std::uint32_t domain, const std::string& stem, std::size_t count, const std::filesystem::path& go) {
  const std::vector<ImuMessage> messages = noisy_imu_messages(count);
  Node node(domain);
  dds::DataReader* denoised_reader = node.reader(stem + "_denoised");
  dds::DataReader* realtime_reader = node.reader(stem + "_realtime");
  require(eventually([&] { return has_writer(*denoised_reader) && has_writer(*realtime_reader); }),
          "no gyrod writes");
  dds::DataWriter* writer = node.writer(stem + "_raw");
  require(eventually([&] { return has_reader(*writer); }), "no gyrod reads");
  std::fputs("found\n", stderr);
  require(eventually([&] { return std::filesystem::exists(go); }), "nobody said go");

  Answers denoised("denoised", *denoised_reader, messages);
  Answers realtime("realtime", *realtime_reader, messages);
  publish(*writer, messages, realtime);
  node.end(writer);  // the sensor has ended: gyrod releases what it holds
  denoised.wait_for(messages.size());
}

}  // namespace
}  // namespace gyrod::testing

// Fast DDS 2.9 deletes its writers as another type than it made them. That is not ours to find.
extern "C" const char* __asan_default_options() { return "new_delete_type_mismatch=0"; }

int main(int argc, char** argv) {
  try {
    gyrod::testing::require(argc == 5, "usage: fastdds_node DOMAIN STEM COUNT GO");
    gyrod::testing::run(static_cast<std::uint32_t>(std::stoul(argv[1])), argv[2], std::stoul(argv[3]),
                        argv[4]);
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fastdds_node: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
