/// The port with TLS, from outside.
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monitor/http_server.hpp"
#include "support/eventually.hpp"
#include "support/scratch_folder.hpp"
#include "unit/monitor/tls_client.hpp"

namespace gyrod::monitor::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class Ticking final : public EventSource {
 public:
  void append(std::string& text) override { text += "data: tick\n\n"; }
};

Answer answer_to(const Request& request) {
  if (request.path == "/stream")
    return {.content_type = "text/event-stream", .events = std::make_unique<Ticking>()};
  return {.body = std::string(request.path == "/large" ? 3'000'000 : 5, 'a')};
}

class TlsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    install(make_certificate("first"));
    Socket listener = listen_on("127.0.0.1", 0);
    port_ = port_of(listener);
    server_ = std::make_unique<HttpServer>(
        std::move(listener), answer_to,
        HttpOptions{
            .access = {.certificate_file = folder_.path("tls.pem"), .key_file = folder_.path("tls.key")},
            .streams = {.ask_every = std::chrono::milliseconds{2}},
            .tell = [this](Tone tone, const std::string& line) { hear(tone, line); }});
    server_->start();
  }

  void install(const PemPair& pair) const {
    (void)write_key("next.key", pair.key);
    (void)folder_.write("next.pem", pair.certificate);
    std::filesystem::rename(folder_.path("next.pem"), folder_.path("tls.pem"));
    std::filesystem::rename(folder_.path("next.key"), folder_.path("tls.key"));
  }

  [[nodiscard]] std::string write_key(const std::string& name, const std::string& text) const {
    std::string path = folder_.write(name, text);
    std::filesystem::permissions(path,
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    return path;
  }

  [[nodiscard]] static std::string trouble_of(const std::string& certificate, const std::string& key) {
    try {
      (void)make_tls(certificate, key, FileOwner::kThisUser);
    } catch (const AccessError& error) {
      return error.what();
    }
    return "none";
  }

  void hear(Tone tone, const std::string& line) {
    const std::scoped_lock lock(mutex_);
    log_ += (tone == Tone::kTrouble ? "! " : "") + line + "\n";
  }
  [[nodiscard]] std::string log() {
    const std::scoped_lock lock(mutex_);
    return log_;
  }

  std::mutex mutex_;
  std::string log_;  ///< guarded by the mutex
  testing::ScratchFolder folder_;
  std::uint16_t port_ = 0;
  std::unique_ptr<HttpServer> server_;
};

TEST_F(TlsTest, AnswersComeThroughItLargeOnesToo) {
  EXPECT_THAT(TlsClient(port_).get("/"), AllOf(HasSubstr("HTTP/1.1 200 OK"), HasSubstr("\r\n\r\naaaaa")));
  EXPECT_GT(TlsClient(port_).get("/large").size(), 3'000'000U);
}

TEST_F(TlsTest, ManyRequestsOnOneConnection) {
  TlsClient client(port_);
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(client.send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"));
    ASSERT_THAT(client.receive_until("\r\n\r\naaaaa"), HasSubstr(" 200 ")) << i;
  }
}

TEST_F(TlsTest, EventStreamsComeThroughIt) {
  TlsClient client(port_);
  ASSERT_TRUE(client.send("GET /stream HTTP/1.1\r\nHost: localhost\r\n\r\n"));
  EXPECT_THAT(client.receive_until("data: tick\n\ndata: tick\n\n"), HasSubstr("text/event-stream"));
}

TEST_F(TlsTest, VersionsBelow12AreRefused) {
  EXPECT_TRUE(TlsClient(port_, TLS1_2_VERSION).connected());
  EXPECT_FALSE(TlsClient(port_, TLS1_1_VERSION).connected());
}

TEST_F(TlsTest, PlainRequestsAndGarbageAreClosedAndTheNextClientIsServed) {
  for (const std::string& garbage :
       {std::string("GET / HTTP/1.1\r\n\r\n"), std::string("\x16\x03\x01\xff\xff") + std::string(70'000, 'x'),
        std::string(200, '\0')}) {
    const HttpClient client(port_);
    (void)client.send(garbage);
    (void)client.receive();
  }
  EXPECT_THAT(TlsClient(port_).get("/"), HasSubstr(" 200 "));
  EXPECT_EQ(server_->counts().refused(Refusal::kTls), 3U);
}

TEST_F(TlsTest, AHalfOpenHandshakeIsEndedAndHoldsNobodyUp) {
  const HttpClient half(port_);
  ASSERT_TRUE(half.send(std::string("\x16\x03\x01\x02", 4)));
  EXPECT_THAT(TlsClient(port_).get("/"), HasSubstr(" 200 "));
  EXPECT_EQ(half.receive(), "");
  EXPECT_EQ(server_->counts().refused(Refusal::kTls), 1U);
}

TEST_F(TlsTest, ANewCertificateIsUsedWithoutARestartAndABadOneIsNot) {
  EXPECT_EQ(TlsClient(port_).server(), "first");
  install(make_certificate("second"));
  EXPECT_TRUE(testing::eventually([&] { return TlsClient(port_).server() == "second"; }));
  EXPECT_THAT(log(), HasSubstr("monitor.tls: a new certificate was read"));
  install({make_certificate("third").certificate, make_certificate("other").key});
  EXPECT_TRUE(testing::eventually([&] { return TlsClient(port_).server() == "second"; }));
}

TEST_F(TlsTest, FilesThatAreNoGoodAreNamed) {
  const PemPair good = make_certificate("good");
  const std::string certificate = folder_.write("c.pem", good.certificate);
  const std::string key = write_key("c.key", good.key);
  EXPECT_EQ(trouble_of(certificate, key), "none");
  EXPECT_THAT(trouble_of(folder_.path("none"), key), HasSubstr("none': cannot be read"));
  EXPECT_THAT(trouble_of(key, key),
              AllOf(HasSubstr("c.key': no certificate"), HasSubstr("expected one in PEM")));
  EXPECT_THAT(trouble_of(certificate, certificate), HasSubstr("c.pem': its mode is 0"));
  EXPECT_THAT(trouble_of(certificate, folder_.path("tls.key")),
              HasSubstr("tls.key': does not belong to the certificate in '" + certificate));
  EXPECT_THAT(trouble_of(folder_.write("old.pem", make_certificate("old", -1).certificate), key),
              HasSubstr("the certificate has expired"));
}

}  // namespace
}  // namespace gyrod::monitor::test
