/// Event streams from outside: what a client is sent, and that none costs the others anything.
#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monitor/http_server.hpp"
#include "support/eventually.hpp"
#include "unit/monitor/http_client.hpp"

namespace gyrod::monitor::test {
namespace {

using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// What the sources of a test have in common.
struct Counters {
  std::atomic<int> alive{0};
  std::atomic<int> asked{0};
};

/// Says `text` each time that it is asked.
class Repeating final : public EventSource {
 public:
  Repeating(Counters& counters, std::string text) : counters_(counters), text_(std::move(text)) {
    ++counters_.alive;
  }
  ~Repeating() override { --counters_.alive; }
  void append(std::string& text) override {
    ++counters_.asked;
    if (text_ == "throw") throw std::runtime_error("no more");
    text += text_ == "counted" ? "data: " + std::to_string(++said_) + "\n\n" : text_;
  }

 private:
  Counters& counters_;
  std::string text_;
  int said_ = 0;
};

class StreamTest : public ::testing::Test {
 protected:
  /// /api/v1/... is a stream, /huge one of a megabyte each time, anything else text.
  void start() {
    Socket listener = listen_on("127.0.0.1", 0);
    port_ = port_of(listener);
    server_ = std::make_unique<HttpServer>(
        std::move(listener), [this](const Request& request) { return answer(request); },
        HttpOptions{.streams = options_});
    server_->start();
  }

  [[nodiscard]] Answer answer(const Request& request) {
    if (request.path == "/text") return {.body = "text\n"};
    const std::string said = request.path == "/huge"      ? std::string(std::size_t{1} << 20U, '.')
                             : request.path == "/throw"   ? "throw"
                             : request.path == "/counted" ? "counted"
                             : request.path == "/quiet"   ? ""
                                                          : "data: x\n\n";
    return {.content_type = "text/event-stream",
            .body = "retry: 2000\n\n",
            .events = std::make_unique<Repeating>(counters_, said)};
  }

  [[nodiscard]] std::unique_ptr<HttpClient> open(const std::string& path) const {
    auto client = std::make_unique<HttpClient>(port_);
    EXPECT_TRUE(client->send("GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n"));
    return client;
  }

  [[nodiscard]] bool come_to(const std::atomic<int>& count, int value) const {
    return testing::eventually([&] { return count == value; });
  }

