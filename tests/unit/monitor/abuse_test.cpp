/// Clients that mean no good, all at once: others are answered throughout, and nothing is left behind.
#include <atomic>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monitor/http_server.hpp"
#include "support/eventually.hpp"
#include "unit/monitor/http_client.hpp"

namespace gyrod::monitor::test {
namespace {

using std::chrono::steady_clock;
using ::testing::AnyOf;
using ::testing::Eq;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr std::size_t kLargeBytes = 8'000'000;

std::size_t open_descriptors() {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
}

class AbuseTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Socket listener = listen_on("127.0.0.1", 0);
    port_ = port_of(listener);
    constexpr RateLimit::Options kAny{.burst = 1e6, .per_second = 1e6};
    server_ = std::make_unique<HttpServer>(
        std::move(listener), [](const Request& request) { return answer_to(request); },
        HttpOptions{.requests = kAny});
    server_->start();
  }

  static Answer answer_to(const Request& request) {
    if (request.path == "/large") return {.body = std::string(kLargeBytes, 'a')};
    if (request.path == "/page") return {.body = std::string(300'000, 'a')};
    if (request.path == "/") return {.body = "fine\n"};
    return {.status = 404, .body = "not here\n"};
  }

  [[nodiscard]] std::vector<std::unique_ptr<HttpClient>> open(int count, const std::string& sends) const {
    std::vector<std::unique_ptr<HttpClient>> clients;
    for (int i = 0; i < count; ++i) {
      clients.push_back(std::make_unique<HttpClient>(port_));
      if (!sends.empty()) (void)clients.back()->send(sends);
    }
    return clients;
  }

  /// A good client is answered, and long before the bad ones' time is up.
  void expect_service() const {
    const auto begin = steady_clock::now();
    EXPECT_EQ(get(port_, "/").body, "fine\n");
    EXPECT_LT(steady_clock::now() - begin, std::chrono::milliseconds{1500});
  }

  /// One connection, all of what comes back.
  [[nodiscard]] std::string exchange(const std::string& sends) const {
    const HttpClient client(port_);
    (void)client.send(sends);
    return client.receive();
  }

  std::uint16_t port_ = 0;
  std::unique_ptr<HttpServer> server_;
};

TEST_F(AbuseTest, MoreIdleConnectionsThanPlacesKeepNobodyOut) {
  const auto silent = open(200, "");
  expect_service();
  const auto half = open(200, "GET / HTTP/1.1\r\nHost: localhost\r\n");
  expect_service();
  EXPECT_GT(server_->counts().refused(Refusal::kNoPlace), 100U) << "400 clients for 256 places";
}

TEST_F(AbuseTest, ConnectionsThatLeaveTakeTheirDescriptorsAlong) {
  const std::size_t before = open_descriptors();
  for (const std::string sends : {"", "GET /large HTTP/1.1\r\nHost: localhost\r\n\r\n", "GET / HTTP/1.1\r\n",
                                  "\r\n\r\n", "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"})
    open(60, sends).clear();
  expect_service();
  EXPECT_TRUE(testing::eventually([&] { return open_descriptors() <= before; }));
}

TEST_F(AbuseTest, AnswersThatNobodyTakesAreBoundedAndOthersAreServed) {
  // Forty answers of 8 MB: more than may wait, so that those who take nothing lose theirs.
  const auto deaf = open(40, "GET /large HTTP/1.1\r\nHost: localhost\r\n\r\n");
  for (int i = 0; i < 5; ++i) EXPECT_EQ(get(port_, "/").body, "fine\n");
  EXPECT_GT(get(port_, "/large").body.size(), kLargeBytes - 1);
  EXPECT_GT(server_->counts().refused(Refusal::kNotTaken), 0U);
}

TEST_F(AbuseTest, ATrickleIsEndedInTimeHoweverSteadyItIs) {
  const HttpClient client(port_);
  const std::string request = "GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(10'000, 'x');
  const auto begin = steady_clock::now();
  std::atomic<bool> ended{false};
  std::thread sender([&] {
    for (std::size_t i = 0; i < request.size() && !ended && client.send(request.substr(i, 1)); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds{5});
  });
  const std::string answer = client.receive();
  ended = true;
  sender.join();
  EXPECT_THAT(answer, AnyOf(Eq(""), StartsWith("HTTP/1.1 408 ")));
  EXPECT_LT(steady_clock::now() - begin, std::chrono::seconds{10}) << "50 s at that pace";
  EXPECT_EQ(server_->counts().refused(Refusal::kTimeout), 1U);
  EXPECT_EQ(server_->counts().answered(408), 1U);
}

TEST_F(AbuseTest, ManyRequestsAtOnceOnOneConnectionAreAnsweredInTurn) {
  std::string all;
  for (int i = 0; i < 50; ++i) all += "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";
  const std::string answers =
      exchange(all + "GET /none HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  std::size_t fine = 0;
  for (std::size_t at = answers.find("fine\n"); at != std::string::npos; at = answers.find("fine\n", at + 1))
    ++fine;
  EXPECT_EQ(fine, 50U);
  EXPECT_TRUE(answers.ends_with("not here\n"));
}

TEST_F(AbuseTest, TooLongARequestIsRefused) {
  const std::string begin = "GET / HTTP/1.1\r\nHost: localhost\r\n";
  EXPECT_THAT(exchange(begin + "X: " + std::string(100'000, 'x') + "\r\n\r\n"), StartsWith("HTTP/1.1 431 "));
  std::string many = begin;
  for (int i = 0; i < 5000; ++i) many += "A: b\r\n";
  EXPECT_THAT(exchange(many + "\r\n"), StartsWith("HTTP/1.1 431 "));
  EXPECT_THAT(exchange("GET /" + std::string(9000, 'a') + " HTTP/1.1\r\n\r\n"), StartsWith("HTTP/1.1 4"));
  expect_service();
}

TEST_F(AbuseTest, ABodyIsNeverReadNorTakenForARequest) {
  const std::string hidden = "GET /large HTTP/1.1\r\nHost: localhost\r\n\r\n";
  for (const std::string& header :
       {"Content-Length: " + std::to_string(hidden.size()),
        std::string("Content-Length: 99999999999999999999"), std::string("Content-Length: -5"),
        std::string("Transfer-Encoding: chunked")}) {
    const std::string answer =
        exchange("GET / HTTP/1.1\r\nHost: localhost\r\n" + header + "\r\n\r\n" + hidden);
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 ") && answer.ends_with("fine\n")) << header << answer.size();
    EXPECT_THAT(answer, HasSubstr("Connection: close"));
  }
  EXPECT_THAT(exchange("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 100000\r\n\r\n" +
                       std::string(100'000, 'x')),
              StartsWith("HTTP/1.1 405 "));
}

TEST_F(AbuseTest, PathsLeadNowhereButToAnswers) {
  for (const std::string path :
       {"/../etc/passwd", "/%2e%2e/etc/passwd", "/..%2f..%2fetc%2fpasswd", "//etc/passwd", "/%00", "/%",
        "/%zz", "/%u0041", "/\x80\xff", "/?a=%00&&&=%"}) {
    const HttpAnswer answer = get(port_, path);
    EXPECT_TRUE(answer.status == 404 || answer.status == 400 || path.starts_with("/?"))
        << path << answer.status;
    EXPECT_THAT(answer.body, Not(HasSubstr("root:")));
  }
  expect_service();
}

TEST_F(AbuseTest, RangesAreNotServed) {
  std::string ranges = "0-";
  while (ranges.size() < 8000) ranges += ",0-";
  const HttpAnswer answer =
      ask(port_, "GET", "/large", "Range: bytes=" + ranges + "\r\nrAnGe: bytes=0-1\r\n");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.body.size(), kLargeBytes);
}

TEST_F(AbuseTest, CompressionIsGzipAlone) {
  const HttpAnswer answer = ask(port_, "GET", "/large", "Accept-Encoding: br, gzip\r\n");
  EXPECT_THAT(answer.headers, HasSubstr("Content-Encoding: gzip"));
  EXPECT_LT(answer.body.size(), kLargeBytes / 100);
  EXPECT_THAT(ask(port_, "GET", "/large", "Accept-Encoding: br\r\n").headers,
              Not(HasSubstr("Content-Encoding")));
}

TEST_F(AbuseTest, EveryAnswerTellsBrowsersToKeepItToItself) {
  for (const std::string path : {"/", "/none"}) {
    const std::string headers = get(port_, path).headers;
    for (const std::string expected :
         {"X-Content-Type-Options: nosniff", "X-Frame-Options: DENY", "Referrer-Policy: no-referrer",
          "Content-Security-Policy: default-src 'none'; frame-ancestors 'none'", "Cache-Control: no-store"})
      EXPECT_THAT(headers, HasSubstr(expected)) << path;
  }
}

TEST_F(AbuseTest, AnAddressThatAsksTooOftenIsTold) {
  Socket listener = listen_on("127.0.0.1", 0);
  const std::uint16_t port = port_of(listener);
  HttpServer strict(std::move(listener), answer_to,
                    HttpOptions{.requests = {.burst = 3.0, .per_second = 1e-3}});
  strict.start();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(get(port, "/").status, 200);
  const HttpAnswer answer = get(port, "/");
  EXPECT_EQ(answer.status, 429);
  EXPECT_THAT(answer.headers, HasSubstr("Retry-After: "));
  EXPECT_EQ(strict.counts().refused(Refusal::kRate), 1U);
  EXPECT_EQ(strict.counts().answered(429), 1U);
  EXPECT_EQ(strict.counts().answered(200), 3U);
}

TEST_F(AbuseTest, AllOfItAtOnce) {
  std::atomic<bool> over = false;
  std::vector<std::thread> bad;
  for (const std::string sends :
       {"", "GET /page HTTP/1.1\r\nHost: localhost\r\n\r\n", "GET / HTTP/1.1\r\nX: ", "\x16\x03\x01\x02",
        "POST / HTTP/1.1\r\nContent-Length: 9\r\n\r\n"})
    bad.emplace_back([&over, this, sends] {
      while (!over) open(40, sends).clear();
    });
  int served = 0;
  const auto begin = steady_clock::now();
  const auto lasted = [&] { return steady_clock::now() - begin; };
  while ((served < 6 || lasted() < std::chrono::seconds{2}) && lasted() < std::chrono::seconds{60})
    served += get(port_, "/").body == "fine\n" ? 1 : 0;
  over = true;
  for (std::thread& each : bad) each.join();
  EXPECT_GE(served, 6) << "others are served meanwhile";
  expect_service();
}

}  // namespace
}  // namespace gyrod::monitor::test
