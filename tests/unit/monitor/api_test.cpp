/// The JSON API's answers: equal to the metrics, null for what is not known, errors that name what is wrong.
#include "monitor/api.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "monitor/failure.hpp"
#include "unit/monitor/api_fixture.hpp"
#include "unit/monitor/scrape.hpp"

namespace gyrod::monitor::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Metrics have sixteen digits, which is less than a double.
std::optional<double> number(const nlohmann::json& value) {
  if (value.is_null()) return std::nullopt;
  std::array<char, 32> digits{};
  (void)std::snprintf(digits.data(), digits.size(), "%.16g", value.get<double>());
  return std::stod(digits.data());
}

TEST_F(ApiTest, StatusEqualsTheMetrics) {
  const json status = get("status");
  const auto families = families_of(shown_);
  const std::map<std::string, std::string> pairs = {
      {"gyrod_samples_received_total", "/samples/received"},
      {"gyrod_samples_published_total", "/samples/published"},
      {"gyrod_samples_in_flight", "/samples/in_flight"},
      {"gyrod_samples_missing_total", "/samples/missing"},
      {"gyrod_samples_bridged_total", "/samples/bridged"},
      {"gyrod_samples_warming_up_total", "/samples/warming_up"},
      {"gyrod_samples_passed_through_total", "/samples/passed_through"},
      {"gyrod_samples_realtime_total", "/samples/realtime"},
      {"gyrod_gaps_total", "/samples/gaps"},
      {"gyrod_restarts_total", "/samples/restarts"},
      {"gyrod_silences_total", "/samples/silences"},
      {"gyrod_hops_widened_total", "/samples/hops_widened"},
      {"gyrod_overloads_total", "/samples/overloads"},
      {"gyrod_model_misfits_total", "/samples/misfits"},
      {"gyrod_windows_total", "/windows"},
      {"gyrod_queued_windows", "/queued_windows"},
      {"gyrod_workers", "/workers"},
      {"gyrod_workers_busy", "/workers_busy"},
      {"gyrod_sensors", "/channels/open"},
      {"gyrod_sensors_silent", "/channels/silent"},
      {"gyrod_sensors_forgotten_total", "/channels/forgotten"},
      {"gyrod_bus_matched_writers", "/bus/matched_writers"},
      {"gyrod_bus_malformed_messages_total", "/bus/malformed_messages"},
      {"gyrod_bus_refusals_total", "/bus/refusals"},
      {"gyrod_bus_write_errors_total", "/bus/write_errors"},
      {"gyrod_bus_deadlines_missed_total", "/bus/deadlines_missed"},
      {"gyrod_bus_liveliness_lost_total", "/bus/liveliness_lost"},
      {"gyrod_bus_certificate_expiry_timestamp_seconds", "/bus/certificate_expiry_s"},
      {"gyrod_bus_refused_peers_total", "/bus/refused_peers"},
      {"gyrod_ros2_topics", "/bus/ros2_topics"},
      {"gyrod_shard_peers", "/fleet/peers"},
      {"gyrod_shards_missing", "/fleet/missing"},
      {"gyrod_standby_others", "/standby/others"},
      {"gyrod_standby_takeovers_total", "/standby/takeovers"},
      {"gyrod_state_file_errors_total", "/state_file_errors"},
      {"gyrod_uptime_seconds", "/uptime_s"},
      {"process_start_time_seconds", "/start_time_s"}};
  for (const auto& [metric, path] : pairs)
    EXPECT_EQ(number(status.at(json::json_pointer(path))), value_of(families, metric)) << path;
  EXPECT_EQ(status.at("samples").at("rejected").at("history"), shown_.engine.totals.rejected[8]);
  EXPECT_EQ(status.at("channels").at("by_health").at("silent"), shown_.engine.channels_by_health[8]);
  EXPECT_EQ(status.at("overload_step"), 1) << "one sensor's hop is widened";
}

TEST_F(ApiTest, StatusTellsWhereSamplesAreExpectedAndWhoDoesNotMatch) {
  const json bus = get("status").at("bus");
  EXPECT_EQ(bus.at("domain"), 3);
  EXPECT_THAT(bus.at("input_topics"), ElementsAre("gyro/raw", "gyro/raw_batch"));
  EXPECT_EQ(bus.at("simulate_hint"), "gyrod simulate --domain 3");
  EXPECT_EQ(bus.at("incompatible_peers"),
            json::parse(R"([{"direction": "input", "policy": "reliability", "peers": 3}])"));
  EXPECT_EQ(bus.at("matched_readers")[0], json::parse(R"({"topic": "gyro/denoised", "readers": 63})"));
}

