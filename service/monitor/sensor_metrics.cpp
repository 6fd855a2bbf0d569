#include "monitor/sensor_metrics.hpp"

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "monitor/metric_builders.hpp"

namespace gyrod::monitor {
namespace {

using core::WindowReport;
using stream::ChannelSnapshot;
using Families = std::vector<prometheus::MetricFamily>;
using Value = std::optional<double>;
constexpr double kSecondsPerNanosecond = 1e-9;

template <class Source>
struct Metric {
  const char* name;
  const char* help;
  prometheus::MetricType type;
  Value (*value)(const Source&);
};

Value number(std::uint64_t value) { return static_cast<double>(value); }

/// Nothing for a figure whose 0 means "not known".
Value known(double value) { return value > 0.0 ? Value(value) : std::nullopt; }

bool has_report(const ChannelSnapshot& sensor) { return sensor.last_report.model_epoch > 0; }

Value after_first_window(const ChannelSnapshot& sensor, double value) {
  return has_report(sensor) ? Value(value) : std::nullopt;
}

/// 0 normal, 1 hop widened, 2 passed through.
Value overload_step(const ChannelSnapshot& sensor) {
  if (sensor.pass_through) return 2.0;
  const bool widened =
      (sensor.last_report.flags & static_cast<std::uint32_t>(stream::SampleFlag::kHopWidened)) != 0;
  return widened ? 1.0 : 0.0;
}

Value at_rest(const ChannelSnapshot& sensor) {
  const std::optional<bool>& known = sensor.last_report.at_rest;
  return known ? Value(*known ? 1.0 : 0.0) : std::nullopt;
}

constexpr std::array<Metric<ChannelSnapshot>, 19> kOfSensor = {{
    {"gyrod_sensor_samples_received_total", "Samples of the sensor that arrived.", kCounter,
     [](const ChannelSnapshot& s) { return number(s.counts.received); }},
    {"gyrod_sensor_samples_published_total", "Samples of the sensor released.", kCounter,
     [](const ChannelSnapshot& s) { return number(s.counts.published); }},
    {"gyrod_sensor_samples_rejected_total", "Samples of the sensor refused, all reasons.", kCounter,
     [](const ChannelSnapshot& s) { return number(s.counts.rejected_total()); }},
    {"gyrod_sensor_samples_missing_total", "Samples of the sensor that never arrived.", kCounter,
     [](const ChannelSnapshot& s) { return number(s.counts.missing); }},
    {"gyrod_sensor_gaps_total", "Gaps of the sensor too long to bridge.", kCounter,
     [](const ChannelSnapshot& s) { return number(s.counts.gaps); }},
    {"gyrod_sensor_windows_total", "Windows of the sensor processed.", kCounter,
     [](const ChannelSnapshot& s) { return number(s.counts.windows); }},
    {"gyrod_sensor_queued_windows", "Windows of the sensor that wait for a worker.", kGauge,
     [](const ChannelSnapshot& s) { return number(s.queued_windows); }},
    {"gyrod_sensor_hop_samples", "Samples between windows now; widens under overload.", kGauge,
     [](const ChannelSnapshot& s) { return number(s.hop_samples); }},
    {"gyrod_sensor_sample_rate_hertz", "Sample rate in use.", kGauge,
     [](const ChannelSnapshot& s) { return known(s.sample_rate_hz); }},
    {"gyrod_sensor_overload_step", "0 normal, 1 hop widened, 2 samples pass through undenoised.", kGauge,
     overload_step},
    {"gyrod_sensor_noise_source",
     "Where the noise floor comes from: 0 none, 1 IMF 1, 2 standstill, 3 calibrated.", kGauge,
     [](const ChannelSnapshot& s) {
       return after_first_window(s, static_cast<double>(s.last_report.noise_source));
     }},
    {"gyrod_sensor_samples_realtime_total", "Samples of the sensor estimated without look-ahead too.",
     kCounter, [](const ChannelSnapshot& s) { return number(s.counts.realtime); }},
    {"gyrod_sensor_model_misfits_total",
     "Times the model of an axis of the sensor ceased to explain the input.", kCounter,
     [](const ChannelSnapshot& s) { return number(s.counts.misfits); }},
    {"gyrod_sensor_silent", "1 where the sensor has sent nothing for limits.silent_after_s.", kGauge,
     [](const ChannelSnapshot& s) { return Value(stream::is_silent(s.state) ? 1.0 : 0.0); }},
    {"gyrod_sensor_state",
     "0 sends, 1 silent, 2 silent: deadline missed, 3 silent: liveliness lost, 4 ended.", kGauge,
     [](const ChannelSnapshot& s) { return number(static_cast<std::uint64_t>(s.state)); }},
    {"gyrod_sensor_silences_total", "Times the sensor sent nothing for so long that its window was closed.",
     kCounter, [](const ChannelSnapshot& s) { return number(s.counts.silences); }},
    {"gyrod_sensor_at_rest", "1 where the sensor was at rest at its last window's end.", kGauge, at_rest},
    {"gyrod_sensor_last_window_duration_seconds", "Time a worker spent on the sensor's last window.", kGauge,
     [](const ChannelSnapshot& s) { return after_first_window(s, s.last_report.window_time_s); }},
    {"gyrod_sensor_last_window_timestamp_seconds", "Stamp of the newest sample of the sensor's last window.",
     kGauge,
     [](const ChannelSnapshot& s) {
       return after_first_window(s, static_cast<double>(s.last_report.last_stamp_ns) * kSecondsPerNanosecond);
     }},
}};

/// What the last report says of one axis.
struct AxisView {
  const WindowReport& window;
  const stream::ModelFit* fit;  ///< none with a window method
};

Value reduction(const AxisView& axis) {
  const WindowReport& window = axis.window;
  return window.noise_floor > 0.0 ? Value(1.0 - window.output_noise / window.noise_floor) : std::nullopt;
}

Value normalised_innovation(const AxisView& axis) {
  return axis.fit != nullptr ? Value(axis.fit->normalised_innovation) : std::nullopt;
}

constexpr std::array<Metric<AxisView>, 8> kOfAxis = {{
    {"gyrod_axis_noise_floor_radians_per_second", "Standard deviation of the input's white noise.", kGauge,
     [](const AxisView& axis) { return known(axis.window.noise_floor); }},
    {"gyrod_axis_output_noise_radians_per_second",
     "Estimated standard deviation of the noise left in the output.", kGauge,
     [](const AxisView& axis) { return known(axis.window.output_noise); }},
    {"gyrod_axis_noise_reduction_ratio", "Part of the noise's standard deviation that is removed, at most 1.",
     kGauge, reduction},
    {"gyrod_axis_mean_radians_per_second", "Mean of the last window.", kGauge,
     [](const AxisView& axis) { return Value(axis.window.mean); }},
    {"gyrod_axis_imfs", "Modes of the last window.", kGauge,
     [](const AxisView& axis) { return number(axis.window.imf_count); }},
    {"gyrod_axis_noise_imfs", "j: modes 1 to j of the last window are noise.", kGauge,
     [](const AxisView& axis) { return number(axis.window.j); }},
    {"gyrod_axis_filtered_imfs", "k: modes j+1 to k of the last window are filtered.", kGauge,
     [](const AxisView& axis) { return number(axis.window.k); }},
    {"gyrod_axis_normalised_innovation",
     "Mean square of the model's prediction errors over what the model says; 1 where it holds.", kGauge,
     normalised_innovation},
}};

prometheus::MetricFamily of_sensors(const Metric<ChannelSnapshot>& kind,
                                    std::span<const ChannelSnapshot> shown) {
  prometheus::MetricFamily made = family(kind.name, kind.help, kind.type);
  made.metric.reserve(shown.size());
  for (const ChannelSnapshot& sensor : shown) {
    const Value value = kind.value(sensor);
    if (value) made.metric.push_back(metric(kind.type, *value, {{"sensor", sensor.sensor}}));
  }
  return made;
}

prometheus::MetricFamily of_axes(const Metric<AxisView>& kind, std::span<const ChannelSnapshot> shown) {
  static constexpr std::array<const char*, stream::kAxes> kAxisNames = {"x", "y", "z"};
  prometheus::MetricFamily made = family(kind.name, kind.help, kind.type);
  made.metric.reserve(shown.size() * stream::kAxes);
  for (const ChannelSnapshot& sensor : shown) {
    for (std::size_t axis = 0; has_report(sensor) && axis < stream::kAxes; ++axis) {
      const stream::NoiseReport& report = sensor.last_report;
      const stream::ModelFit* fit = report.model_fit ? &(*report.model_fit)[axis] : nullptr;
      const Value value = kind.value({report.axis[axis], fit});
      if (!value) continue;
      made.metric.push_back(
          metric(kind.type, *value, {{"sensor", sensor.sensor}, {"axis", kAxisNames[axis]}}));
    }
  }
  return made;
}

}  // namespace

void add_sensor_metrics(std::span<const ChannelSnapshot> shown, std::size_t sensors, Families& families) {
  const std::size_t omitted = sensors > shown.size() ? sensors - shown.size() : 0;
  families.push_back(single("gyrod_sensors_omitted",
                            "Sensors without series of their own (monitor.max_channel_series).", kGauge,
                            static_cast<double>(omitted)));
  for (const auto& kind : kOfSensor) families.push_back(of_sensors(kind, shown));
  for (const auto& kind : kOfAxis) families.push_back(of_axes(kind, shown));
}

}  // namespace gyrod::monitor
