/// The port from outside: what it answers, and that no client can hold it up.
#include "monitor/monitor.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/slow_build.hpp"
#include "unit/monitor/exposition.hpp"
#include "unit/monitor/monitor_fixture.hpp"

namespace gyrod::monitor::test {
namespace {

using std::chrono::steady_clock;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// The contract is a second; a machine that is busy gets some more. An answer that is being made is finished first: under sanitizers that
/// alone takes seconds.
constexpr std::chrono::seconds kStopTime{gyrod::testing::kSlowBuild ? 20 : 5};

TEST_F(MonitorTest, MetricsComeAsPrometheusText) {
  start();
  const HttpAnswer answer = get(port_, "/metrics");
  EXPECT_EQ(answer.status, 200);
  EXPECT_THAT(answer.headers, HasSubstr("text/plain; version=0.0.4"));
  const auto families = parse_exposition(answer.body);
  EXPECT_EQ(value_of(families, "gyrod_samples_received_total"), 1009.0);
  EXPECT_GE(value_of(families, "gyrod_uptime_seconds").value_or(-1.0), 0.0);
}

TEST_F(MonitorTest, HealthIsOkWhileTheProcessAnswers) {
  shown_.readiness = {.ready = false, .reason = "stopping"};
  start();
  const HttpAnswer answer = get(port_, "/healthz");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body, "ok\n");
}

TEST_F(MonitorTest, ReadyWhenWorkCanBeDone) {
  start();
  const HttpAnswer answer = get(port_, "/readyz");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body, "ready\n");
}

TEST_F(MonitorTest, NotReadyComesWithTheReason) {
  shown_.readiness = {.ready = false, .reason = "stopping"};
  start();
  const HttpAnswer answer = get(port_, "/readyz");
  EXPECT_EQ(answer.status, 503);
  EXPECT_EQ(answer.body, "not ready: stopping\n");
  EXPECT_EQ(value_of(parse_exposition(get(port_, "/metrics").body), "gyrod_ready"), 0.0);
}

TEST_F(MonitorTest, TheRootNamesAllThatIsHere) {
  start();
  EXPECT_THAT(get(port_, "/").body,
              AllOf(HasSubstr("/metrics"), HasSubstr("/healthz"), HasSubstr("/readyz")));
}

TEST_F(MonitorTest, AnythingElseIsNotFound) {
  start();
  for (const std::string path : {"/metric", "/metrics/", "/../etc/passwd", "/%00", "/?", "//"}) {
    const int status = get(port_, path).status;
    EXPECT_TRUE(status == 404 || (path == "/?" && status == 200)) << path << " " << status;
  }
}

TEST_F(MonitorTest, AQueryDoesNotHideThePath) {
  start();
  EXPECT_EQ(get(port_, "/healthz?verbose=1").body, "ok\n");
}

TEST_F(MonitorTest, HeadGivesTheHeadersWithoutTheBody) {
  start();
  const HttpAnswer head = ask(port_, "HEAD", "/healthz");
  EXPECT_EQ(head.status, 200);
  EXPECT_THAT(head.headers, AllOf(HasSubstr("Content-Length: 3"), HasSubstr("Content-Type: text/plain")));
  EXPECT_EQ(head.body, "");
}

TEST_F(MonitorTest, OtherMethodsAreRefused) {
  start();
  for (const std::string method : {"POST", "PUT", "DELETE", "OPTIONS"}) {
    const HttpAnswer answer = ask(port_, method, "/metrics");
    EXPECT_EQ(answer.status, 405) << method;
    EXPECT_THAT(answer.headers, HasSubstr("Allow: GET, HEAD"));
  }
}

TEST_F(MonitorTest, AViewThatThrowsIsAnInternalErrorAndTheNextRequestIsServed) {
  view_.bus = []() -> BusSnapshot { throw std::runtime_error("no bus"); };
  start();
  const HttpAnswer answer = get(port_, "/metrics");
  EXPECT_EQ(answer.status, 500);
  EXPECT_THAT(answer.body, HasSubstr("no bus"));
  EXPECT_EQ(get(port_, "/healthz").status, 200);
}