TEST_F(ApiTest, WhatIsNotKnownIsNull) {
  shown_.engine.window_time = {};
  shown_.bus.standby.reset();
  const json status = get("status");
  EXPECT_TRUE(status.at("rates").at("samples_per_s").is_null());
  EXPECT_TRUE(status.at("window_time_s").at("p99").is_null());
  EXPECT_TRUE(status.at("standby").is_null());
  EXPECT_TRUE(status.at("ready_reason").is_null());
  const json sensor = get("channels/imu_rear");
  for (const char* key : {"report", "bias", "sample_rate_hz", "at_rest", "last_stamp_ns"})
    EXPECT_TRUE(sensor.at(key).is_null()) << key;
  EXPECT_TRUE(sensor.at("axes")[0].at("noise_in_radps").is_null());
  EXPECT_TRUE(sensor.at("axes")[0].at("reduction_db").is_null());
  EXPECT_TRUE(sensor.at("allan").at("at_rest_s").is_null());
}

/// T with 1 / sqrt(2 (T / tau - 1)) = 1/4 is 9 tau: tau is 1 s for N, 100 s for B.
TEST_F(ApiTest, WhatIsNotObservableYetSaysHowMuchRestItNeedsAtTheLeast) {
  auto& coefficients = shown_.channels[0].coefficients;
  coefficients[1][core::NoiseTerm::kBiasInstability].observable = false;
  coefficients[2][core::NoiseTerm::kAngleRandomWalk].observable = false;
  const json axes = get("channels/imu_front").at("allan").at("axes");
  EXPECT_TRUE(axes[0].at("needs_s").is_null());
  EXPECT_EQ(axes[1].at("needs_s"), 900.0);
  EXPECT_TRUE(axes[1].at("bias_instability_radps").is_null());
  EXPECT_EQ(axes[2].at("needs_s"), 9.0) << "whether B is known or not";
}

TEST_F(ApiTest, RatesAndTimesAreOfTheLastSeconds) {
  stream::EngineSnapshot engine;
  engine.totals.received = 1000;
  live_.recent.note(10.0, engine);
  engine.totals.received = 1500;
  engine.totals.windows = 20;
  for (int i = 0; i < 48; ++i) engine.window_time.add(0.0015);
  for (int i = 0; i < 2; ++i) engine.window_time.add(0.3);
  live_.recent.note(15.0, engine);
  const json status = get("status");
  EXPECT_EQ(status.at("rates").at("samples_per_s"), 100.0);
  EXPECT_EQ(status.at("rates").at("windows_per_s"), 4.0);
  EXPECT_NEAR(status.at("window_time_s").at("p50").get<double>(), 0.0015, 1e-4)
      << "half of 48 of 50, from 1 ms to 2 ms";
  EXPECT_GT(status.at("window_time_s").at("p99"), 0.2) << "of the two others";
}

