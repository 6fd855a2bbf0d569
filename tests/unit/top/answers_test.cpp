#include "top/answers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/api_answers.hpp"
#include "top/listing.hpp"
#include "top/printable.hpp"

namespace gyrod::top {
namespace {

using gyrod::testing::sensor_json;
using gyrod::testing::sensors_json;
using gyrod::testing::status_json;
using ::testing::HasSubstr;

std::string refusal(const std::string& json) {
  try {
    (void)parse_sensors(json);
  } catch (const AnswerError& error) {
    return error.what();
  }
  return "taken";
}

TEST(Answers, AreTakenAsTheContractHasThem) {
  const Status status = parse_status(status_json());
  EXPECT_EQ(status.version, "0.1.0");
  EXPECT_TRUE(status.ready);
  EXPECT_EQ(status.samples_per_s, 12345.6);
  EXPECT_EQ(status.windows_per_s, std::nullopt) << "not known is not 0";
  EXPECT_EQ(status.by_health.at("noisy"), 1U);
  EXPECT_EQ(status.input_topics.size(), 2U);

  const SensorPage page = parse_sensors(sensors_json(sensor_json("front", "noisy"), 1));
  ASSERT_EQ(page.sensors.size(), 1U);
  const Sensor& sensor = page.sensors.front();
  EXPECT_EQ(sensor.name, "front");
  ASSERT_NE(sensor.loudest(), nullptr);
  EXPECT_EQ(sensor.loudest()->health, "noisy");
  EXPECT_DOUBLE_EQ(sensor.lost_share().value_or(-1.0), 15.0 / 1000.0);
}

TEST(Answers, NameTheKeyThatIsNotAsItShouldBe) {
  EXPECT_THAT(refusal("<html>"), HasSubstr("not JSON"));
  EXPECT_THAT(refusal("[]"), HasSubstr("an object as channels"));
  EXPECT_THAT(refusal(R"({"total": -1})"), HasSubstr("a count as channels.total"));
  EXPECT_THAT(refusal(sensors_json(R"({"sensor": 7})", 1)), HasSubstr("text as channels.channels[0].sensor"));
  EXPECT_THROW((void)parse_status("{}"), AnswerError);
}

TEST(Answers, TellWhatTheServerSays) {
  EXPECT_EQ(parse_error(R"({"error": "unknown key 'x'"})"), "unknown key 'x'");
  EXPECT_EQ(parse_error("<html>"), "");
  EXPECT_EQ(parse_error(R"({"error": 7})"), "");
}

// A sensor's id, a version or a reason may come from anybody on the network.
TEST(Answers, HoldNothingThatATerminalWouldObey) {
  const std::string hostile = R"(a\u001b]0;owned\u0007\u009b2J\nrow\u202e)";
  const SensorPage page = parse_sensors(sensors_json(sensor_json(hostile, hostile), 1));
  const std::string table = listing(page.sensors);
  EXPECT_EQ(table.find('\x1b'), std::string::npos);
  EXPECT_EQ(table.find('\x9b'), std::string::npos);
  EXPECT_EQ(std::ranges::count(table, '\n'), 2);
  EXPECT_EQ(printable("\x1b[2Jid\x7f\xc2\x9b"), "?[2Jid???");
  EXPECT_EQ(printable("0123456789", 4), "0123");
}

TEST(Listing, HasStableColumns) {
  const SensorPage page = parse_sensors(
      sensors_json(sensor_json("front", "noisy") + "," + sensor_json("a_sensor_with_a_long_name", "ok"), 2));
  EXPECT_EQ(listing(page.sensors),
            "health sensor                    rate_hz noise_in_dps noise_out_dps reduction_db lost_percent "
            "received "
            "published rejected missing axes\n"
            "noisy  front                     99.97   0.5730       0.02865       20.00        1.500        "
            "990      "
            "970       5        10      ok,noisy,ok\n"
            "ok     a_sensor_with_a_long_name 99.97   0.5730       0.02865       20.00        1.500        "
            "990      "
            "970       5        10      ok,ok,ok\n");
}

TEST(Listing, OfASensorOfWhichNothingIsKnownHasDashes) {
  Sensor unknown;
  unknown.name = "new";
  unknown.health = "warming_up";
  EXPECT_THAT(listing({unknown}),
              ::testing::MatchesRegex(".*\nwarming_up new +- +- +- +- +- +0 +0 +0 +0 +-\n"));
}

TEST(Listing, IsWellWhereGyrodIsReadyAndNobodyIsTroubled) {
  const auto well = [](const std::string& ready, const std::string& health) {
    return all_well(parse_status(status_json(ready)),
                    parse_sensors(sensors_json(sensor_json("front", health), 1)).sensors);
  };
  EXPECT_TRUE(well("true", "ok"));
  EXPECT_TRUE(well("true", "warming_up"));
  EXPECT_FALSE(well("true", "degraded"));
  EXPECT_FALSE(well("true", "a_state_of_a_newer_gyrod"));
  EXPECT_FALSE(well("false", "ok"));
}

}  // namespace
}  // namespace gyrod::top
