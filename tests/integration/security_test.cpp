// DDS Security: who is let in, who is not and how that is said, and what the wire shows.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <openssl/evp.h>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bus/domain.hpp"
#include "rig.hpp"
#include "support/eventually.hpp"
#include "support/imu_node.hpp"
#include "support/security_folder.hpp"
#include "support/wire_capture.hpp"

namespace gyrod::testing {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr const char* kPlain = "plain.json";  ///< a configuration on the same domain, without security

class Security : public Rig {
 protected:
  static void SetUpTestSuite() { made_ = std::make_unique<SecurityFolder>(); }
  static void TearDownTestSuite() { made_.reset(); }

  Security() { write_config({}, kPlain); }

  /// A daemon's configuration with the files of a program.
  static DaemonOptions secured(const std::string& folder) {
    return {.patch = R"({"bus": {"ros2": {"topics": ["rt/imu/data_raw"]}, "security": {"folder": ")" +
                     folder + R"("}}})"};
  }
  std::unique_ptr<Process> start_secured(const std::string& program = "gyrod") {
    return start_daemon(secured(made_->of(program)));
  }
  /// `gyrod simulate` as this program; none: without security.
  Result simulate(const std::optional<std::string>& folder, std::vector<std::string> arguments = {}) {
    std::vector<std::string> all = {"simulate", "--config",  path(kPlain), "--speed",
                                    "max",      "--samples", "500"};
    if (folder) all.insert(all.end(), {"--security", *folder});
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run(all);
  }
  static double count(const Process& daemon, const std::string& series) {
    return metric(daemon, series).value_or(-1.0);
  }

  /// What both a secret and an open run do: one of gyrod's sensors, one of ROS 2, and one who records.
  void drive(Process& daemon, const std::string& sensor_folder, const std::string& reader_folder);

  static std::unique_ptr<SecurityFolder> made_;
};
std::unique_ptr<SecurityFolder> Security::made_;

constexpr const char* kSensorId = "imu-of-the-prototype";
constexpr const char* kFrameId = "frame-of-the-prototype";

/// What RTPS sends along with a sample of this sensor where it is not encrypted: MD5 of the key as CDR, big endian (RTPS 2.3,
/// 9.6.3.8). Whoever guesses an id can check the guess with it.
std::string key_hash_of(const std::string& sensor) {
  const auto length = static_cast<char>(sensor.size() + 1);
  const std::string key = std::string(3, '\0') + length + sensor + '\0';
  std::string hash(16, '\0');
  EVP_Digest(key.data(), key.size(), reinterpret_cast<unsigned char*>(hash.data()), nullptr, EVP_md5(),
             nullptr);
  return hash;
}

/// The governance of the templates with some of it replaced.
std::string governance_with(std::vector<std::pair<std::string, std::string>> changes) {
  std::string text = security_template("governance.xml");
  changes.emplace_back("@DOMAINS@", "<id_range><min>0</min><max>230</max></id_range>");
  for (const auto& [from, to] : changes) text.replace(text.find(from), from.size(), to);
  return text;
}

void Security::drive(Process& daemon, const std::string& sensor_folder, const std::string& reader_folder) {
  const auto with = [](std::vector<std::string> arguments, const std::string& folder) {
    if (!folder.empty()) arguments.insert(arguments.end(), {"--security", folder});
    return arguments;
  };
  const auto recorder = start(with(
      {"record", "--topic", "gyro/denoised", "-o", path("out.csv"), "--until-end", "--config", path(kPlain)},
      reader_folder));
  ASSERT_TRUE(recorder->wait_for_err("listening")) << recorder->err();
  const Result sent = run(with(
      {"simulate", "--config", path(kPlain), "--speed", "max", "--samples", "500", "--sensor", kSensorId},
      sensor_folder));
  EXPECT_EQ(sent.exit_code, 0) << sent.err;
  EXPECT_EQ(recorder->wait(), 0) << recorder->err();
  EXPECT_EQ(columns_of(path("out.csv"), {"sequence"}).size(), 500U);

  const bus::Domain domain(domain_id(), "loopback", sensor_folder);
  const ImuPublisher node(domain.participant(), "rt/imu/data_raw");
  ASSERT_TRUE(node.wait_for_reader());
  ASSERT_TRUE(eventually([&] { return count(daemon, "gyrod_bus_matched_writers") == 1.0; }));
  // Best effort: as many at a time as a socket holds, however late the daemon takes them.
  constexpr int kAtATime = 20;
  int received = 500;
  for (ImuMessage& message : noisy_imu_messages(100)) {
    message.frame_id = kFrameId;
    node.publish(message);
    if (++received % kAtATime != 0) continue;
    ASSERT_TRUE(eventually([&] { return count(daemon, "gyrod_samples_received_total") == received; }));
  }
}