TEST_F(ApiTest, ASensorsFiguresEqualItsMetrics) {
  const json sensor = get("channels/imu_front");
  const auto families = families_of(shown_);
  const auto of = [&](const std::string& metric) {
    return value_of(families, metric, {{"sensor", "imu_front"}});
  };
  EXPECT_EQ(number(sensor.at("received")), of("gyrod_sensor_samples_received_total"));
  EXPECT_EQ(number(sensor.at("rejected")), of("gyrod_sensor_samples_rejected_total"));
  EXPECT_EQ(number(sensor.at("overload_step")), of("gyrod_sensor_overload_step"));
  EXPECT_EQ(number(sensor.at("sample_rate_hz")), of("gyrod_sensor_sample_rate_hertz"));
  EXPECT_EQ(sensor.at("state"), "deadline_missed");
  EXPECT_EQ(sensor.at("health"), "stuck");
  EXPECT_EQ(number(sensor.at("allan").at("at_rest_s")), of("gyrod_sensor_allan_seconds"));
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    const auto of_axis = [&](const std::string& metric) {
      return value_of(families, metric, {{"sensor", "imu_front"}, {"axis", stream::kAxisNames[axis]}});
    };
    const json& row = sensor.at("axes")[axis];
    const json& report = sensor.at("report").at("axes")[axis];
    const json& allan = sensor.at("allan").at("axes")[axis];
    EXPECT_EQ(number(row.at("noise_in_radps")), of_axis("gyrod_axis_noise_floor_radians_per_second"));
    EXPECT_EQ(number(row.at("noise_out_radps")), of_axis("gyrod_axis_output_noise_radians_per_second"));
    EXPECT_NEAR(row.at("reduction_db").get<double>(),
                -20.0 * std::log10(1.0 - *of_axis("gyrod_axis_noise_reduction_ratio")), 1e-9);
    EXPECT_EQ(number(report.at("mean_radps")), of_axis("gyrod_axis_mean_radians_per_second"));
    EXPECT_EQ(std::optional(static_cast<double>(report.at("imfs").size())), of_axis("gyrod_axis_imfs"));
    EXPECT_EQ(number(report.at("tone").at("frequency_hz")), of_axis("gyrod_axis_tone_hertz"));
    EXPECT_EQ(number(report.at("fit").at("normalised_innovation")),
              of_axis("gyrod_axis_normalised_innovation"));
    EXPECT_EQ(number(sensor.at("bias").at("axes_radps")[axis]),
              of_axis("gyrod_axis_bias_radians_per_second"));
    EXPECT_EQ(number(allan.at("angle_random_walk_radps_sqrt_hz")),
              of_axis("gyrod_axis_angle_random_walk_radians_per_root_second"));
    EXPECT_EQ(number(allan.at("bias_instability_radps")),
              of_axis("gyrod_axis_bias_instability_radians_per_second"));
  }
  EXPECT_EQ(sensor.at("last_stamp_ns"), "1700000000500000000") << "a text: beyond what a double holds";
  EXPECT_THAT(sensor.at("report").at("flags"), ElementsAre("hop_widened"));
}

TEST_F(ApiTest, AnIdMayHoldWhatAPathMayNot) {
  const std::string id = R"(/imu/data "100%"?#&+)";
  shown_.channels = {busy_sensor(id)};
  EXPECT_EQ(get("channels/%2Fimu%2fdata%20%22100%25%22%3F%23%26+").at("sensor"), id);
}

TEST_F(ApiTest, AWrongQueryIsNamed) {
  EXPECT_THAT(refused(400, "channels?colour=red"), AllOf(HasSubstr("\"colour\""), HasSubstr("health")));
  EXPECT_THAT(refused(400, "channels?limit=0"), AllOf(HasSubstr("\"limit\""), HasSubstr("\"0\"")));
  EXPECT_THAT(refused(400, "channels?limit=1e3"), HasSubstr("a whole number from 1 to 10000"));
  EXPECT_THAT(refused(400, "channels?offset=-1"), HasSubstr("\"-1\""));
  EXPECT_THAT(refused(400, "channels?health=ok,bad"), AllOf(HasSubstr("\"bad\""), HasSubstr("noisy")));
  EXPECT_THAT(refused(400, "channels?sort=age"), HasSubstr("noise_in"));
  EXPECT_THAT(refused(400, "channels?sort=rate&sort=rate"), HasSubstr("more than once"));
  EXPECT_THAT(refused(400, "status?a=b"), HasSubstr("expected none"));
  EXPECT_THAT(refused(400, "events?after=x"), HasSubstr("\"after\""));
  EXPECT_THAT(refused(400, "events?limit=2001"), HasSubstr("a whole number from 1 to 2000"));
  EXPECT_THAT(refused(400, "channels/imu_front/samples?seconds=nan"), HasSubstr("from 10 to 600"));
  EXPECT_THAT(refused(400, "channels/imu_front/samples?points=99"), HasSubstr("from 100 to 4000"));
  EXPECT_THAT(refused(400, "channels/imu_front/spectrum?points=100"), HasSubstr("expected one of seconds"));
  EXPECT_THAT(refused(400, "channels/imu%2"), HasSubstr("%25"));
}

TEST_F(ApiTest, WhatIsNotThereIsNamed) {
  EXPECT_THAT(refused(404, "channels/nobody"), AllOf(HasSubstr("\"nobody\""), HasSubstr("/api/v1/channels")));
  EXPECT_THAT(refused(404, "channels/"), HasSubstr("\"\""));
  EXPECT_THAT(refused(404, "status/"), HasSubstr("expected /api/v1/"));
  EXPECT_THAT(refused(404, "channels/imu_front/colour"), HasSubstr("/colour"));
  EXPECT_EQ(ask("/api/v2/status").status, 404);
  EXPECT_EQ(ask("/api").status, 404);
}

