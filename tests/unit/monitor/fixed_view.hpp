/// A view of an engine and a bus that are not there, with values that tell every metric from the others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "monitor/http_counts.hpp"
#include "monitor/view.hpp"

namespace gyrod::monitor::test {

/// What the view shows.
struct Shown {
  stream::EngineSnapshot engine;
  std::vector<stream::ChannelSnapshot> channels;
  BusSnapshot bus;
  FleetSnapshot fleet;
  Readiness readiness{.ready = true, .reason = ""};
  std::uint64_t state_file_errors = 0;
  HttpSnapshot http;
};

/// A sensor that has had windows: every figure known.
inline stream::ChannelSnapshot busy_sensor(std::string name) {
  stream::ChannelSnapshot sensor;
  sensor.sensor = std::move(name);
  sensor.counts = {.received = 500,
                   .published = 450,
                   .in_flight = 40,
                   .missing = 4,
                   .gaps = 1,
                   .windows = 15,
                   .realtime = 490,
                   .misfits = 6,
                   .silences = 4};
  sensor.counts.rejected[0] = 3;
  sensor.counts.rejected[2] = 7;
  sensor.queued_windows = 2;
  sensor.hop_samples = 64;
  sensor.sample_rate_hz = 99.5;
  sensor.state = stream::ChannelState::kDeadlineMissed;
  stream::NoiseReport& report = sensor.last_report;
  report.model_epoch = 15;
  report.last_stamp_ns = 1'700'000'000'500'000'000;
  report.noise_source = stream::NoiseSource::kImf1;
  report.flags = static_cast<std::uint32_t>(stream::SampleFlag::kHopWidened);
  report.window_time_s = 0.0015;
  report.at_rest = true;
  report.sample_rate_hz = 98.0;
  report.lag_samples = 16;
  sensor.health.emplace();
  sensor.health->state = stream::Health::kStuck;
  sensor.health->axis[1].state = stream::Health::kNoisy;
  sensor.curves[0].terms[0] = 9950;
  sensor.curves_rate_hz = 99.5;
  sensor.bias_s = 60.0;
  report.model_fit.emplace();
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    const double scale = 1.0 + static_cast<double>(axis);
    report.axis[axis].noise_floor = 0.008 * scale;
    report.axis[axis].output_noise = 0.002 * scale;
    report.axis[axis].mean = -0.1 * scale;
    report.axis[axis].imf_count = 8;
    report.axis[axis].j = 2;
    report.axis[axis].k = 5;
    report.axis[axis].tone_frequency_cycles = 0.2 * scale;
    report.axis[axis].imf[3].model.ar_order = 2 + axis;
    sensor.bias_radps[axis] = 0.01 * scale;
    sensor.coefficients[axis][core::NoiseTerm::kAngleRandomWalk] = {7e-4 * scale, 1e-6, true};
    sensor.coefficients[axis][core::NoiseTerm::kBiasInstability] = {4e-5 * scale, 1e-6, true};
    (*report.model_fit)[axis].normalised_innovation = 1.5 * scale;
    (*report.model_fit)[axis].misfit = axis == 1;
  }
  return sensor;
}

/// A sensor before its first window: most figures are not known yet.
inline stream::ChannelSnapshot new_sensor(std::string name) {
  stream::ChannelSnapshot sensor;
  sensor.sensor = std::move(name);
  sensor.counts.received = 10;
  sensor.counts.in_flight = 10;
  sensor.hop_samples = 32;
  return sensor;
}

inline Shown busy_gyrod() {
  Shown shown;
  stream::Counts& totals = shown.engine.totals;
  totals = {.received = 1009,
            .published = 900,
            .in_flight = 64,
            .missing = 11,
            .bridged = 9,
            .gaps = 3,
            .restarts = 2,
            .windows = 30,
            .warming_up = 320,
            .passed_through = 16,
            .hops_widened = 5,
            .overloads = 1,
            .realtime = 980,
            .misfits = 8,
            .silences = 5};
  for (std::size_t i = 0; i < stream::kRejectReasons; ++i) totals.rejected[i] = i + 1;
  shown.engine.channels = 2;
  shown.engine.silent_channels = 1;
  shown.engine.forgotten_channels = 7;
  for (std::size_t i = 0; i < stream::kHealthStates; ++i) {
    shown.engine.channels_by_health[i] = i + 1;
    shown.engine.health_changes[i] = 10 * (i + 1);
  }
  shown.engine.queued_windows = 6;
  shown.engine.workers = 4;
  shown.engine.workers_busy = 3;
  for (const double seconds : {20e-6, 0.0015, 0.0015, 0.3, 60.0}) shown.engine.window_time.add(seconds);
  shown.engine.added_latency.add(0.004);
  shown.channels = {busy_sensor("imu_front"), new_sensor("imu_rear")};
  shown.bus = {
      .matched_writers = 2,
      .malformed_messages = 21,
      .refusals = 22,
      .write_errors = 23,
      .ros2_topics = 24,
      .ros2_refused_topics = 25,
      .ros2_dropped_messages = 26,
      .certificate_expiry_s = 1.8e9,
      .refused_peers = 37,
      .deadlines_missed = 47,
      .liveliness_lost = 48,
      .incompatible_peers = {{"input", "reliability", 3}, {"output", "type", 0}},
      .matched_readers = {{"gyro/denoised", 63}, {"gyro/noise", 0}},
      .standby = StandbySnapshot{.others = 57, .sensors = 58, .held = 59, .let_go = 60, .takeovers = 61}};
  shown.fleet = {.shard = "2/3",
                 .active = true,
                 .peers = 27,
                 .twins = 28,
                 .overlapping = 29,
                 .missing = 30,
                 .disputes = 31,
                 .foreign_samples = 32};
  shown.state_file_errors = 62;
  for (std::size_t i = 0; i < shown.http.answers.size(); ++i) shown.http.answers[i] = 100 + i;
  for (std::size_t i = 0; i < kRefusals; ++i) shown.http.refusals[i] = 200 + i;
  return shown;
}

/// @param shown outlives the view; not to be changed while a monitor runs on it
inline View view_of(const Shown& shown) {
  return {.engine = [&shown] { return shown.engine; },
          .visit_channels =
              [&shown](std::size_t limit, const ChannelVisitor& visit) {
                for (std::size_t i = 0; i < std::min(limit, shown.channels.size()); ++i)
                  visit(shown.channels[i]);
              },
          .channel = [&shown](std::string_view sensor) -> std::optional<stream::ChannelSnapshot> {
            const auto found = std::ranges::find(shown.channels, sensor, &stream::ChannelSnapshot::sensor);
            return found == shown.channels.end() ? std::nullopt : std::optional(*found);
          },
          .bus = [&shown] { return shown.bus; },
          .fleet = [&shown] { return shown.fleet; },
          .readiness = [&shown] { return shown.readiness; },
          .state_file_errors = [&shown] { return shown.state_file_errors; },
          .config = [] { return std::string(R"({"bus": {"domain": 3}})"); },
          .input = {.domain = 3,
                    .topics = {"gyro/raw", "gyro/raw_batch"},
                    .simulate_command = "gyrod simulate --domain 3"}};
}

}  // namespace gyrod::monitor::test
