#include "monitor/sensor_metrics.hpp"

#include <array>
#include <cstdint>
#include <optional>

#include "monitor/metric_builders.hpp"
#include "monitor/sensor_figures.hpp"

namespace gyrod::monitor {
namespace {

using core::WindowReport;
using stream::ChannelSnapshot;
constexpr double kSecondsPerNanosecond = 1e-9;

Value number(std::uint64_t value) { return static_cast<double>(value); }

Value after_first_window(const ChannelSnapshot& sensor, double value) {
  return has_report(sensor) ? Value(value) : std::nullopt;
}

Value at_rest(const ChannelSnapshot& sensor, std::size_t /*axis*/) {
  const std::optional<bool>& known = sensor.last_report.at_rest;
  return known ? Value(*known ? 1.0 : 0.0) : std::nullopt;
}

const WindowReport& window_of(const ChannelSnapshot& sensor, std::size_t axis) {
  return sensor.last_report.axis[axis];
}

Value reduction(const ChannelSnapshot& sensor, std::size_t axis) {
  const WindowReport& window = window_of(sensor, axis);
  return has_report(sensor) && window.noise_floor > 0.0
             ? Value(1.0 - window.output_noise / window.noise_floor)
             : std::nullopt;
}

Value normalised_innovation(const ChannelSnapshot& sensor, std::size_t axis) {
  const auto& fit = sensor.last_report.model_fit;
  return has_report(sensor) && fit ? Value((*fit)[axis].normalised_innovation) : std::nullopt;
}

Value model_misfit(const ChannelSnapshot& sensor, std::size_t axis) {
  const auto& fit = sensor.last_report.model_fit;
  return has_report(sensor) && fit ? Value((*fit)[axis].misfit ? 1.0 : 0.0) : std::nullopt;
}

constexpr std::array<SensorMetric, 28> kSensorMetrics = {{
    {"gyrod_sensor_samples_received_total", "Samples of the sensor that arrived.", kCounter, false,
     [](const ChannelSnapshot& s, std::size_t) { return number(s.counts.received); }},
    {"gyrod_sensor_samples_published_total", "Samples of the sensor released.", kCounter, false,
     [](const ChannelSnapshot& s, std::size_t) { return number(s.counts.published); }},
    {"gyrod_sensor_samples_rejected_total", "Samples of the sensor refused, all reasons.", kCounter, false,
     [](const ChannelSnapshot& s, std::size_t) { return number(s.counts.rejected_total()); }},
    {"gyrod_sensor_samples_missing_total", "Samples of the sensor that never arrived.", kCounter, false,
     [](const ChannelSnapshot& s, std::size_t) { return number(s.counts.missing); }},
    {"gyrod_sensor_gaps_total", "Gaps of the sensor too long to bridge.", kCounter, false,
     [](const ChannelSnapshot& s, std::size_t) { return number(s.counts.gaps); }},
    {"gyrod_sensor_windows_total", "Windows of the sensor processed.", kCounter, false,
     [](const ChannelSnapshot& s, std::size_t) { return number(s.counts.windows); }},
    {"gyrod_sensor_queued_windows", "Windows of the sensor that wait for a worker.", kGauge, false,
     [](const ChannelSnapshot& s, std::size_t) { return number(s.queued_windows); }},
    {"gyrod_sensor_hop_samples",
     "Samples between windows now; twice as many for fast sensors, widens under overload.", kGauge, false,
     [](const ChannelSnapshot& s, std::size_t) { return number(s.hop_samples); }},
    {"gyrod_sensor_sample_rate_hertz", "Sample rate in use.", kGauge, false,
     [](const ChannelSnapshot& s, std::size_t) { return known(s.sample_rate_hz); }},
    {"gyrod_sensor_overload_step", "0 normal, 1 hop widened, 2 samples pass through undenoised.", kGauge,
     false, [](const ChannelSnapshot& s, std::size_t) { return Value(overload_step(s)); }},
    {"gyrod_sensor_noise_source",
     "Where the noise floor comes from: 0 none, 1 IMF 1, 2 standstill, 3 calibrated.", kGauge, false,
     [](const ChannelSnapshot& s, std::size_t) {
       return after_first_window(s, static_cast<double>(s.last_report.noise_source));
     }},
    {"gyrod_sensor_samples_realtime_total", "Samples of the sensor estimated without look-ahead too.",
     kCounter, false, [](const ChannelSnapshot& s, std::size_t) { return number(s.counts.realtime); }},
    {"gyrod_sensor_model_misfits_total",
     "Times the model of an axis of the sensor ceased to explain the input.", kCounter, false,
     [](const ChannelSnapshot& s, std::size_t) { return number(s.counts.misfits); }},
    {"gyrod_sensor_silent", "1 where the sensor has sent nothing for limits.silent_after_s.", kGauge, false,
     [](const ChannelSnapshot& s, std::size_t) { return Value(stream::is_silent(s.state) ? 1.0 : 0.0); }},
    {"gyrod_sensor_state",
     "0 sends, 1 silent, 2 silent: deadline missed, 3 silent: liveliness lost, 4 ended.", kGauge, false,
     [](const ChannelSnapshot& s, std::size_t) { return number(static_cast<std::uint64_t>(s.state)); }},
    {"gyrod_sensor_silences_total", "Times the sensor sent nothing for so long that its window was closed.",
     kCounter, false, [](const ChannelSnapshot& s, std::size_t) { return number(s.counts.silences); }},
    {"gyrod_sensor_at_rest", "1 where the sensor was at rest at its last window's end.", kGauge, false,
     at_rest},
    {"gyrod_sensor_last_window_duration_seconds", "Time a worker spent on the sensor's last window.", kGauge,
     false,
     [](const ChannelSnapshot& s, std::size_t) {
       return after_first_window(s, s.last_report.window_time_s);
     }},
    {"gyrod_sensor_last_window_timestamp_seconds", "Stamp of the newest sample of the sensor's last window.",
     kGauge, false,
     [](const ChannelSnapshot& s, std::size_t) {
       return after_first_window(s, static_cast<double>(s.last_report.last_stamp_ns) * kSecondsPerNanosecond);
     }},

    {"gyrod_axis_noise_floor_radians_per_second", "Standard deviation of the input's white noise.", kGauge,
     true,
     [](const ChannelSnapshot& s, std::size_t axis) {
       return known(has_report(s) ? window_of(s, axis).noise_floor : 0.0);
     }},
    {"gyrod_axis_output_noise_radians_per_second",
     "Estimated standard deviation of the noise left in the output.", kGauge, true,
     [](const ChannelSnapshot& s, std::size_t axis) {
       return known(has_report(s) ? window_of(s, axis).output_noise : 0.0);
     }},
    {"gyrod_axis_noise_reduction_ratio", "Part of the noise's standard deviation that is removed, at most 1.",
     kGauge, true, reduction},
    {"gyrod_axis_mean_radians_per_second", "Mean of the last window.", kGauge, true,
     [](const ChannelSnapshot& s, std::size_t axis) {
       return after_first_window(s, window_of(s, axis).mean);
     }},
    {"gyrod_axis_imfs", "Modes of the last window.", kGauge, true,
     [](const ChannelSnapshot& s, std::size_t axis) {
       return after_first_window(s, static_cast<double>(window_of(s, axis).imf_count));
     }},
    {"gyrod_axis_noise_imfs", "j: modes 1 to j of the last window are noise.", kGauge, true,
     [](const ChannelSnapshot& s, std::size_t axis) {
       return after_first_window(s, static_cast<double>(window_of(s, axis).j));
     }},
    {"gyrod_axis_filtered_imfs", "k: modes j+1 to k of the last window are filtered.", kGauge, true,
     [](const ChannelSnapshot& s, std::size_t axis) {
       return after_first_window(s, static_cast<double>(window_of(s, axis).k));
     }},
    {"gyrod_axis_normalised_innovation",
     "Mean square of the model's prediction errors over what the model says; 1 where it holds.", kGauge, true,
     normalised_innovation},
    {"gyrod_axis_model_misfit",
     "1 where the model of the axis did not explain the input at the last window's end.", kGauge, true,
     model_misfit},
}};

}  // namespace

std::span<const SensorMetric> sensor_metrics() noexcept { return kSensorMetrics; }

}  // namespace gyrod::monitor