TEST_F(ApiTest, AMessageHoldsNothingThatAClientMadeUp) {
  EXPECT_THAT(refused(404, "channels/%ff%00%0A"), HasSubstr("\"???\""));
}

TEST_F(ApiTest, TheEvidenceOfAnEventHasItsUnit) {
  const stream::SensorHealth before;
  const std::vector<std::pair<stream::Health, std::string>> units = {{stream::Health::kSilent, "s"},
                                                                     {stream::Health::kStuck, "s"},
                                                                     {stream::Health::kSaturated, "s"},
                                                                     {stream::Health::kDrifting, "rad/s"}};
  for (const auto& [state, unit] : units) {
    stream::SensorHealth now;
    now.axis[2] = {state, 3.0, 2.0};
    live_.events.add_health(1.0, "imu", before, now);
    const json event = get("events?limit=1").at("events")[0];
    EXPECT_EQ(event.at("unit"), unit);
    EXPECT_EQ(event.at("axis"), "z");
    EXPECT_EQ(event.at("to"), stream::name_of(state));
  }
}

TEST_F(ApiTest, AMessageQuotesNoMoreThanALine) {
  EXPECT_THAT(refused(404, "channels/" + std::string(200, 'x')),
              HasSubstr("\"" + std::string(80, 'x') + "...\""));
}

TEST_F(ApiTest, TextThatIsNoUtf8IsToldAsFarAsItIs) {
  live_.events.add(1.0, "",
                   "a\xff"
                   "b");
  EXPECT_EQ(get("events").at("events")[0].at("text"),
            "a\uFFFD"
            "b");
}

TEST(Failure, IsJsonWhateverItSays) {
  const Answer answer = failure(500, "/api/v1/status", "\"a\" \\ b\nc");
  EXPECT_EQ(nlohmann::json::parse(answer.body).at("error"), "\"a\" \\ b c");
  EXPECT_EQ(failure(500, "/metrics", "\"a\"").body, "\"a\"\n");
}

TEST_F(ApiTest, TheConfigurationIsToldAsItIs) { EXPECT_EQ(get("config").at("bus").at("domain"), 3); }

TEST_F(ApiTest, EventsComeByNumber) {
  stream::SensorHealth before;
  stream::SensorHealth now;
  for (auto& axis : now.axis) axis.state = stream::Health::kOk;
  live_.events.add_health(1.7e9, "imu_front", before, now);
  before = now;
  now.axis[1] = {stream::Health::kNoisy, 1.7, 1.5};
  live_.events.add_health(1.7e9 + 1.0, "imu_front", before, now);
  live_.events.add(1.7e9 + 2.0, "", "Stopping.");
  const json all = get("events");
  ASSERT_EQ(all.at("events").size(), 3U);
  EXPECT_EQ(all.at("first_id"), 1);
  EXPECT_EQ(all.at("last_id"), 3);
  EXPECT_TRUE(all.at("events")[0].at("axis").is_null()) << "all axes alike: one event";
  const json& noisy = all.at("events")[1];
  EXPECT_EQ(noisy.at("axis"), "y");
  EXPECT_EQ(noisy.at("from"), "ok");
  EXPECT_EQ(noisy.at("to"), "noisy");
  EXPECT_EQ(noisy.at("value"), 1.7);
  EXPECT_EQ(noisy.at("limit"), 1.5);
  EXPECT_TRUE(noisy.at("unit").is_null()) << "a ratio";
  EXPECT_EQ(noisy.at("text"), "imu_front axis y is noisy, before ok (1.7 times its usual noise, limit 1.5).");
  EXPECT_EQ(all.at("events")[2].at("kind"), "daemon");
  EXPECT_TRUE(all.at("events")[2].at("sensor").is_null());
  EXPECT_EQ(get("events?after=1&limit=1").at("events")[0].at("id"), 2);
  EXPECT_EQ(get("events?limit=1").at("events")[0].at("id"), 3) << "the newest, where none is named";
  EXPECT_EQ(get("events?sensor=imu_front").at("events").size(), 2U);
  EXPECT_TRUE(get("events?after=3").at("events").empty());
  EXPECT_EQ(all.at("epoch"), get("status").at("epoch"));
  EXPECT_EQ(get("events?after=2&epoch=1700000000000000").at("events").size(), 1U);
  EXPECT_EQ(get("events?after=2&epoch=1600000000000000").at("events").size(), 3U) << "another run's number";
}

}  // namespace
}  // namespace gyrod::monitor::test
