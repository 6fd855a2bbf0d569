// Messages of a foreign writer that fit the wire and not the contract: each is refused under a name, and log, metrics and JSON stay clean.
#include <algorithm>
#include <cstring>
#include <foreign.h>
#include <gyrod.h>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "foreign_writer.hpp"
#include "rig.hpp"
#include "support/arrivals.hpp"
#include "support/eventually.hpp"
#include "unit/monitor/exposition.hpp"

namespace gyrod::testing {
namespace {

constexpr const char* kSampleType = "gyrod::GyroSample";

class ForeignPayload : public Rig {
 protected:
  void SetUp() override {
    daemon_ = start_daemon();
    sensor_ = start_on_bus({"simulate", "--sensor", "imu", "--rate", "200", "--wait", "60"});
    ASSERT_TRUE(output_.more_arrive(50));
  }

  [[nodiscard]] double rejected(const std::string& reason) const {
    return of(*daemon_, "gyrod_samples_rejected_total{reason=\"" + reason + "\"}");
  }
  [[nodiscard]] double malformed() const { return of(*daemon_, "gyrod_bus_malformed_messages_total"); }

  void connect(const ForeignWriter& writer) const {
    ASSERT_TRUE(writer.wait_for_reader());
    ASSERT_TRUE(eventually([&] { return of(*daemon_, "gyrod_bus_matched_writers") == 2.0; }));
  }
  static gyrod_GyroSample sample(const std::string& sensor) {
    gyrod_GyroSample made{};
    std::strncpy(made.sensor, sensor.c_str(), sizeof made.sensor - 1);
    return made;
  }

  /// The sensor that behaves goes on, no other was made of what came, and all that others may look at can be read.
  void expect_unharmed() {
    ASSERT_TRUE(output_.more_arrive(100));
    EXPECT_EQ(output_.missing(), 0U);
    EXPECT_TRUE(eventually([this] { return is_balanced(*daemon_); }));
    EXPECT_NO_THROW((void)monitor::test::parse_exposition(get(*daemon_, "/metrics")));
    for (const char* path : {"/api/v1/status", "/api/v1/channels", "/api/v1/events"})
      EXPECT_TRUE(nlohmann::json::accept(get(*daemon_, path))) << path;
    const std::string log = daemon_->err();
    EXPECT_EQ(std::ranges::find_if(log, [](char c) { return (c < ' ' && c != '\n') || c > '~'; }), log.end())
        << log;
    EXPECT_EQ(stop_daemon(*daemon_), 0) << log;
  }

  bus::Domain domain_{domain_id(), "loopback"};
  std::unique_ptr<Process> daemon_;
  std::unique_ptr<Process> sensor_;
  const Arrivals output_{domain_, bus::BusOptions{}, "gyro/denoised", "imu"};
};

TEST_F(ForeignPayload, IdsThatAreNoTextAreRefusedByName) {
  const ForeignWriter writer(domain_.participant(), gyrod_GyroSample_desc, kSampleType, "gyro/raw");
  connect(writer);
  const std::vector<std::string> ids = {"\x1b[2J\x07",       // controls a terminal
                                        "\xff\xfe\xc3\x28",  // no UTF-8
                                        "caf\xc3\xa9",       // UTF-8, and no ASCII
                                        "two\nlines",       "a b", "a\"},{\"x\":1", std::string(64, '\x01')};
  for (const std::string& id : ids) writer.write(sample(id));
  // Quotes are printable: an id like any other, once it is escaped.
  EXPECT_TRUE(eventually([&] { return rejected("bad_sensor_id") == static_cast<double>(ids.size() - 1); }))
      << rejected("bad_sensor_id");
  EXPECT_TRUE(eventually([&] { return of(*daemon_, "gyrod_sensors") == 2.0; }));
  writer.write(sample(""));
  EXPECT_TRUE(eventually([&] { return malformed() == 1.0; })) << malformed();
  expect_unharmed();
}

TEST_F(ForeignPayload, AnIdOfTenKilobytesIsNotTaken) {
  const ForeignWriter writer(domain_.participant(), foreign_LongId_desc, kSampleType, "gyro/raw");
  connect(writer);
  std::string text(10'000, 'x');
  foreign_LongId message{};
  for (const std::size_t length : {65UL, 255UL, 10'000UL}) {
    std::string id = text.substr(0, length);
    message.sensor = id.data();
    writer.write(message);
  }
  EXPECT_TRUE(eventually([&] { return malformed() == 3.0; })) << malformed();
  EXPECT_EQ(of(*daemon_, "gyrod_sensors"), 1.0);
  expect_unharmed();
}

TEST_F(ForeignPayload, AStringWithoutAnEndOrWithAnImpossibleLengthIsNotTaken) {
  const ForeignWriter writer(domain_.participant(), foreign_RawId_desc, kSampleType, "gyro/raw");
  connect(writer);
  foreign_RawId message{};
  std::memcpy(message.bytes, "abcd", sizeof message.bytes);
  for (const std::uint32_t length : {4U, 0U, 3U, 41U, 64U, 0x7fffffffU, 0xffffffffU}) {
    message.length = length;
    writer.write(message);
  }
  EXPECT_TRUE(eventually([&] { return malformed() == 7.0; })) << malformed();
  EXPECT_EQ(of(*daemon_, "gyrod_sensors"), 1.0);
  expect_unharmed();
}

TEST_F(ForeignPayload, AbsurdNumbersAndStampsHarmTheirOwnSensorAtMost) {
  using Stamps = std::numeric_limits<std::int64_t>;
  using Numbers = std::numeric_limits<std::uint64_t>;
  const ForeignWriter writer(domain_.participant(), gyrod_GyroSample_desc, kSampleType, "gyro/raw");
  connect(writer);
  const double before = of(*daemon_, "gyrod_samples_received_total");
  double sent = 0.0;
  for (const std::uint64_t number :
       {std::uint64_t{0}, std::uint64_t{1}, Numbers::max() / 2, Numbers::max()}) {
    for (const std::int64_t stamp : {Stamps::min(), std::int64_t{-1}, std::int64_t{0}, Stamps::max()}) {
      for (const double rate :
           {0.0, 1e308, -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        gyrod_GyroSample message = sample("mad");
        message.sequence_number = number;
        message.stamp_ns = stamp;
        message.rate_radps[1] = rate;
        writer.write(message);
        ++sent;
      }
    }
  }
  EXPECT_TRUE(eventually(
      [&] { return of(*daemon_, "gyrod_sensor_samples_received_total{sensor=\"mad\"}") == sent; }));
  EXPECT_GE(of(*daemon_, "gyrod_samples_received_total"), before + sent);
  EXPECT_EQ(rejected("not_finite"), sent / 2.0);
  EXPECT_EQ(rejected("out_of_range"), sent / 4.0);
  expect_unharmed();
}

TEST_F(ForeignPayload, ATypeNameThatControlsATerminalIsShownHarmless) {
  const ForeignWriter writer(domain_.participant(), gyrod_GyroSample_desc, "evil\x1b[2J\xff", "gyro/raw");
  EXPECT_TRUE(daemon_->wait_for_err("does not match: it has type 'evil?[2J?'")) << daemon_->err();
  expect_unharmed();
}

}  // namespace
}  // namespace gyrod::testing
