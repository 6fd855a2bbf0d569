/// What became of requests, as the metrics tell it: each kind on a connection of its own.
#include "monitor/http_counts.hpp"

#include <string>

#include <gtest/gtest.h>

#include "monitor/http_server.hpp"
#include "unit/monitor/http_client.hpp"
#include "unit/monitor/scrape.hpp"

namespace gyrod::monitor::test {
namespace {

class HttpCountsTest : public ::testing::Test {
 protected:
  HttpCountsTest() : HttpCountsTest(listen_on("127.0.0.1", 0)) {}

  /// One connection until the server closes it.
  void exchange(const std::string& sends) const {
    const HttpClient client(port_);
    (void)client.send(sends);
    (void)client.receive();
  }

  /// Turned away for this reason, and for no other.
  void expect_only(Refusal why, std::uint64_t times) const {
    const HttpSnapshot now = server_.counts();
    for (std::size_t i = 0; i < kRefusals; ++i) {
      const auto each = static_cast<Refusal>(i);
      EXPECT_EQ(now.refused(each), each == why ? times : 0U) << name_of(each);
    }
  }

  static Answer answer_to(const Request& request) {
    return request.path == "/" ? Answer{.body = "fine\n"} : Answer{.status = 418, .body = "a teapot\n"};
  }

  std::uint16_t port_;
  HttpServer server_;

 private:
  explicit HttpCountsTest(Socket listener)
      : port_(port_of(listener)), server_(std::move(listener), answer_to) {
    server_.start();
  }
};

TEST_F(HttpCountsTest, WhatIsAnsweredIsCountedByStatusAndNotAsRefused) {
  for (int i = 0; i < 3; ++i) (void)get(port_, "/");
  (void)get(port_, "/none");
  EXPECT_EQ(server_.counts().answered(200), 3U);
  EXPECT_EQ(server_.counts().answered(418), 1U) << "under \"other\"";
  EXPECT_EQ(server_.counts().answers.back(), 1U);
  expect_only(Refusal::kHost, 0);
}

TEST_F(HttpCountsTest, ANameThatIsNotOurs) {
  exchange("GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n");
  EXPECT_EQ(server_.counts().answered(403), 1U);
  expect_only(Refusal::kHost, 1);
}

TEST_F(HttpCountsTest, MethodsThatWrite) {
  for (const char* method : {"POST", "DELETE"}) (void)ask(port_, method, "/");
  EXPECT_EQ(server_.counts().answered(405), 2U);
  expect_only(Refusal::kMethod, 2);
}

TEST_F(HttpCountsTest, WhatIsNoHttp) {
  exchange("hello\r\n\r\n");
  EXPECT_EQ(server_.counts().answered(400), 1U);
  expect_only(Refusal::kMalformed, 1);
}

TEST_F(HttpCountsTest, RequestsThatAreTooLarge) {
  exchange("GET / HTTP/1.1\r\nX: " + std::string(20'000, 'x') + "\r\n\r\n");
  EXPECT_EQ(server_.counts().answered(431), 1U);
  expect_only(Refusal::kTooLarge, 1);
  exchange("GET /" + std::string(10'000, 'x') + " HTTP/1.1\r\n\r\n");
  EXPECT_EQ(server_.counts().answered(414), 1U);
  expect_only(Refusal::kTooLarge, 2);
}

TEST_F(HttpCountsTest, AClientThatLeavesIsNobodysFault) {
  { const HttpClient silent(port_); }
  {
    const HttpClient half(port_);
    (void)half.send("GET / HT");
  }
  (void)get(port_, "/");
  expect_only(Refusal::kTimeout, 0);
}

TEST(HttpMetrics, EveryStatusAndReasonHasASeriesFromTheStart) {
  const Shown shown = busy_gyrod();
  const auto families = families_of(shown);
  for (std::size_t i = 0; i < kRefusals; ++i) {
    const std::string reason(name_of(static_cast<Refusal>(i)));
    EXPECT_EQ(value_of(families, "gyrod_http_refused_total", {{"reason", reason}}),
              200.0 + static_cast<double>(i));
  }
  EXPECT_EQ(find_family(families, "gyrod_http_refused_total")->series.size(), kRefusals);
  EXPECT_EQ(value_of(families, "gyrod_http_requests_total", {{"code", "200"}}), 100.0);
  EXPECT_EQ(value_of(families, "gyrod_http_requests_total", {{"code", "503"}}), 112.0);
  EXPECT_EQ(value_of(families, "gyrod_http_requests_total", {{"code", "other"}}), 113.0);
  EXPECT_EQ(find_family(families, "gyrod_http_requests_total")->series.size(), kStatuses.size() + 1);
}

}  // namespace
}  // namespace gyrod::monitor::test
