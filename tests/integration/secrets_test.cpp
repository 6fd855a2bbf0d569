/// Tokens, passwords and keys of a real daemon: nothing that it says holds one, whatever is asked and however wrong.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rig.hpp"
#include "support/eventually.hpp"
#include "unit/monitor/tls_client.hpp"

namespace gyrod::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr const char* kToken = "7f3c5a9e1d2b4860ac97e5d3b1f08642";
constexpr const char* kWrongToken = "7f3c5a9e1d2b4860ac97e5d3b1f0864X";
/// By `openssl passwd -6 -salt abcdefgh 'open sesame'`.
constexpr const char* kHash =
    "$6$abcdefgh$CkjGkP7IIgZVUCNlt.Vi53LOYJLXZ5KzdpzEYCj01XGruA1hxZYJqccTU2zz68oJwAGsd1iPty5F7dHIatUTy/";
/// Basic authentication (RFC 7617): base64 of "anna:open sesame" and "anna:open sesamf".
constexpr const char* kAnna = "YW5uYTpvcGVuIHNlc2FtZQ==";
constexpr const char* kWrongAnna = "YW5uYTpvcGVuIHNlc2FtZg==";
constexpr const char* kShortToken = "tinysecret";
constexpr const char* kPlainPassword = "plainsecret";

class Secrets : public Rig {
 protected:
  Secrets() {
    install("tls.key", pair_.key);
    write_file("tls.pem", pair_.certificate);
    install("token", std::string(kToken) + "\n");
    install("users", std::string("anna:") + kHash + "\n");
  }

  [[nodiscard]] DaemonOptions talkative() const {
    return {.patch = R"({"log": {"level": "trace"}, "monitor": {"tls": {"certificate_file": ")" +
                     path("tls.pem") + R"(", "key_file": ")" + path("tls.key") +
                     R"("}, "auth": {"token_file": ")" + path("token") + R"(", "users_file": ")" +
                     path("users") + R"("}}})"};
  }

  /// As one that renews a file does it.
  void install(const std::string& name, const std::string& text) const {
    write_file("next", text);
    fs::permissions(path("next"), fs::perms::owner_read | fs::perms::owner_write);
    fs::rename(path("next"), path(name));
  }

  /// Each text that is a secret, or would give one away.
  [[nodiscard]] std::vector<std::string> secrets() const {
    std::vector<std::string> all = {kToken,
                                    kWrongToken,
                                    "sesam",
                                    "YW5uYTpvcGVu",
                                    kShortToken,
                                    kPlainPassword,
                                    std::string(kHash).substr(12, 20),
                                    "abcdefgh"};
    for (const std::string& key : {pair_.key, other_.key}) {
      const std::size_t begin = key.find('\n') + 1;
      all.push_back(key.substr(begin, 40));
      all.push_back(key.substr(begin + 65, 40));
    }
    return all;
  }

  void expect_silent(const std::string& text, const std::string& where) const {
    for (const std::string& secret : secrets())
      EXPECT_EQ(text.find(secret), std::string::npos) << where << ": " << text;
  }

  /// All of the answer, headers too.
  static std::string ask(const Process& daemon, const std::string& request) {
    monitor::test::TlsClient client(static_cast<std::uint16_t>(port_of(daemon)));
    (void)client.send(request + "\r\n");
    return client.receive_until({});
  }
  static std::string get(const Process& daemon, const std::string& target, const std::string& header) {
    return ask(daemon,
               "GET " + target + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + header + "\r\n");
  }

  monitor::test::PemPair pair_ = monitor::test::make_certificate("gyrod");
  monitor::test::PemPair other_ = monitor::test::make_certificate("other");
  std::string bearer_ = std::string("Authorization: Bearer ") + kToken + "\r\n";
  std::string basic_ = std::string("Authorization: Basic ") + kAnna + "\r\n";
};

