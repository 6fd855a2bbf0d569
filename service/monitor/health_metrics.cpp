#include "monitor/health_metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "monitor/metric_builders.hpp"
#include "monitor/sensor_figures.hpp"

namespace gyrod::monitor {
namespace {

using core::NoiseTerm;
using stream::ChannelSnapshot;
using Families = std::vector<prometheus::MetricFamily>;

/// As data sheets state it: of frequencies above 0, up to half the sample rate.
Value noise_density(const ChannelSnapshot& sensor, std::size_t axis) {
  const double rate_hz = sensor.last_report.sample_rate_hz;
  if (!has_report(sensor) || !(rate_hz > 0.0)) return std::nullopt;
  return known(sensor.last_report.axis[axis].noise_floor / std::sqrt(0.5 * rate_hz));
}

Value ar_order(const ChannelSnapshot& sensor, std::size_t axis) {
  const core::WindowReport& window = sensor.last_report.axis[axis];
  std::size_t most = 0;
  for (std::size_t i = 0; i < window.imf_count; ++i) most = std::max(most, window.imf[i].model.ar_order);
  return has_report(sensor) ? known(static_cast<double>(most)) : std::nullopt;
}

constexpr std::array<SensorMetric, 10> kHealthMetrics = {{
    {"gyrod_sensor_health", "State of the sensor: 0 ok to 8 silent, the worst of its axes.", kGauge, false,
     [](const ChannelSnapshot& s, std::size_t) {
       return s.health ? Value(static_cast<double>(s.health->state)) : std::nullopt;
     }},
    {"gyrod_sensor_allan_seconds", "Rest that the sensor's Allan deviation rests on.", kGauge, false,
     [](const ChannelSnapshot& s, std::size_t) { return rest_seconds(s); }},
    {"gyrod_sensor_lag_samples", "Newer samples that a released one has seen.", kGauge, false,
     [](const ChannelSnapshot& s, std::size_t) {
       return has_report(s) ? Value(static_cast<double>(s.last_report.lag_samples)) : std::nullopt;
     }},

    {"gyrod_axis_health", "State of the axis: 0 ok to 8 silent.", kGauge, true,
     [](const ChannelSnapshot& s, std::size_t axis) {
       return s.health ? Value(static_cast<double>(s.health->axis[axis].state)) : std::nullopt;
     }},
    {"gyrod_axis_bias_radians_per_second", "Mean rate at rest, of the last ten minutes of rest.", kGauge,
     true,
     [](const ChannelSnapshot& s, std::size_t axis) {
       return s.bias_s > 0.0 ? Value(s.bias_radps[axis]) : std::nullopt;
     }},
    {"gyrod_axis_noise_density_radians_per_second_per_root_hertz",
     "Noise floor over the root of half the sample rate.", kGauge, true, noise_density},
    {"gyrod_axis_angle_random_walk_radians_per_root_second", "N, from the Allan deviation at rest.", kGauge,
     true,
     [](const ChannelSnapshot& s, std::size_t axis) {
       return coefficient(s, axis, NoiseTerm::kAngleRandomWalk);
     }},
    {"gyrod_axis_bias_instability_radians_per_second", "B, from the Allan deviation at rest.", kGauge, true,
     [](const ChannelSnapshot& s, std::size_t axis) {
       return coefficient(s, axis, NoiseTerm::kBiasInstability);
     }},
    {"gyrod_axis_tone_hertz", "Frequency of the narrow tone that stands out most in the last window.", kGauge,
     true, tone_frequency},
    {"gyrod_axis_ar_order", "Largest order of the last window's AR models.", kGauge, true, ar_order},
}};

prometheus::MetricFamily by_state(const char* name, const char* help, prometheus::MetricType type,
                                  const stream::HealthCounts& counts) {
  prometheus::MetricFamily made = family(name, help, type);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::string state(stream::name_of(static_cast<stream::Health>(i)));
    made.metric.push_back(metric(type, static_cast<double>(counts[i]), {{"state", state}}));
  }
  return made;
}

}  // namespace

void add_health_totals(const stream::EngineSnapshot& engine, Families& families) {
  families.push_back(
      by_state("gyrod_sensors_by_health", "Sensors in each state.", kGauge, engine.channels_by_health));
  families.push_back(by_state("gyrod_health_changes_total",
                              "Events of health, by the state that the sensor is in since.", kCounter,
                              engine.health_changes));
}

std::span<const SensorMetric> health_metrics() noexcept { return kHealthMetrics; }

}  // namespace gyrod::monitor
