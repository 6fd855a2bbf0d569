/// The port from outside: who is let in, what a browser need not be sent again, and what is counted of it.
#include <filesystem>
#include <memory>
#include <string>

#include <gmock/gmock.h>

#include "live/live.hpp"
#include "support/scratch_folder.hpp"
#include "unit/monitor/exposition.hpp"
#include "unit/monitor/monitor_fixture.hpp"

namespace gyrod::monitor::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(MonitorTest, MetricsTellOfTheirOwnPort) {
  start();
  (void)get(port_, "/nowhere");
  (void)ask(port_, "POST", "/metrics");
  const auto families = parse_exposition(get(port_, "/metrics").body);
  EXPECT_EQ(value_of(families, "gyrod_http_requests_total", {{"code", "404"}}), 1.0);
  EXPECT_EQ(value_of(families, "gyrod_http_requests_total", {{"code", "200"}}), 0.0)
      << "this one is not made yet";
  EXPECT_EQ(value_of(families, "gyrod_http_refused_total", {{"reason", "method"}}), 1.0);
}

TEST_F(MonitorTest, ABrowserThatHasThePageIsNotSentItAgain) {
  start();
  const std::string headers = get(port_, "/").headers;
  const std::size_t begin = headers.find("ETag: ") + 6;
  const std::string tag = headers.substr(begin, headers.find('\r', begin) - begin);
  ASSERT_TRUE(tag.starts_with("W/\"")) << headers;
  for (const std::string& held : {tag, tag.substr(2), "\"other\", " + tag, std::string("*")}) {
    const HttpAnswer same = ask(port_, "GET", "/", "If-None-Match: " + held + "\r\n");
    EXPECT_EQ(same.status, 304) << held;
    EXPECT_EQ(same.body, "") << held;
    EXPECT_THAT(same.headers, AllOf(HasSubstr("ETag: " + tag), HasSubstr("Cache-Control: no-cache"),
                                    HasSubstr("Content-Security-Policy: "), HasSubstr("Connection: close")));
    EXPECT_THAT(same.headers, AllOf(Not(HasSubstr("Content-Length")), Not(HasSubstr("Content-Type: "))));
  }
  EXPECT_EQ(ask(port_, "GET", "/", "If-None-Match: W/\"other\"\r\n").status, 200);
  EXPECT_EQ(ask(port_, "GET", "/metrics", "If-None-Match: *\r\n").status, 200) << "is new each time";
  EXPECT_EQ(ask(port_, "POST", "/", "If-None-Match: *\r\n").status, 405);
}

TEST_F(MonitorTest, AConnectionIsKeptAfterAPageThatWasHeld) {
  start();
  const HttpClient client(port_);
  (void)client.send("GET / HTTP/1.1\r\nHost: localhost\r\nIf-None-Match: *\r\n\r\n");
  EXPECT_THAT(client.receive_until("\r\n\r\n"),
              AllOf(HasSubstr("HTTP/1.1 304 Not Modified\r\n"), HasSubstr("Connection: keep-alive\r\n")));
  (void)client.send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_THAT(client.receive_until("ok\n"), HasSubstr("HTTP/1.1 200 OK"));
}

TEST_F(MonitorTest, EveryPathButOneAsksWhoItIs) {
  const testing::ScratchFolder folder;
  const std::string token = folder.write("token", "0123456789abcdef0123456789abcdef\n");
  std::filesystem::permissions(token,
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  MonitorOptions options = any_port();
  options.access.token_file = token;
  live::Live live;
  view_.live = &live;
  monitor_ = std::make_unique<Monitor>(options, view_);
  monitor_->start();
  const std::uint16_t port = monitor_->port();
  const std::string api = "/api/v1/";
  for (const std::string& path :
       {std::string("/"), std::string("/metrics"), std::string("/readyz"), api + "status", api + "config",
        api + "channels", api + "channels/imu_front", api + "channels/imu_front/samples",
        api + "channels/imu_front/spectrum", api + "channels/imu_front/stream", api + "events",
        api + "stream?channels=1", std::string("/nowhere"), std::string("/healthz/"),
        std::string("/healthz/../metrics"), std::string("//healthz"), std::string("/healthz%2f..%2fmetrics"),
        std::string("/metrics?/healthz"), std::string("/metrics#/healthz")}) {
    for (const std::string method : {"GET", "HEAD", "POST"}) {
      const HttpAnswer answer = ask(port, method, path);
      EXPECT_EQ(answer.status, 401) << method << " " << path;
      EXPECT_THAT(answer.body, Not(HasSubstr("imu_front"))) << path;
    }
  }
  EXPECT_EQ(get(port, "/healthz").status, 200);
  EXPECT_EQ(
      ask(port, "GET", api + "config", "Authorization: Bearer 0123456789abcdef0123456789abcdef\r\n").status,
      200);
}

}  // namespace
}  // namespace gyrod::monitor::test
