/// The JSON API of a real daemon: its values are those of the metrics, and a sensor that dies shows at once.
#include <chrono>
#include <csignal>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <nlohmann/json.hpp>

#include "rig.hpp"
#include "support/eventually.hpp"

namespace gyrod::testing {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class LiveApi : public Rig {
 protected:
  static json ask(const Process& daemon, const std::string& target) {
    return json::parse(get(daemon, "/api/v1/" + target), nullptr, false);
  }

  /// Reads the fleet's stream until a row of the sensor has this health. @return false if none came in time
  static bool stream_tells(const Process& daemon, const std::string& health) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    httplib::Client client("127.0.0.1", port_of(daemon));
    client.set_read_timeout(30);
    std::string text;
    bool told = false;
    (void)client.Get("/api/v1/stream?channels=1", [&](const char* data, std::size_t size) {
      text.append(data, size);
      for (std::size_t end = text.find("\n\n"); end != std::string::npos; end = text.find("\n\n")) {
        const std::string event = text.substr(0, end);
        text.erase(0, end + 2);
        if (!event.starts_with("event: channels\ndata: ")) continue;
        const json rows = json::parse(event.substr(event.find('{'))).at("channels");
        for (const json& row : rows) told = told || row.at("health") == health;
      }
      return !told && std::chrono::steady_clock::now() < deadline;
    });
    return told;
  }
};

/// What a client of the fleet's stream was told.
struct Told {
  std::vector<std::string> texts;  ///< of events
  std::string place;               ///< the last id: where it would go on
};

/// Connects with this Last-Event-ID, and leaves once a block of the stream holds `mark`, or the stream has ended.
/// @param connected called with the first block
Told listen(
    int port, const std::string& place, const std::string& mark,
    const std::function<void()>& connected = [] {}) {
  Told told{.texts = {}, .place = place};
  httplib::Client client("127.0.0.1", port);
  client.set_read_timeout(60);
  std::string text;
  bool first = true;
  const auto take = [&](const std::string& block) {
    if (std::exchange(first, false)) connected();
    std::istringstream lines(block);
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("id: ")) told.place = line.substr(4);
    }
    if (block.find("event: event\n") != std::string::npos)
      told.texts.push_back(json::parse(block.substr(block.find('{'))).at("text"));
    return block.find(mark) == std::string::npos;
  };
  (void)client.Get("/api/v1/stream", {{"Last-Event-ID", place}}, [&](const char* data, std::size_t size) {
    text.append(data, size);
    for (std::size_t end = text.find("\n\n"); end != std::string::npos; end = text.find("\n\n")) {
      const std::string block = text.substr(0, end + 1);
      text.erase(0, end + 2);
      if (!take(block)) return false;
    }
    return true;
  });
  return told;
}

TEST_F(LiveApi, WhoComesBackIsToldEachEventOnceAlsoByANewDaemon) {
  const DaemonOptions options{
      .window_samples = 128,
      .method = "paper",
      .silent_after_s = 1.0,
      .patch = R"({"denoise": {"hop_samples": 64}, "limits": {"max_hop_samples": 64}})"};
  auto daemon = start_daemon(options);
  // Texts of all events from one place to another.
  const auto between = [&](const std::string& from, const std::string& to) {
    std::vector<std::string> texts;
    const json page = ask(*daemon, "events?after=" + from.substr(from.find('-') + 1));
    for (const json& event : page.at("events")) {
      texts.push_back(event.at("text"));
      if (to.ends_with("-" + event.at("id").dump())) break;
    }
    return texts;
  };
  const auto has_happened = [&](const std::string& what) {
    return eventually([&] { return get(*daemon, "/api/v1/events").find(what) != std::string::npos; });
  };
  ASSERT_TRUE(has_happened("has started, epoch " + ask(*daemon, "status").at("epoch").get<std::string>()));
  const Told begin = listen(port_of(*daemon), "", "id: ");
  EXPECT_TRUE(begin.texts.empty()) << "from now on";

  const auto sensor = start_on_bus({"simulate", "--sensor", "imu"});
  ASSERT_TRUE(has_happened("imu is ok"));
  const Told up = listen(port_of(*daemon), begin.place, "imu is ok");
  EXPECT_EQ(up.texts, between(begin.place, up.place));
  sensor->signal(SIGKILL);
  sensor->wait();
  ASSERT_TRUE(has_happened("imu is silent"));
  const Told down = listen(port_of(*daemon), up.place, "imu is silent");
  EXPECT_EQ(down.texts, between(up.place, down.place));
  ASSERT_FALSE(up.texts.empty() || down.texts.empty());

  const Told stop = listen(port_of(*daemon), down.place, "gyrod stops", [&] { daemon->signal(SIGTERM); });
  ASSERT_FALSE(stop.texts.empty());
  EXPECT_THAT(stop.texts.back(), HasSubstr("gyrod stops")) << "told before the stream ends";
  EXPECT_EQ(daemon->wait(), 0);

  daemon = start_daemon(options);
  const Told anew = listen(port_of(*daemon), stop.place, "has started");
  ASSERT_EQ(anew.texts.size(), 1U) << "the new one's first event, whose number is a small one";
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(LiveApi, TellsWhatTheMetricsTellAndThatASensorDied) {
  const auto daemon = start_daemon({.window_samples = 128,
                                    .method = "paper",
                                    .silent_after_s = 1.0,
                                    .patch = R"({"denoise": {"scheme": "raw", "hop_samples": 64},
                                                 "limits": {"max_hop_samples": 64}})"});
  const auto sensor = start_on_bus({"simulate", "--sensor", "car/imu1"});
  const std::string path = "channels/car%2Fimu1";
  ASSERT_TRUE(eventually([&] { return ask(*daemon, path).contains("sensor"); }));
  ASSERT_TRUE(eventually([&] {
    const json samples = ask(*daemon, path + "/samples?seconds=10&points=100");
    return !samples.at("denoised").at("t_s").empty();
  })) << "the first look has its samples kept";
  EXPECT_TRUE(stream_tells(*daemon, "ok"));

  sensor->signal(SIGKILL);
  sensor->wait();
  EXPECT_TRUE(stream_tells(*daemon, "silent"));
  ASSERT_TRUE(eventually([&] { return ask(*daemon, path).at("state") != "active"; }));
  EXPECT_EQ(ask(*daemon, path).at("health"), "silent");
  EXPECT_THAT(ask(*daemon, "events?sensor=car/imu1&limit=1").dump(), HasSubstr("car/imu1 is silent"));

  // Nothing flows any more, so that two answers tell of the same moment.
  const json row = ask(*daemon, path);
  const json status = ask(*daemon, "status");
  const auto value = [&](const std::string& name, const std::string& labels = "") {
    return metric(*daemon, name + labels).value_or(-1.0);
  };
  const std::string id = "{sensor=\"car/imu1\"}";
  EXPECT_GT(row.at("received"), 0);
  EXPECT_EQ(row.at("received"), value("gyrod_sensor_samples_received_total", id));
  EXPECT_EQ(row.at("published"), value("gyrod_sensor_samples_published_total", id));
  EXPECT_EQ(row.at("counts").at("windows"), value("gyrod_sensor_windows_total", id));
  EXPECT_EQ(status.at("samples").at("received"), value("gyrod_samples_received_total"));
  EXPECT_EQ(status.at("samples").at("in_flight"), 0);
  EXPECT_EQ(status.at("channels").at("by_health").at("silent"), 1);
  EXPECT_EQ(ask(*daemon, "config").at("denoise").at("window_samples"), 128);
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

}  // namespace
}  // namespace gyrod::testing