TEST_F(Secrets, ReachNeitherLogNorMetricsNorConfigurationNorAnswers) {
  const auto daemon = start_daemon(talkative());
  const std::string token = kToken;
  for (const std::string& wrong :
       {"Authorization: Bearer " + std::string(kWrongToken),
        "Authorization: Basic " + std::string(kWrongAnna), "Authorization: " + token,
        "Authorization: Digest " + token, "Authorization: Basic " + token, "X-Api-Key: " + token,
        "Cookie: token=" + token, "Proxy-Authorization: Bearer " + token}) {
    const std::string answer = get(*daemon, "/api/v1/status", wrong + "\r\n");
    EXPECT_THAT(answer, HasSubstr("HTTP/1.1 401 ")) << wrong;
    expect_silent(answer, wrong);
  }
  for (const std::string& target :
       {"/metrics?token=" + token, "/" + token, "/api/v1/" + token, "/api/v1/channels/" + token,
        std::string("https://anna:open%20sesame@localhost/metrics")})
    expect_silent(get(*daemon, target, ""), target);
  for (const std::string& request :
       {token + "\r\n",
        "POST /?token=" + token + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + bearer_,
        "GET / HTTP/1.1\r\nAuthorization: Bearer " + token + std::string(20'000, 'x') + "\r\n",
        "GET /" + token + std::string(9'000, 'x') + " HTTP/1.1\r\n"})
    expect_silent(ask(*daemon, request), request.substr(0, 60));
  for (const std::string& known : {bearer_, basic_}) {
    for (const std::string target : {"/", "/metrics", "/readyz", "/api/v1/status", "/api/v1/config",
                                     "/api/v1/channels", "/api/v1/events"}) {
      const std::string answer = get(*daemon, target, known);
      EXPECT_THAT(answer, HasSubstr("HTTP/1.1 200 ")) << target;
      expect_silent(answer, target);
    }
    const std::string refused = get(*daemon, "/api/v1/status?access_token=" + token, known);
    EXPECT_THAT(refused, HasSubstr("HTTP/1.1 400 "));
    expect_silent(refused, "a wrong query");
    // What a path names is told to who named it, and to nobody else: see the log below.
    EXPECT_THAT(get(*daemon, "/api/v1/channels/" + token, known), HasSubstr("HTTP/1.1 404 "));
  }

  EXPECT_THAT(get(*daemon, "/api/v1/config", bearer_), HasSubstr("\"trace\"")) << "as talkative as can be";

  install("token", std::string(kShortToken) + "\n");
  install("users", std::string("anna:") + kPlainPassword + "\n");
  install("tls.key", other_.key);
  const auto log_tells = [&](const std::string& words) {
    return eventually([&] {
      (void)get(*daemon, "/metrics", bearer_);
      return daemon->err().find(words) != std::string::npos;
    });
  };
  EXPECT_TRUE(log_tells("a token of less than 16 characters"));
  install("token", std::string(kToken) + "\n");
  EXPECT_TRUE(log_tells("has no salted slow hash"));
  EXPECT_TRUE(log_tells("does not belong to the certificate"));
  EXPECT_TRUE(log_tells("wrong credentials from 127.0.0.1"));
  for (const std::string target : {"/metrics", "/api/v1/config", "/api/v1/events"})
    expect_silent(get(*daemon, target, bearer_), target);
  EXPECT_EQ(stop_daemon(*daemon), 0);
  expect_silent(daemon->err(), "the log");
  expect_silent(daemon->out(), "standard output");
}

TEST_F(Secrets, AreNotInWhatIsSaidOfFilesThatAreNoGood) {
  write_config(talkative());
  EXPECT_EQ(run({"validate", config()}).exit_code, 0);
  const auto refusal = [&](const std::string& words) {
    const Result validated = run({"validate", config()});
    const Result started = run({"run", "--config", config()});
    for (const Result& result : {validated, started}) {
      EXPECT_NE(result.exit_code, 0);
      EXPECT_THAT(result.out + result.err, HasSubstr(words));
      expect_silent(result.out + result.err, words);
    }
  };
  install("tls.key", other_.key);
  refusal("does not belong to the certificate");
  install("tls.key", pair_.key);
  install("users", std::string("anna:") + kPlainPassword + "\n");
  refusal("has no salted slow hash");
  install("users", std::string("anna:") + kHash + "\n");
  install("token", std::string(kShortToken) + "\n");
  refusal("a token of less than 16 characters");
}

}  // namespace
}  // namespace gyrod::testing
