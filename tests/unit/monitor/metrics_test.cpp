/// What /metrics says, against a view with known values.
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/monitor/exposition.hpp"
#include "unit/monitor/fixed_view.hpp"
#include "unit/monitor/scrape.hpp"

namespace gyrod::monitor::test {
namespace {

using Labels = std::map<std::string, std::string>;

TEST(Metrics, EveryFamilyHasHelpTypeAndATellingName) {
  for (const Family& family : families_of(busy_gyrod())) {
    EXPECT_FALSE(family.help.empty()) << family.name;
    EXPECT_TRUE(family.name.starts_with("gyrod_") || family.name.starts_with("process_")) << family.name;
    EXPECT_FALSE(family.series.empty()) << family.name;
    EXPECT_EQ(family.type == "counter", family.name.ends_with("_total")) << family.name << " " << family.type;
    if (family.type == "histogram") {
      EXPECT_TRUE(family.name.ends_with("_seconds")) << family.name;
    }
  }
}

TEST(Metrics, TotalsAreTheEnginesAndTheBuses) {
  const auto families = families_of(busy_gyrod());
  const std::map<std::string, double> expected = {{"gyrod_samples_received_total", 1009},
                                                  {"gyrod_samples_published_total", 900},
                                                  {"gyrod_samples_in_flight", 64},
                                                  {"gyrod_samples_missing_total", 11},
                                                  {"gyrod_samples_bridged_total", 9},
                                                  {"gyrod_samples_warming_up_total", 320},
                                                  {"gyrod_samples_passed_through_total", 16},
                                                  {"gyrod_gaps_total", 3},
                                                  {"gyrod_restarts_total", 2},
                                                  {"gyrod_windows_total", 30},
                                                  {"gyrod_hops_widened_total", 5},
                                                  {"gyrod_overloads_total", 1},
                                                  {"gyrod_samples_realtime_total", 980},
                                                  {"gyrod_model_misfits_total", 8},
                                                  {"gyrod_silences_total", 5},
                                                  {"gyrod_sensors_silent", 1},
                                                  {"gyrod_sensors_forgotten_total", 7},
                                                  {"gyrod_state_file_errors_total", 62},
                                                  {"gyrod_standby_others", 57},
                                                  {"gyrod_standby_sensors", 58},
                                                  {"gyrod_standby_samples_held", 59},
                                                  {"gyrod_standby_samples_let_go_total", 60},
                                                  {"gyrod_standby_takeovers_total", 61},
                                                  {"gyrod_sensors", 2},
                                                  {"gyrod_queued_windows", 6},
                                                  {"gyrod_workers", 4},
                                                  {"gyrod_workers_busy", 3},
                                                  {"gyrod_ready", 1},
                                                  {"gyrod_bus_matched_writers", 2},
                                                  {"gyrod_bus_malformed_messages_total", 21},
                                                  {"gyrod_bus_refusals_total", 22},
                                                  {"gyrod_bus_write_errors_total", 23},
                                                  {"gyrod_ros2_topics", 24},
                                                  {"gyrod_ros2_refused_topics_total", 25},
                                                  {"gyrod_ros2_dropped_messages_total", 26},
                                                  {"gyrod_bus_certificate_expiry_timestamp_seconds", 1.8e9},
                                                  {"gyrod_bus_refused_peers_total", 37},
                                                  {"gyrod_shard_peers", 27},
                                                  {"gyrod_shard_twins", 28},
                                                  {"gyrod_shard_overlapping_peers", 29},
                                                  {"gyrod_shards_missing", 30},
                                                  {"gyrod_shard_disputes_total", 31},
                                                  {"gyrod_shard_foreign_samples_total", 32},
                                                  {"gyrod_bus_deadlines_missed_total", 47},
                                                  {"gyrod_bus_liveliness_lost_total", 48},
                                                  {"gyrod_uptime_seconds", 42.5},
                                                  {"process_start_time_seconds", 1.7e9}};
  for (const auto& [name, value] : expected) EXPECT_EQ(value_of(families, name), value) << name;
  EXPECT_EQ(value_of(families, "gyrod_build_info", {{"version", "1.2.3"}}), 1.0);
  EXPECT_EQ(value_of(families, "gyrod_shard_active", {{"shard", "2/3"}}), 1.0);
  const char* const peers = "gyrod_bus_incompatible_peers";
  EXPECT_EQ(value_of(families, peers, {{"direction", "input"}, {"policy", "reliability"}}), 3.0);
  EXPECT_EQ(value_of(families, peers, {{"direction", "output"}, {"policy", "type"}}), 0.0);
}

TEST(Metrics, AShardThatIsNotServedYetDoesNotJudgeTheOthers) {
  Shown shown = busy_gyrod();
  shown.fleet.active = false;
  const auto families = families_of(shown);
  EXPECT_EQ(value_of(families, "gyrod_shard_active", {{"shard", "2/3"}}), 0.0);
  EXPECT_EQ(find_family(families, "gyrod_shards_missing"), nullptr);
}

TEST(Metrics, RefusedSamplesAreCountedUnderEveryReasonAndAddUp) {
  const auto families = families_of(busy_gyrod());
  const Family* rejected = find_family(families, "gyrod_samples_rejected_total");
  ASSERT_NE(rejected, nullptr);
  EXPECT_EQ(rejected->series.size(), stream::kRejectReasons);
  double sum = 0.0;
  for (std::size_t i = 0; i < stream::kRejectReasons; ++i) {
    const std::string reason(stream::name_of(static_cast<stream::RejectReason>(i)));
    const auto value = value_of(families, "gyrod_samples_rejected_total", {{"reason", reason}});
    EXPECT_EQ(value, static_cast<double>(i + 1)) << reason;
    sum += value.value_or(0.0);
  }
  EXPECT_EQ(value_of(families, "gyrod_samples_received_total"),
            value_of(families, "gyrod_samples_published_total").value() +
                value_of(families, "gyrod_samples_in_flight").value() + sum);
}

TEST(Metrics, HistogramsAreCumulativeSortedAndEndAtInfinity) {
  const auto families = families_of(busy_gyrod());
  const Family* times = find_family(families, "gyrod_window_duration_seconds");
  ASSERT_NE(times, nullptr);
  double last_bound = -std::numeric_limits<double>::infinity();
  double last_count = 0.0;
  std::size_t buckets = 0;
  for (const Series& series : times->series) {
    if (series.name != "gyrod_window_duration_seconds_bucket") continue;
    const double bound = std::stod(series.labels.at("le"));
    EXPECT_GT(bound, last_bound);
    EXPECT_GE(series.value, last_count);
    // The samples added in busy_gyrod().
    const double below = (bound >= 20e-6) + 2 * (bound >= 0.0015) + (bound >= 0.3) + (bound >= 60.0);
    EXPECT_EQ(series.value, below) << bound;
    last_bound = bound;
    last_count = series.value;
    ++buckets;
  }
  EXPECT_EQ(buckets, stream::TimeHistogram::kUpperBoundsS.size() + 1);
  EXPECT_TRUE(std::isinf(last_bound));
  for (const Series& series : times->series) {
    if (series.name.ends_with("_count")) {
      EXPECT_EQ(series.value, last_count);
    }
    if (series.name.ends_with("_sum")) {
      EXPECT_NEAR(series.value, 60.30302, 1e-9);
    }
  }
}

TEST(Metrics, FiguresOfASensorAndItsAxesAreThoseOfItsLastReport) {
  const auto families = families_of(busy_gyrod());
  const Labels sensor = {{"sensor", "imu_front"}};
  EXPECT_EQ(value_of(families, "gyrod_sensor_samples_received_total", sensor), 500.0);
  EXPECT_EQ(value_of(families, "gyrod_sensor_samples_rejected_total", sensor), 10.0);
  EXPECT_EQ(value_of(families, "gyrod_sensor_sample_rate_hertz", sensor), 99.5);
  EXPECT_EQ(value_of(families, "gyrod_sensor_overload_step", sensor), 1.0);
  EXPECT_EQ(value_of(families, "gyrod_sensor_noise_source", sensor), 1.0);
  EXPECT_EQ(value_of(families, "gyrod_sensor_last_window_timestamp_seconds", sensor), 1700000000.5);
  const Labels y = {{"sensor", "imu_front"}, {"axis", "y"}};
  EXPECT_EQ(value_of(families, "gyrod_axis_noise_floor_radians_per_second", y), 0.016);
  EXPECT_EQ(value_of(families, "gyrod_axis_output_noise_radians_per_second", y), 0.004);
  EXPECT_EQ(value_of(families, "gyrod_axis_noise_reduction_ratio", y), 0.75);
  EXPECT_EQ(value_of(families, "gyrod_axis_mean_radians_per_second", y), -0.2);
  EXPECT_EQ(value_of(families, "gyrod_axis_filtered_imfs", y), 5.0);
  EXPECT_EQ(value_of(families, "gyrod_sensor_samples_realtime_total", sensor), 490.0);
  EXPECT_EQ(value_of(families, "gyrod_sensor_model_misfits_total", sensor), 6.0);
  EXPECT_EQ(value_of(families, "gyrod_sensor_at_rest", sensor), 1.0);
  EXPECT_EQ(value_of(families, "gyrod_sensor_silent", sensor), 1.0);
  EXPECT_EQ(value_of(families, "gyrod_sensor_state", sensor), 2.0);
  EXPECT_EQ(value_of(families, "gyrod_sensor_silences_total", sensor), 4.0);
  EXPECT_EQ(value_of(families, "gyrod_axis_normalised_innovation", y), 3.0);
  EXPECT_EQ(value_of(families, "gyrod_axis_model_misfit", y), 1.0);
  EXPECT_EQ(value_of(families, "gyrod_axis_model_misfit", {{"sensor", "imu_front"}, {"axis", "x"}}), 0.0);
}

TEST(Metrics, HealthAndWhatIsKnownOfTheNoiseAtRest) {
  const auto families = families_of(busy_gyrod());
  const Labels sensor = {{"sensor", "imu_front"}};
  EXPECT_EQ(value_of(families, "gyrod_sensors_by_health", {{"state", "silent"}}), 9.0);
  EXPECT_EQ(value_of(families, "gyrod_health_changes_total", {{"state", "warming_up"}}), 20.0);
  EXPECT_EQ(value_of(families, "gyrod_sensor_health", sensor), 7.0) << "stuck";
  EXPECT_EQ(value_of(families, "gyrod_sensor_allan_seconds", sensor), 100.0);
  EXPECT_EQ(value_of(families, "gyrod_sensor_lag_samples", sensor), 16.0);
  const Labels y = {{"sensor", "imu_front"}, {"axis", "y"}};
  EXPECT_EQ(value_of(families, "gyrod_axis_health", y), 5.0) << "noisy";
  EXPECT_EQ(value_of(families, "gyrod_axis_bias_radians_per_second", y), 0.02);
  EXPECT_NEAR(value_of(families, "gyrod_axis_noise_density_radians_per_second_per_root_hertz", y).value(),
              0.016 / 7.0, 1e-12);
  EXPECT_EQ(value_of(families, "gyrod_axis_angle_random_walk_radians_per_root_second", y), 1.4e-3);
  EXPECT_EQ(value_of(families, "gyrod_axis_bias_instability_radians_per_second", y), 8e-5);
  EXPECT_NEAR(value_of(families, "gyrod_axis_tone_hertz", y).value(), 39.2, 1e-9);
  EXPECT_EQ(value_of(families, "gyrod_axis_ar_order", y), 3.0);
}

TEST(Metrics, WhatIsNotObservableOfTheNoiseHasNoSeries) {
  const auto families = families_of(busy_gyrod());
  const Labels x = {{"sensor", "imu_rear"}, {"axis", "x"}};
  for (const std::string name :
       {"health", "bias_radians_per_second", "tone_hertz", "ar_order", "bias_instability_radians_per_second",
        "noise_density_radians_per_second_per_root_hertz", "angle_random_walk_radians_per_root_second"})
    EXPECT_EQ(value_of(families, "gyrod_axis_" + name, x), std::nullopt) << name;
  EXPECT_EQ(value_of(families, "gyrod_sensor_allan_seconds", {{"sensor", "imu_rear"}}), std::nullopt);
}

TEST(Metrics, AWindowMethodHasNoModelToJudgeAndWhereNobodyLooksNoRest) {
  Shown shown = busy_gyrod();
  shown.channels[0].last_report.model_fit.reset();
  shown.channels[0].last_report.at_rest.reset();
  const auto families = families_of(shown);
  for (const char* const name : {"gyrod_axis_normalised_innovation", "gyrod_axis_model_misfit"})
    EXPECT_EQ(value_of(families, name, {{"sensor", "imu_front"}, {"axis", "y"}}), std::nullopt) << name;
  EXPECT_EQ(value_of(families, "gyrod_sensor_at_rest", {{"sensor", "imu_front"}}), std::nullopt);
  shown.channels[0].last_report.at_rest = false;
  EXPECT_EQ(value_of(families_of(shown), "gyrod_sensor_at_rest", {{"sensor", "imu_front"}}), 0.0);
}

TEST(Metrics, WhatIsNotKnownYetHasNoSeries) {
  const auto families = families_of(busy_gyrod());
  const Labels sensor = {{"sensor", "imu_rear"}};
  EXPECT_EQ(value_of(families, "gyrod_sensor_samples_received_total", sensor), 10.0);
  EXPECT_EQ(value_of(families, "gyrod_sensor_sample_rate_hertz", sensor), std::nullopt);
  EXPECT_EQ(value_of(families, "gyrod_sensor_noise_source", sensor), std::nullopt);
  EXPECT_EQ(value_of(families, "gyrod_axis_imfs", {{"sensor", "imu_rear"}, {"axis", "x"}}), std::nullopt);
}

TEST(Metrics, PassThroughIsTheHighestOverloadStep) {
  Shown shown = busy_gyrod();
  shown.channels[0].pass_through = true;
  EXPECT_EQ(value_of(families_of(shown), "gyrod_sensor_overload_step", {{"sensor", "imu_front"}}), 2.0);
}

TEST(Metrics, ASensorHasAsManySeriesAsTheManualSays) {
  std::size_t series = 0;
  for (const Family& family : families_of(busy_gyrod())) {
    for (const Series& one : family.series) {
      const auto label = one.labels.find("sensor");
      if (label != one.labels.end() && label->second == "imu_front") ++series;
    }
  }
  EXPECT_EQ(series, 70U);  // MonitorOptions::max_channel_series, docs/configuration.md
}

TEST(Metrics, SensorsBeyondTheCapAreCountedInstead) {
  Shown shown = busy_gyrod();
  shown.channels.clear();
  for (int i = 0; i < 10; ++i) shown.channels.push_back(busy_sensor("gyro" + std::to_string(i)));
  shown.engine.channels = shown.channels.size();
  const auto families = families_of(shown, 3);
  std::set<std::string> sensors;
  for (const Family& family : families) {
    for (const Series& series : family.series) {
      if (series.labels.contains("sensor")) sensors.insert(series.labels.at("sensor"));
    }
  }
  EXPECT_THAT(sensors, testing::ElementsAre("gyro0", "gyro1", "gyro2"));
  EXPECT_EQ(value_of(families, "gyrod_sensors_omitted"), 7.0);
  EXPECT_EQ(value_of(families, "gyrod_sensors"), 10.0);
  EXPECT_EQ(value_of(families_of(shown, 0), "gyrod_sensors_omitted"), 10.0);
}

TEST(Metrics, OddSensorIdsSurviveTheFormat) {
  for (const std::string name : {"a\"b", "back\\slash", "line\nbreak", "a b,c={}", "gyr\xC3\xB6", "\\n"}) {
    Shown shown = busy_gyrod();
    shown.channels = {busy_sensor(name)};
    EXPECT_EQ(value_of(families_of(shown), "gyrod_sensor_samples_received_total", {{"sensor", name}}), 500.0)
        << name;
  }
}

}  // namespace
}  // namespace gyrod::monitor::test
