#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "settings/load.hpp"

namespace gyrod::settings {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> messages(const std::string& monitor) {
  std::vector<std::string> lines;
  for (const SettingsIssue& issue : read_settings("{\"monitor\": " + monitor + "}", ".").issues)
    lines.push_back(issue.message);
  return lines;
}

constexpr const char* kTls = R"("tls": {"certificate_file": "c", "key_file": "k"})";
constexpr const char* kAuth = R"("auth": {"token_file": "t"})";

TEST(MonitorSettings, AnAddressThatOthersReachNeedsTlsAndNames) {
  const std::string open = R"("address": "0.0.0.0")";
  const auto refused =
      ElementsAre(HasSubstr("monitor.address is \"0.0.0.0\"; expected one of this machine alone"));
  EXPECT_THAT(messages("{" + open + "}"), refused);
  EXPECT_THAT(messages("{" + open + ", " + kTls + "}"), refused);
  EXPECT_THAT(messages("{" + open + ", " + kAuth + "}"), refused);
  EXPECT_THAT(messages(R"({"address": "::"})"), ElementsAre(HasSubstr("monitor.allow_insecure: true")));
  EXPECT_THAT(messages("{" + open + ", " + kTls + ", " + kAuth + "}"), IsEmpty());
  EXPECT_THAT(messages("{" + open + ", " + kTls + R"(, "auth": {"users_file": "u"}})"), IsEmpty());
  EXPECT_THAT(messages("{" + open + R"(, "allow_insecure": true})"), IsEmpty());
  EXPECT_THAT(messages("{" + open + R"(, "enabled": false})"), IsEmpty());
}

TEST(MonitorSettings, AnAddressOfThisMachineNeedsNothingAndMayHaveEither) {
  for (const std::string address : {"127.0.0.1", "127.0.0.2", "localhost", "::1"})
    EXPECT_THAT(messages(R"({"address": ")" + address + "\"}"), IsEmpty()) << address;
  EXPECT_THAT(messages("{" + std::string(kAuth) + "}"), IsEmpty());
  EXPECT_THAT(messages("{" + std::string(kTls) + "}"), IsEmpty());
}

TEST(MonitorSettings, ACertificateAndItsKeyComeTogether) {
  EXPECT_THAT(messages(R"({"tls": {"certificate_file": "c"}})"),
              ElementsAre(HasSubstr("monitor.tls.key_file is \"\"")));
  EXPECT_THAT(messages(R"({"tls": {"key_file": "k"}})"),
              ElementsAre(HasSubstr("monitor.tls.certificate_file is \"\"")));
}

TEST(MonitorSettings, PathsAreRelativeToTheFile) {
  const Outcome outcome = read_settings(
      "{\"monitor\": {" + std::string(kTls) + R"(, "auth": {"users_file": "/etc/u"}}})", "/srv");
  EXPECT_EQ(outcome.settings.monitor.tls.certificate_file, "/srv/c");
  EXPECT_EQ(outcome.settings.monitor.tls.key_file, "/srv/k");
  EXPECT_EQ(outcome.settings.monitor.auth.users_file, "/etc/u");
  EXPECT_EQ(outcome.settings.monitor.auth.token_file, "") << "none stays none";
}

}  // namespace
}  // namespace gyrod::settings