TEST_F(MonitorTest, GarbageIsAnsweredOrClosedAndTheNextClientServed) {
  start();
  const std::string zeros(1000, '\0');
  for (const std::string& request :
       {std::string("\r\n\r\n"), std::string("GET\r\n\r\n"), std::string("GET / HTTP/9.9\r\n\r\n"),
        zeros + "\r\n\r\n", std::string("\x16\x03\x01\x02"),
        std::string("GET /metrics HTTP/1.1\r\nContent-Length: -1\r\n\r\n"),
        std::string("GET /") + std::string(100'000, 'a')}) {
    const HttpClient client(port_);
    (void)client.send(request);
    const std::string answer = client.receive();
    EXPECT_TRUE(answer.empty() || answer.starts_with("HTTP/1.1 ")) << answer;
  }
  EXPECT_EQ(get(port_, "/healthz").status, 200);
}

TEST_F(MonitorTest, ClientsThatSendNothingDoNotKeepOthersOut) {
  start();
  std::vector<std::unique_ptr<HttpClient>> idle;
  for (int i = 0; i < 8; ++i) {
    idle.push_back(std::make_unique<HttpClient>(port_));
    if (i % 2 == 0) (void)idle.back()->send("GET /metr");
  }
  EXPECT_EQ(get(port_, "/healthz").status, 200);
}

TEST_F(MonitorTest, StopDoesNotWaitForClients) {
  start();
  std::vector<std::unique_ptr<HttpClient>> idle;
  for (int i = 0; i < 8; ++i) {
    idle.push_back(std::make_unique<HttpClient>(port_));
    if (i % 2 == 0) (void)idle.back()->send("GET /metrics HTTP/1.1\r\n");
  }
  EXPECT_LT(time_to_stop(), kStopTime);
}

TEST_F(MonitorTest, StopDoesNotWaitForAClientThatDoesNotRead) {
  // Thousands of sensors: an answer that no socket buffer holds.
  for (int i = 0; i < 3000; ++i)
    shown_.channels.push_back(busy_sensor("a_sensor_with_a_long_name" + std::to_string(i)));
  MonitorOptions options = any_port();
  options.max_channel_series = 10'000;
  std::atomic<int> asked{0};
  view_.bus = [&asked, &shown = shown_] {
    ++asked;
    return shown.bus;
  };
  monitor_ = std::make_unique<Monitor>(options, view_);
  monitor_->start();
  const HttpClient deaf(monitor_->port());
  (void)deaf.send("GET /metrics HTTP/1.1\r\n\r\n");
  const auto deadline = steady_clock::now() + kPatience;
  while (asked == 0 && steady_clock::now() < deadline) std::this_thread::yield();
  EXPECT_LT(time_to_stop(), kStopTime);
}

TEST_F(MonitorTest, ManyClientsAtOnceAreAllServed) {
  start();
  std::atomic<int> served{0};
  std::vector<std::thread> clients;
  for (int i = 0; i < 8; ++i) {
    clients.emplace_back([&] {
      for (int request = 0; request < 20; ++request) {
        const HttpAnswer answer = get(port_, "/metrics");
        served += answer.status == 200 && answer.body.ends_with("\n") ? 1 : 0;
      }
    });
  }
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(served, 8 * 20);
}

TEST_F(MonitorTest, ABusyPortIsNamedWithItsAddress) {
  start();
  MonitorOptions options;
  options.port = port_;
  try {
    const Monitor second(options, view_);
    FAIL() << "shared the port";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), "port " + std::to_string(port_) + " on 127.0.0.1 is in use");
  }
}

TEST_F(MonitorTest, AnAddressThatIsNotOursIsNamed) {
  MonitorOptions options = any_port();
  options.address = "192.0.2.1";  // RFC 5737: no machine has it
  try {
    const Monitor monitor(options, view_);
    FAIL() << "listens there";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("on 192.0.2.1 cannot be taken: this machine has no such address"));
  }
}

TEST_F(MonitorTest, TextThatIsNoAddressIsNamed) {
  MonitorOptions options = any_port();
  options.address = "no address";
  try {
    const Monitor monitor(options, view_);
    FAIL() << "listens there";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("\"no address\""), HasSubstr("expected an address or host name")));
  }
}

TEST_F(MonitorTest, PortZeroTakesAFreeOne) {
  start();
  const Monitor other(any_port(), view_);
  EXPECT_NE(port_, 0);
  EXPECT_NE(other.port(), 0);
  EXPECT_NE(other.port(), port_);
}

TEST_F(MonitorTest, AfterStopThePortIsClosedAndFree) {
  start();
  monitor_->stop();
  monitor_->stop();
  EXPECT_FALSE(HttpClient(port_).connected());
  MonitorOptions options;
  options.port = port_;
  const Monitor next(options, view_);
  EXPECT_EQ(next.port(), port_);
}

TEST_F(MonitorTest, StopWithoutStartIsFine) {
  Monitor monitor(any_port(), view_);
  monitor.stop();
}

}  // namespace
}  // namespace gyrod::monitor::test