TEST_F(Security, TheWireShowsNoSensorNoTopicAndNoFrameAndWithoutSecurityItShowsThemAll) {
  // As discovery and samples carry them: text with its end. A grant that is shown in the handshake has none.
  const std::vector<std::string> secrets = {kSensorId, kFrameId, std::string("gyro/denoised\0", 14),
                                            std::string("rt/imu/data_raw\0", 16),
                                            std::string("gyrod::DenoisedSample\0", 22)};
  {
    const WireCapture wire(domain_id());
    if (!wire.permitted()) GTEST_SKIP() << "a packet socket needs CAP_NET_RAW";
    const auto daemon = start_daemon({.patch = R"({"bus": {"ros2": {"topics": ["rt/imu/data_raw"]}}})"});
    drive(*daemon, "", "");
    for (const std::string& secret : secrets) EXPECT_TRUE(wire.contains(secret)) << secret;
    EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
  }
  const WireCapture wire(domain_id());
  const auto daemon = start_secured();
  drive(*daemon, made_->of("sensor"), made_->of("reader"));
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
  EXPECT_GT(wire.bytes(), 10'000U);
  EXPECT_TRUE(wire.contains("CN=sensor")) << "certificates are shown in the handshake: the capture works";
  for (const std::string& secret : secrets) EXPECT_FALSE(wire.contains(secret)) << secret;
  EXPECT_FALSE(wire.contains(key_hash_of(kSensorId)));
  EXPECT_THAT(daemon->err(), HasSubstr("DDS Security: we are 'CN=gyrod,O=gyrod TEST'"));
}

TEST_F(Security, AGovernanceThatEncryptsDataOnlyWouldShowAHashOfTheSensor) {
  const std::string governance =
      governance_with({{"<metadata_protection_kind>ENCRYPT", "<metadata_protection_kind>SIGN"},
                       {"<data_protection_kind>NONE", "<data_protection_kind>ENCRYPT"}});
  const std::string gyrod = made_->copy("gyrod", "data_only_gyrod");
  const std::string sensor = made_->copy("sensor", "data_only_sensor");
  for (const std::string& folder : {gyrod, sensor}) made_->sign(governance, folder + "/governance.p7s");
  const WireCapture wire(domain_id());
  if (!wire.permitted()) GTEST_SKIP() << "a packet socket needs CAP_NET_RAW";
  const auto daemon = start_daemon(secured(gyrod));
  EXPECT_EQ(simulate(sensor, {"--sensor", kSensorId}).exit_code, 0);
  EXPECT_FALSE(wire.contains(kSensorId));
  EXPECT_TRUE(wire.contains(key_hash_of(kSensorId)));
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

TEST_F(Security, WhoHasNoCertificateIsNotMatchedAndTheLogNamesTheProcessOnce) {
  const auto daemon = start_secured();
  const Result sensor = simulate(std::nullopt, {"--wait", "2"});
  EXPECT_EQ(sensor.exit_code, 6) << sensor.err;
  EXPECT_THAT(sensor.err, HasSubstr("nobody reads topic 'gyro/raw'"));
  EXPECT_TRUE(daemon->wait_for_err("a peer without DDS Security is kept out: process 'gyrod'"))
      << daemon->err();
  EXPECT_EQ(count(*daemon, "gyrod_bus_matched_writers"), 0.0);
  EXPECT_EQ(count(*daemon, "gyrod_samples_received_total"), 0.0);
  EXPECT_EQ(count(*daemon, "gyrod_bus_refused_peers_total"), 1.0);
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

TEST_F(Security, ACertificateOfAnotherAuthorityIsNotMatchedAndTheLogSaysSo) {
  const SecurityFolder other({"--program", "stranger=sensor"});
  const auto daemon = start_secured();
  // A little longer than bus::PeerWatch::kPatience: depending on the two ids only the other side hears the reason.
  const Result stranger = simulate(other.of("stranger"), {"--wait", "12"});
  EXPECT_EQ(stranger.exit_code, 6) << stranger.err;
  EXPECT_TRUE(daemon->wait_for_err("has shown no topic for 10 s")) << daemon->err();
  EXPECT_EQ(count(*daemon, "gyrod_bus_matched_writers"), 0.0);
  EXPECT_EQ(count(*daemon, "gyrod_bus_refused_peers_total"), 1.0);
  // Whoever heard the reason says it in words and not each second.
  EXPECT_THAT(daemon->err() + stranger.err, HasSubstr("unable to get local issuer certificate"));
  const std::string log = daemon->err();
  std::size_t lines = 0;
  for (std::size_t at = log.find("a peer is refused"); at != std::string::npos;
       at = log.find("a peer is refused", at + 1))
    ++lines;
  EXPECT_LE(lines, 2U) << log;
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

TEST_F(Security, ACertificateWithoutAGrantIsRefusedAndTheTopicIsNamed) {
  const Result writer = simulate(made_->of("reader"));
  EXPECT_EQ(writer.exit_code, 7) << writer.err;
  EXPECT_THAT(writer.err, AllOf(HasSubstr("not allowed to create"), HasSubstr("'gyro/raw'"),
                                HasSubstr("permissions.p7s")));
  const Result reader = run({"record", "--config", path(kPlain), "--security", made_->of("sensor"), "--topic",
                             "gyro/denoised", "-o", path("out.csv")});
  EXPECT_EQ(reader.exit_code, 7) << reader.err;
  EXPECT_THAT(reader.err, AllOf(HasSubstr("not allowed to create"), HasSubstr("'gyro/denoised'")));
  write_config(secured(made_->of("sensor")));
  const Result daemon = run({"run", "--config", config()});
  EXPECT_EQ(daemon.exit_code, 7) << daemon.err;
  EXPECT_THAT(daemon.err, HasSubstr("not allowed to create"));
}

TEST_F(Security, WhoDoesNotEnforceItsOwnGrantIsRefusedByGyrod) {
  // A reader under a governance, signed by the right authority, that lets everybody write: its own middleware has no objection.
  const std::string rogue = made_->copy("reader", "rogue");
  made_->sign(governance_with({{"<enable_read_access_control>true", "<enable_read_access_control>false"},
                               {"<enable_write_access_control>true", "<enable_write_access_control>false"}}),
              rogue + "/governance.p7s");
  const auto daemon = start_secured();
  const Result writer = simulate(rogue, {"--wait", "3"});
  EXPECT_EQ(writer.exit_code, 6) << writer.err;
  EXPECT_THAT(writer.err, HasSubstr("nobody reads topic 'gyro/raw'"));
  EXPECT_EQ(count(*daemon, "gyrod_samples_received_total"), 0.0);
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

TEST_F(Security, ARevokedCertificateIsNotMatchedAndOthersAre) {
  const SecurityFolder made(
      {"--program", "gyrod=daemon", "--program", "good=sensor", "--program", "lost=sensor"});
  made.make({"--revoke", "lost"});
  const auto daemon = start_daemon(secured(made.of("gyrod")));
  EXPECT_EQ(simulate(made.of("lost"), {"--wait", "3"}).exit_code, 6);
  EXPECT_EQ(count(*daemon, "gyrod_samples_received_total"), 0.0);
  EXPECT_EQ(simulate(made.of("good")).exit_code, 0);
  EXPECT_TRUE(eventually([&] { return count(*daemon, "gyrod_samples_received_total") == 500.0; }));
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

TEST_F(Security, ADomainOutsideTheGrantIsRefusedAndNamed) {
  const SecurityFolder other({"--domain", "3"});
  const Result result = simulate(other.of("sensor"));
  EXPECT_EQ(result.exit_code, 7) << result.err;
  EXPECT_THAT(result.err, AllOf(HasSubstr("is not let into domain " + std::to_string(domain_id())),
                                HasSubstr("governance")));
}

TEST_F(Security, EverySubcommandSaysWhatIsWrongWithAFileBeforeItJoins) {
  const std::string folder = made_->copy("sensor", "expired");
  made_->reissue(folder, -std::chrono::hours(48), -std::chrono::seconds(60));
  write_config(secured(folder));
  write_file("raw.csv", noisy_recording(10));
  const std::vector<std::vector<std::string>> commands = {
      {"run"},
      {"validate"},
      {"simulate"},
      {"record", "--topic", "gyro/denoised", "-o", path("out.csv")},
      {"replay", path("raw.csv"), "--sensor", "imu"}};
  for (const auto& command : commands) {
    const Result result = run_on_bus(command);
    EXPECT_EQ(result.exit_code, 7) << command.front() << ": " << result.err;
    EXPECT_THAT(result.err,
                AllOf(HasSubstr("DDS Security: '" + folder + "/cert.pem'"), HasSubstr("expired at")))
        << command.front();
  }
}

TEST_F(Security, ASensorWhoseCertificateEndsIsGoneAtThatMoment) {
  const std::string folder = made_->copy("sensor", "ending");
  const auto daemon = start_secured();
  made_->reissue(folder, -std::chrono::hours(1), std::chrono::seconds(10));
  const auto sensor = start({"simulate", "--config", path(kPlain), "--security", folder});
  ASSERT_TRUE(eventually([&] { return count(*daemon, "gyrod_bus_matched_writers") == 1.0; }))
      << sensor->err();
  ASSERT_TRUE(eventually([&] { return count(*daemon, "gyrod_bus_matched_writers") == 0.0; }))
      << daemon->err();
  EXPECT_TRUE(sensor->running()) << "it was not told";
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

TEST_F(Security, ADaemonWhoseCertificateEndsSaysSoIsNotReadyAndStopsInOrder) {
  const std::string folder = made_->copy("gyrod", "ending_daemon");
  made_->reissue(folder, -std::chrono::hours(1), std::chrono::seconds(8));
  const auto daemon = start_daemon(secured(folder));
  EXPECT_TRUE(daemon->wait_for_err("cert.pem' expires in 0 days: renew it")) << daemon->err();
  EXPECT_EQ(get(*daemon, "/readyz").find("not ready"), std::string::npos);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  EXPECT_NEAR(count(*daemon, "gyrod_bus_certificate_expiry_timestamp_seconds"),
              static_cast<double>(std::chrono::duration_cast<std::chrono::seconds>(now).count()), 10.0);
  EXPECT_TRUE(daemon->wait_for_err("cert.pem' has expired: gyrod is cut off")) << daemon->err();
  EXPECT_THAT(get(*daemon, "/readyz"), HasSubstr("a certificate has expired"));
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

}  // namespace
}  // namespace gyrod::testing
