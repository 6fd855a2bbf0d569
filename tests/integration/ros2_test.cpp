// ROS 2 topics through the daemon: what a node publishes, and what another one is given.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bus/domain.hpp"
#include "bus/raw_writer.hpp"
#include "rig.hpp"
#include "support/eventually.hpp"
#include "support/imu_node.hpp"
#include "support/samples.hpp"

namespace gyrod::testing {
namespace {

/// At the defaults: the first window that is long enough for a model ends with the second hop (64 samples), and what is made of
/// it is used when the third is full.
constexpr std::size_t kFirstModel = 96;
constexpr std::size_t kLag = 16;

class Ros2 : public Rig {
 protected:
  [[nodiscard]] dds_entity_t participant() const { return domain_.participant(); }
  [[nodiscard]] const bus::Domain& domain() const { return domain_; }

  /// Publishes all, never far ahead of what comes back at once: sensor data are best effort, and sockets have an end.
  /// @param refused messages so far that nothing comes back for
  static void send(const ImuPublisher& publisher, std::span<const ImuMessage> messages,
                   ImuSubscription& realtime, std::size_t refused = 0) {
    constexpr std::size_t kAhead = 50;
    const std::size_t before = realtime.messages().size();
    for (std::size_t i = 0; i < messages.size(); ++i) {
      publisher.publish(messages[i]);
      const std::size_t due = i - std::min(i, kAhead + refused);
      ASSERT_TRUE(realtime.wait_for(before + due)) << i;
    }
    ASSERT_TRUE(realtime.wait_for(before + messages.size() - refused));
  }

  /// Waits until the daemon and this publisher, the only one, know of each other: what is published earlier is lost.
  static void connect(const Process& daemon, const ImuPublisher& publisher) {
    ASSERT_TRUE(publisher.wait_for_reader());
    ASSERT_TRUE(eventually([&daemon] { return count(daemon, "gyrod_bus_matched_writers") == 1.0; }));
  }
  /// The same of a subscription to an output.
  static void connect(const Process& daemon, const ImuSubscription& subscription, const std::string& topic) {
    ASSERT_TRUE(subscription.wait_for_writer());
    ASSERT_TRUE(eventually([&] { return has_reader(daemon, topic); }));
  }
  static void wait_for_its_end(const Process& daemon) {
    ASSERT_TRUE(eventually([&daemon] { return count(daemon, "gyrod_bus_matched_writers") == 0.0; }));
  }

  static double count(const Process& daemon, const std::string& series) {
    return metric(daemon, series).value_or(-1.0);
  }
  static double refused(const Process& daemon, const std::string& reason) {
    return count(daemon, "gyrod_samples_rejected_total{reason=\"" + reason + "\"}");
  }

  /// The rates, and the diagonals of the covariances as deviations squared, of a file of `gyrod denoise --std`.
  /// @param unknown so many samples at first come before a model; their covariances say unknown
  void expect_equals_offline(const std::vector<ImuMessage>& live, const std::string& file,
                             std::size_t unknown) {
    const auto rows = columns_of(path(file), {"gyro_x_radps", "gyro_y_radps", "gyro_z_radps",
                                              "gyro_std_x_radps", "gyro_std_y_radps", "gyro_std_z_radps"});
    ASSERT_EQ(live.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      std::array<double, 6> value{};
      const char* text = rows[i].c_str();
      for (double& number : value) {
        char* end = nullptr;
        number = std::strtod(text, &end);
        text = end + 1;
      }
      const auto rates = rates_of(live[i]);
      ASSERT_TRUE(rates[0] == value[0] && rates[1] == value[1] && rates[2] == value[2])
          << file << " row " << i;
      const auto& covariance = live[i].fields.angular_velocity_covariance;
      for (std::size_t element = 0; element < 9; ++element) {
        const double deviation = element % 4 == 0 && i >= unknown ? value[3 + element / 4] : 0.0;
        ASSERT_EQ(covariance[element], deviation * deviation)
            << file << " row " << i << " element " << element;
      }
    }
  }

  static void expect_untouched(const std::vector<ImuMessage>& live, const std::vector<ImuMessage>& sent) {
    ASSERT_EQ(live.size(), sent.size());
    for (std::size_t i = 0; i < sent.size(); ++i)
      ASSERT_TRUE(untouched_bits(live[i]) == untouched_bits(sent[i])) << "message " << i;
  }

