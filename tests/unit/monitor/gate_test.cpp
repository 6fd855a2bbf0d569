/// Who is let in: without sockets, at times of the test's own.
#include "monitor/gate.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"

namespace gyrod::monitor::test {
namespace {

using std::chrono::seconds;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Pair;
using ::testing::StartsWith;

constexpr const char* kToken = "0123456789abcdef0123456789abcdef";
/// Basic authentication (RFC 7617): base64 of "anna:open sesame".
constexpr const char* kAnna = "Basic YW5uYTpvcGVuIHNlc2FtZQ==";
/// By `openssl passwd -6 -salt abcdefgh 'open sesame'`.
constexpr const char* kHash =
    "$6$abcdefgh$CkjGkP7IIgZVUCNlt.Vi53LOYJLXZ5KzdpzEYCj01XGruA1hxZYJqccTU2zz68oJwAGsd1iPty5F7dHIatUTy/";

class GateTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string secret(const std::string& name, const std::string& text) const {
    std::string path = folder_.write(name, text);
    std::filesystem::permissions(path,
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    return path;
  }
  [[nodiscard]] std::string token_file() const { return secret("token", std::string(kToken) + "\n"); }
  [[nodiscard]] std::string users_file() const {
    return secret("users", std::string("anna:") + kHash + "\n");
  }

  [[nodiscard]] Gate gate(const AccessOptions& options, const std::string& address = "127.0.0.1") {
    return {options, address, [this](Tone tone, const std::string& line) {
              log_.push_back((tone == Tone::kTrouble ? "! " : "") + line);
            }};
  }

  /// Status of the refusal; 200: let in.
  [[nodiscard]] static int ask(Gate& gate, const std::string& authorization, seconds at = seconds{1000},
                               const std::string& path = "/metrics",
                               const std::string& address = "10.0.0.5") {
    const auto refused = gate.refuse(
        {.path = path, .host = "gyrod.lan:9464", .authorization = authorization, .address = address},
        RateLimit::Time(at));
    return refused ? refused->status : 200;
  }

  /// The reason under which it is counted.
  [[nodiscard]] static std::optional<Refusal> why(Gate& gate, const std::string& authorization) {
    const auto refused =
        gate.refuse({.path = "/", .host = "", .authorization = authorization, .address = "10.0.0.5"},
                    RateLimit::Time(seconds{1000}));
    return refused ? refused->refusal : std::nullopt;
  }

  [[nodiscard]] static std::string trouble_of(const AccessOptions& options) {
    try {
      check_access(options, FileOwner::kThisUser);
    } catch (const AccessError& error) {
      return error.what();
    }
    return "none";
  }