  StreamOptions options_{.ask_every = milliseconds{2}};
  Counters counters_;  // outlives the server
  std::uint16_t port_ = 0;
  std::unique_ptr<HttpServer> server_;
};

TEST_F(StreamTest, TheAnswersBodyComesFirstThenWhatTheSourceSays) {
  start();
  const std::string text = open("/api/v1/stream")->receive_until("data: x\n\ndata: x\n\n");
  EXPECT_THAT(text, AllOf(HasSubstr("HTTP/1.1 200 OK\r\n"), HasSubstr("Content-Type: text/event-stream\r\n"),
                          HasSubstr("Cache-Control: no-store\r\n"), HasSubstr("X-Accel-Buffering: no\r\n"),
                          HasSubstr("\r\n\r\nretry: 2000\n\ndata: x\n\n"), Not(HasSubstr("Content-Length"))));
}

TEST_F(StreamTest, HeadGivesTheHeadersAndNoStream) {
  start();
  const HttpAnswer head = ask(port_, "HEAD", "/api/v1/stream");
  EXPECT_EQ(head.status, 200);
  EXPECT_THAT(head.headers, HasSubstr("text/event-stream"));
  EXPECT_EQ(head.body, "");
  EXPECT_EQ(counters_.asked, 0);
  EXPECT_TRUE(come_to(counters_.alive, 0));
}

TEST_F(StreamTest, AClientThatLeavesIsNoticed) {
  start();
  auto client = open("/quiet");
  ASSERT_TRUE(come_to(counters_.alive, 1));
  client.reset();
  EXPECT_TRUE(come_to(counters_.alive, 0));
}

TEST_F(StreamTest, WhereNothingIsNewACommentKeepsTheStreamAlive) {
  options_.keep_alive = milliseconds{5};
  start();
  EXPECT_THAT(open("/quiet")->receive_until(": keep-alive\n\n: keep-alive\n\n"), HasSubstr(": keep-alive"));
}

TEST_F(StreamTest, ASourceIsAskedOnlyOnceItsClientHasTakenAll) {
  options_.patience = milliseconds{60'000};
  start();
  const auto deaf = open("/huge");
  // A reading client beside it is the clock: it is asked for hundreds of times while the deaf one's buffers, a few
  // megabytes in all, fill up.
  ASSERT_TRUE(testing::eventually([&] { return counters_.asked > 0; }));
  const auto reader = open("/api/v1/stream");
  std::string seen;
  while (seen.size() < 3'000) seen += reader->receive_until("data: x\n\n");
  const int asked = counters_.asked;
  const int said = static_cast<int>(seen.size() / std::string_view("data: x\n\n").size());
  EXPECT_LT(asked - said, 32);
}

TEST_F(StreamTest, AClientThatTakesNothingIsDropped) {
  options_.patience = milliseconds{50};
  start();
  const auto deaf = open("/huge");
  ASSERT_TRUE(testing::eventually([&] { return counters_.asked > 0; }));
  EXPECT_TRUE(come_to(counters_.alive, 0));
}

TEST_F(StreamTest, AllPlacesTakenIsSaidAndAPlaceIsGivenBack) {
  options_.max_streams = 2;
  start();
  auto first = open("/quiet");
  const auto second = open("/quiet");
  ASSERT_TRUE(come_to(counters_.alive, 2));
  const HttpAnswer refused = get(port_, "/api/v1/stream");
  EXPECT_EQ(refused.status, 503);
  EXPECT_THAT(refused.headers, AllOf(HasSubstr("Retry-After: "), HasSubstr("application/json")));
  EXPECT_THAT(refused.body, HasSubstr("{\"error\":\"as many event streams"));
  EXPECT_EQ(server_->counts().refused(Refusal::kStreams), 1U);
  EXPECT_EQ(server_->counts().answered(503), 1U);
  EXPECT_EQ(server_->counts().answered(200), 2U) << "the streams that are open";
  EXPECT_EQ(get(port_, "/text").status, 200);
  first.reset();
  ASSERT_TRUE(come_to(counters_.alive, 1));
  EXPECT_THAT(open("/api/v1/stream")->receive_until("data"), HasSubstr(" 200 "));
}

TEST_F(StreamTest, ASourceThatFailsEndsItsStreamAlone) {
  start();
  const auto good = open("/api/v1/stream");
  EXPECT_THAT(open("/throw")->receive(), HasSubstr("retry"));
  (void)good->receive_until("data: x\n\ndata: x\n\n");
  EXPECT_EQ(counters_.alive, 1);
}

TEST_F(StreamTest, AClientThatTalksIntoItsStreamIsDropped) {
  start();
  const auto client = open("/quiet");
  ASSERT_TRUE(come_to(counters_.alive, 1));
  (void)client->send(std::string(100'000, 'x'));
  EXPECT_TRUE(come_to(counters_.alive, 0));
}

TEST_F(StreamTest, ASourceHasTheLastWord) {
  options_.ask_every = std::chrono::minutes{10};
  start();
  const auto client = open("/counted");
  (void)client->receive_until("data: 1\n\n");
  server_->stop();
  EXPECT_THAT(client->receive(), HasSubstr("data: 2\n\n"));
}

TEST_F(StreamTest, StopEndsAllStreams) {
  start();
  std::vector<std::unique_ptr<HttpClient>> clients;
  for (const std::string path : {"/quiet", "/huge", "/api/v1/stream"}) clients.push_back(open(path));
  ASSERT_TRUE(come_to(counters_.alive, 3));
  const auto begin = std::chrono::steady_clock::now();
  server_->stop();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds{5});
  EXPECT_EQ(counters_.alive, 0);
}

}  // namespace
}  // namespace gyrod::monitor::test