 private:
  bus::Domain domain_{domain_id(), "loopback"};
};

TEST_F(Ros2, ATopicIsDenoisedAsItsRecordingAndNothingElseOfAMessageChanges) {
  const std::vector<ImuMessage> sent = noisy_imu_messages(2000);
  write_file("raw.csv", recording_of(sent));
  for (const std::string estimate : {"denoised", "realtime"}) {
    ASSERT_EQ(run({"denoise", path("raw.csv"), "-o", path(estimate + ".csv"), "--std", "--accelerometer",
                   "--estimate", estimate})
                  .exit_code,
              0);
  }
  const auto daemon = start_daemon({.patch = R"({"bus": {"ros2": {"topics": ["rt/car/imu/data_raw"]}}})"});
  ImuSubscription denoised(participant(), "rt/car/imu/data_denoised");
  ImuSubscription realtime(participant(), "rt/car/imu/data_realtime");
  connect(*daemon, denoised, "rt/car/imu/data_denoised");
  connect(*daemon, realtime, "rt/car/imu/data_realtime");
  {
    const ImuPublisher publisher(participant(), "rt/car/imu/data_raw");
    connect(*daemon, publisher);
    send(publisher, sent, realtime);
  }  // the publisher goes: what is held for its look-ahead is released
  ASSERT_TRUE(denoised.wait_for(sent.size()));

  expect_equals_offline(denoised.messages(), "denoised.csv", kFirstModel - kLag);
  expect_equals_offline(realtime.messages(), "realtime.csv", kFirstModel);
  expect_untouched(denoised.messages(), sent);
  expect_untouched(realtime.messages(), sent);
  EXPECT_EQ(count(*daemon, "gyrod_ros2_dropped_messages_total"), 0.0);
  EXPECT_NE(get(*daemon, "/metrics").find("sensor=\"rt/car/imu/data_raw\""), std::string::npos)
      << "the topic's name is the sensor's id";
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

TEST_F(Ros2, MethodPaperReleasesWholeMessagesInBursts) {
  const std::vector<ImuMessage> sent = noisy_imu_messages(1500);
  write_file("raw.csv", recording_of(sent));
  ASSERT_EQ(run({"denoise", path("raw.csv"), "-o", path("paper.csv"), "--std", "--accelerometer", "--method",
                 "paper"})
                .exit_code,
            0);
  const auto daemon =
      start_daemon({.method = "paper", .patch = R"({"bus": {"ros2": {"topics": ["rt/imu"]}}})"});
  ImuSubscription denoised(participant(), "rt/imu_denoised");
  connect(*daemon, denoised, "rt/imu_denoised");
  {
    const ImuPublisher publisher(participant(), "rt/imu");
    connect(*daemon, publisher);
    // Nothing comes back at once, but up to a hop and the lag (48) behind.
    for (std::size_t i = 0; i < sent.size(); ++i) {
      publisher.publish(sent[i]);
      ASSERT_TRUE(denoised.wait_for(i - std::min<std::size_t>(i, 100))) << i;
    }
    // A publisher that goes takes with it what a best-effort subscription has not read yet.
    const auto received = static_cast<double>(sent.size());
    ASSERT_TRUE(eventually([&] { return count(*daemon, "gyrod_samples_received_total") == received; }));
  }
  ASSERT_TRUE(denoised.wait_for(sent.size()));
  expect_equals_offline(denoised.messages(), "paper.csv", 0);
  expect_untouched(denoised.messages(), sent);
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

TEST_F(Ros2, GapsShowByStampsAndWhatIsRefusedIsCountedAndNotPublished) {
  const auto daemon = start_daemon({.patch = R"({"bus": {"ros2": {"topics": ["rt/imu/data_raw"]}}})"});
  ImuSubscription denoised(participant(), "rt/imu/data_denoised");
  ImuSubscription realtime(participant(), "rt/imu/data_realtime");
  connect(*daemon, denoised, "rt/imu/data_denoised");
  connect(*daemon, realtime, "rt/imu/data_realtime");

  std::vector<ImuMessage> sent = noisy_imu_messages(1000);
  sent.erase(sent.begin() + 600, sent.begin() + 700);  // longer than limits.max_bridged_samples
  sent.erase(sent.begin() + 400, sent.begin() + 405);
  sent[500].fields.angular_velocity.y = std::nan("");
  sent[510].fields.angular_velocity_covariance[0] = -1.0;  // ROS 2: there is no angular velocity in it
  sent[520].fields.angular_velocity.z = 1e6;
  sent[530].fields.header = sent[529].fields.header;  // the same stamp again
  std::vector<ImuMessage> expected = sent;
  for (const std::ptrdiff_t refused : {530, 520, 510, 500}) expected.erase(expected.begin() + refused);
  {
    const ImuPublisher publisher(participant(), "rt/imu/data_raw");
    connect(*daemon, publisher);
    send(publisher, sent, realtime, sent.size() - expected.size());
  }
  ASSERT_TRUE(denoised.wait_for(expected.size()));
  expect_untouched(denoised.messages(), expected);
  expect_untouched(realtime.messages(), expected);

  EXPECT_EQ(count(*daemon, "gyrod_samples_received_total"), 895.0);
  EXPECT_EQ(count(*daemon, "gyrod_samples_published_total"), 891.0);
  EXPECT_EQ(refused(*daemon, "not_finite"), 2.0);
  EXPECT_EQ(refused(*daemon, "out_of_range"), 1.0);
  EXPECT_EQ(refused(*daemon, "duplicate"), 1.0);
  // Never sent: 5 and 100, and the one in whose place a stamp came again.
  EXPECT_EQ(count(*daemon, "gyrod_samples_missing_total"), 106.0);
  EXPECT_EQ(count(*daemon, "gyrod_gaps_total"), 1.0);
  EXPECT_EQ(count(*daemon, "gyrod_samples_bridged_total"), 9.0)
      << "5, the 3 refused ones and the one that is missing";
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

TEST_F(Ros2, TopicsOfAPatternAreOpenedWhileRunningAndOutputsAreNeverRead) {
  // The pattern fits the outputs, too.
  const auto daemon =
      start_daemon({.patch = R"({"bus": {"ros2": {"topics": ["rt/*/imu/*"], "max_topics": 2}}})"});
  EXPECT_EQ(count(*daemon, "gyrod_ros2_topics"), 0.0);
  const std::vector<ImuMessage> sent = noisy_imu_messages(200);
  const auto drive = [&](const std::string& car) {
    ImuSubscription realtime(participant(), "rt/" + car + "/imu/data_realtime");
    const ImuPublisher publisher(participant(), "rt/" + car + "/imu/data_raw");
    connect(*daemon, publisher);
    connect(*daemon, realtime, "rt/" + car + "/imu/data_realtime");
    send(publisher, sent, realtime);
    expect_untouched(realtime.messages(), sent);
  };
  drive("red");
  wait_for_its_end(*daemon);
  EXPECT_EQ(count(*daemon, "gyrod_ros2_topics"), 1.0);
  drive("blue");
  wait_for_its_end(*daemon);
  EXPECT_EQ(count(*daemon, "gyrod_ros2_topics"), 2.0);
  drive("red");  // comes back: the topic has stayed open

  const ImuPublisher foreign_output(participant(), "rt/green/imu/data_denoised");
  const ImuPublisher one_too_many(participant(), "rt/green/imu/data_raw");
  ASSERT_TRUE(eventually([&] { return count(*daemon, "gyrod_ros2_refused_topics_total") == 1.0; }));
  EXPECT_TRUE(daemon->wait_for_err(
      "cannot open ROS 2 topic 'rt/green/imu/data_raw': 2 are open, no more are allowed"));
  EXPECT_EQ(count(*daemon, "gyrod_ros2_topics"), 2.0);
  EXPECT_EQ(count(*daemon, "gyrod_sensors"), 2.0);
  EXPECT_EQ(count(*daemon, "gyrod_samples_received_total"), 600.0);
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

TEST_F(Ros2, AnIdOfARos2TopicIsRefusedToSensorsOfTheOtherTopics) {
  const auto daemon = start_daemon({.patch = R"({"bus": {"ros2": {"topics": ["rt/*/imu"]}}})"});
  bus::BusOptions options;
  bus::RawWriter writer(domain(), options);
  ASSERT_TRUE(writer.wait_for_subscriber(std::chrono::seconds{60}));
  EXPECT_EQ(writer.publish("rt/car/imu", noisy_samples(10)), 10U);
  EXPECT_EQ(writer.publish("rt/car/imu2", noisy_samples(10)), 10U);
  ASSERT_TRUE(eventually([&] { return count(*daemon, "gyrod_samples_received_total") == 20.0; }));
  EXPECT_EQ(refused(*daemon, "bad_sensor_id"), 10.0);
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

TEST_F(Ros2, AReliableSubscriptionIsServedWhereTheOutputIsReliable) {
  const auto daemon = start_daemon(
      {.patch = R"({"bus": {"ros2": {"topics": ["rt/imu"], "output_reliability": "reliable"}}})"});
  ImuSubscription reliable(participant(), "rt/imu_realtime", true);
  ImuSubscription best_effort(participant(), "rt/imu_realtime");
  EXPECT_TRUE(reliable.wait_for_writer() && best_effort.wait_for_writer());
  const ImuPublisher publisher(participant(), "rt/imu", true);
  EXPECT_TRUE(publisher.wait_for_reader()) << "gyrod takes from reliable publishers, too";
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

}  // namespace
}  // namespace gyrod::testing