  testing::ScratchFolder folder_;
  std::vector<std::string> log_;
};

TEST_F(GateTest, OnThisMachineAloneOnlyItsOwnNamesAreAnswered) {
  Gate local = gate({});
  const auto status = [&](const std::string& host) {
    const auto refused = local.refuse(
        {.path = "/metrics", .host = host, .authorization = "", .address = "127.0.0.1"}, RateLimit::Time{});
    return refused ? refused->status : 200;
  };
  for (const std::string host : {"localhost", "LocalHost:9464", "127.0.0.1:9464", "[::1]:9464", "[::1]", ""})
    EXPECT_EQ(status(host), 200) << host;
  for (const std::string host : {"evil.example", "evil.example:9464", "localhost.evil.example",
                                 "127.0.0.1.evil.example", "[::2]", "[", ":", "10.0.0.1"})
    EXPECT_EQ(status(host), 403) << host;
  EXPECT_EQ(status("rack7"), 403);
  EXPECT_FALSE(
      gate({}, "0.0.0.0").refuse({.path = "/", .host = "rack7", .authorization = "", .address = ""}, {}))
      << "on purpose open to others, by names that gyrod does not know";
}

TEST_F(GateTest, ATokenOfTheFileIsLetIn) {
  Gate asks = gate({.token_file = token_file()});
  EXPECT_EQ(ask(asks, std::string("Bearer ") + kToken), 200);
  EXPECT_EQ(ask(asks, std::string("bearer ") + kToken), 200) << "schemes have no case (RFC 9110)";
  for (const std::string wrong : {"", "Bearer", "Bearer ", "Bearer 0123456789abcdef0123456789abcdee",
                                  "Bearer 0123456789abcdef", "0123456789abcdef0123456789abcdef", kAnna})
    EXPECT_EQ(ask(asks, wrong), 401) << wrong;
}

TEST_F(GateTest, AUserWithItsPasswordIsLetInAndNobodyElse) {
  Gate asks = gate({.users_file = users_file()});
  EXPECT_EQ(ask(asks, kAnna), 200);
  EXPECT_EQ(ask(asks, kAnna), 200) << "remembered";
  // "anna:open sesamf", "anna:", "bert:open sesame", no colon, no base64.
  for (const std::string wrong : {"Basic YW5uYTpvcGVuIHNlc2FtZg==", "Basic YW5uYTo=",
                                  "Basic YmVydDpvcGVuIHNlc2FtZQ==", "Basic YW5uYQ==", "Basic !!!!", "Basic "})
    EXPECT_EQ(ask(asks, wrong), 401) << wrong;
}

TEST_F(GateTest, WhoIsNotKnownIsToldHowToSayIt) {
  const auto challenge = [this](const AccessOptions& options) {
    Gate asks = gate(options);
    return asks.refuse({.path = "/api/v1/status", .host = "", .authorization = "", .address = ""}, {})
        .value();
  };
  const Answer basic = challenge({.token_file = token_file(), .users_file = users_file()});
  EXPECT_THAT(basic.headers, Contains(Pair("WWW-Authenticate", HasSubstr("Basic realm=\"gyrod\""))));
  EXPECT_EQ(basic.content_type, "application/json");
  EXPECT_THAT(challenge({.token_file = token_file()}).headers,
              Contains(Pair("WWW-Authenticate", HasSubstr("Bearer"))));
}

TEST_F(GateTest, HealthIsToldToEveryone) {
  Gate asks = gate({.token_file = token_file()});
  EXPECT_EQ(ask(asks, "", seconds{1}, "/healthz"), 200);
  EXPECT_EQ(ask(asks, "", seconds{1}, "/readyz"), 401);
}

TEST_F(GateTest, GuessingIsSlowAndCostsOthersNothing) {
  Gate asks = gate({.token_file = token_file(), .users_file = users_file()});
  const std::string wrong = "Basic YW5uYTo=";
  for (int i = 0; i < 10; ++i) EXPECT_EQ(ask(asks, wrong), 401);
  EXPECT_EQ(ask(asks, wrong), 429);
  EXPECT_EQ(ask(asks, kAnna), 429) << "nor is a right guess told from a wrong one";
  EXPECT_EQ(ask(asks, std::string("Bearer ") + kToken), 200) << "which nobody guesses";
  EXPECT_EQ(ask(asks, kAnna, seconds{1000}, "/", "10.0.0.6"), 200);
  EXPECT_EQ(ask(asks, kAnna, seconds{1002}), 200);
}

TEST_F(GateTest, GuessingIsCountedApartFromWhoBeginsAsABrowserDoes) {
  Gate asks = gate({.token_file = token_file(), .users_file = users_file()});
  EXPECT_EQ(why(asks, ""), Refusal::kNoCredentials);
  EXPECT_EQ(why(asks, "Bearer a-wrong-token-of-some-length"), Refusal::kWrongCredentials);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(why(asks, "Basic YW5uYTo="), Refusal::kWrongCredentials);
  EXPECT_EQ(why(asks, kAnna), Refusal::kGuessing);
  EXPECT_EQ(why(asks, std::string("Bearer ") + kToken), std::nullopt);
  Gate local = gate({});
  const auto rebound =
      local.refuse({.path = "/", .host = "evil.example", .authorization = "", .address = ""}, {});
  EXPECT_EQ(rebound.value().refusal, Refusal::kHost);
}

TEST_F(GateTest, FilesThatChangeAreReadAgainAndBadOnesChangeNothing) {
  Gate asks = gate({.token_file = token_file()});
  const std::string old = std::string("Bearer ") + kToken;
  EXPECT_EQ(ask(asks, old, seconds{1}), 200);
  (void)secret("next", "# since Monday\nfedcba9876543210fedcba9876543210\r\n");
  std::filesystem::rename(folder_.path("next"), folder_.path("token"));
  EXPECT_EQ(ask(asks, old, seconds{3}), 401);
  EXPECT_EQ(ask(asks, "Bearer fedcba9876543210fedcba9876543210", seconds{3}), 200);
  EXPECT_THAT(log_, Contains("monitor.auth: '" + folder_.path("token") + "' has changed and was read again"));
  (void)secret("next", "short\n");
  std::filesystem::rename(folder_.path("next"), folder_.path("token"));
  EXPECT_EQ(ask(asks, "Bearer fedcba9876543210fedcba9876543210", seconds{5}), 200);
  EXPECT_THAT(log_, Contains(AllOf(StartsWith("! "), HasSubstr("line 1: a token of less than 16 characters"),
                                   HasSubstr("stays in force"), Not(HasSubstr("short")))));
}

TEST_F(GateTest, TheLogTellsWhoFailsAndNeverASecret) {
  Gate asks = gate({.token_file = token_file(), .users_file = users_file()});
  for (int i = 0; i < 20; ++i) (void)ask(asks, "Basic YW5uYTpvcGVuIHNlc2FtZg==");
  (void)ask(asks, "Bearer a-wrong-token-of-some-length");
  ASSERT_EQ(log_.size(), 1U) << "once a minute";
  EXPECT_THAT(log_.front(), AllOf(HasSubstr("10.0.0.5"), Not(HasSubstr("sesam")), Not(HasSubstr("YW5u")),
                                  Not(HasSubstr("wrong-token"))));
}

TEST_F(GateTest, FilesThatOthersMayReadAreRefusedByName) {
  const std::string token = token_file();
  std::filesystem::permissions(token, std::filesystem::perms::group_read, std::filesystem::perm_options::add);
  EXPECT_EQ(trouble_of({.token_file = token}),
            "'" + token + "': its mode is 0640: others than its owner may use it; expected 0600 or 0400");
  EXPECT_THAT(trouble_of({.token_file = folder_.path("none")}),
              HasSubstr("none': cannot be read: No such file"));
  EXPECT_THAT(trouble_of({.users_file = folder_.path().string()}), HasSubstr("': "));
}

TEST_F(GateTest, FilesThatHoldNothingUsefulAreRefusedByLine) {
  EXPECT_THAT(trouble_of({.token_file = secret("t", "\n# none\n")}),
              HasSubstr("holds no token; expected one a line"));
  EXPECT_THAT(trouble_of({.token_file = secret("t", "\nshort\n")}),
              AllOf(HasSubstr("line 2: a token of less than 16"), HasSubstr("openssl rand -hex 32")));
  EXPECT_THAT(trouble_of({.users_file = secret("u", "anna\n")}),
              AllOf(HasSubstr("line 1: no user"), HasSubstr("NAME:HASH")));
  // Unsalted, fast, or plain text: nothing of it in the message.
  for (const std::string hash : {"{SHA}nU4eI71bcnBGqeO0t9tXvY1u5oQ=", "$apr1$abcdefgh$xyz", "$1$abcdefgh$xyz",
                                 "open sesame", "", "$6$"}) {
    EXPECT_THAT(trouble_of({.users_file = secret("u", "anna:" + hash + "\n")}),
                AllOf(HasSubstr("line 1: user 'anna' has no salted slow hash"), Not(HasSubstr("sesame"))))
        << hash;
  }
  const std::string line = std::string("anna:") + kHash + "\n";
  EXPECT_THAT(trouble_of({.users_file = secret("u", line + line)}),
              HasSubstr("line 2: user 'anna' is there twice"));
}

TEST(RateLimit, ABucketEmptiesAndFillsAgain) {
  RateLimit limit({.burst = 2.0, .per_second = 1.0});
  const auto at = [](int s) { return RateLimit::Time(seconds{s}); };
  EXPECT_TRUE(limit.take("a", at(10)));
  EXPECT_TRUE(limit.take("a", at(10)));
  EXPECT_FALSE(limit.take("a", at(10)));
  EXPECT_TRUE(limit.take("b", at(10)));
  EXPECT_TRUE(limit.take("a", at(11)));
  EXPECT_FALSE(limit.take("a", at(11)));
  EXPECT_FALSE(limit.take("a", at(5))) << "time does not go back";
  EXPECT_TRUE(limit.take("a", at(1000)));
  EXPECT_TRUE(limit.take("a", at(1000)));
  EXPECT_FALSE(limit.take("a", at(1000)));
}

TEST(RateLimit, AddressesBeyondTheTableShareABucketUntilOthersAreFullAgain) {
  RateLimit limit({.burst = 1.0, .per_second = 0.1, .max_addresses = 2});
  const auto at = [](int s) { return RateLimit::Time(seconds{s}); };
  EXPECT_TRUE(limit.take("a", at(10)));
  EXPECT_TRUE(limit.take("b", at(10)));
  EXPECT_TRUE(limit.take("c", at(10)));
  EXPECT_FALSE(limit.take("d", at(10)));
  EXPECT_FALSE(limit.allows("e", at(10)));
  EXPECT_TRUE(limit.take("d", at(30))) << "a and b are forgotten";
  EXPECT_TRUE(limit.take("e", at(30)));
}

}  // namespace
}  // namespace gyrod::monitor::test
