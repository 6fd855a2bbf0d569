#include "app/allan_files.hpp"

#include <optional>
#include <vector>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "app/allan_units.hpp"
#include "app/version.hpp"
#include "files/number_text.hpp"

namespace gyrod::app {
namespace {

using core::Coefficient;
using core::NoiseTerm;
using Json = nlohmann::ordered_json;

Json in_unit(const Coefficient& coefficient, double factor, const char* unit) {
  return {{"value", factor * coefficient.value},
          {"standard_error", factor * coefficient.standard_error},
          {"unit", unit}};
}

Json coefficients_json(const AllanChannel& channel, const core::NoiseCoefficients& coefficients) {
  Json all = Json::object();
  for (const CoefficientUnit& unit : coefficient_units(channel.sensor)) {
    const Coefficient& coefficient = coefficients[unit.term];
    Json& entry = all[unit.key];
    entry["observable"] = coefficient.observable;
    const double factor = in_sheet_unit(channel.sensor, unit.term, 1.0);
    entry["si"] = coefficient.observable ? in_unit(coefficient, 1.0, unit.si) : Json();
    entry["data_sheet"] = coefficient.observable ? in_unit(coefficient, factor, unit.sheet) : Json();
  }
  return all;
}

/// Names of values in SI end in this.
std::string si_suffix(const AllanChannel& channel) {
  return deviation_unit(channel.sensor, files::RateUnit::kRadps).suffix;
}

Json per_sample_json(const AllanChannel& channel, double sample_rate_hz) {
  const Coefficient& quantization = channel.fit[NoiseTerm::kQuantization];
  const Coefficient& white = channel.fit[NoiseTerm::kAngleRandomWalk];
  const Coefficient& walk = channel.fit[NoiseTerm::kRateRandomWalk];
  const auto or_null = [](const Coefficient& coefficient, double value) {
    return coefficient.observable ? Json(value) : Json();
  };
  const std::string unit = si_suffix(channel);
  return {
      {"white_noise_std_" + unit, or_null(white, core::white_noise_per_sample(white.value, sample_rate_hz))},
      {"random_walk_step_std_" + unit,
       or_null(walk, core::random_walk_step_per_sample(walk.value, sample_rate_hz))},
      {"quantization_std_" + unit,
       or_null(quantization, core::quantization_per_sample(quantization.value, sample_rate_hz))}};
}

Json points_json(const AllanChannel& channel) {
  const std::string unit = si_suffix(channel);
  Json points = Json::array();
  for (const core::AllanPoint& point : channel.points) {
    points.push_back({{"tau_s", point.tau_s},
                      {"cluster_samples", point.cluster_samples},
                      {"terms", point.terms},
                      {"deviation_" + unit, point.deviation},
                      {"lower_" + unit, point.lower},
                      {"upper_" + unit, point.upper},
                      {"edf", point.edf},
                      {"fit_" + unit, core::model_deviation(channel.fit, point.tau_s)}});
  }
  return points;
}

Json channel_json(const AllanChannel& channel, double sample_rate_hz) {
  return {{"mean_" + si_suffix(channel), channel.mean},
          {"least_squares", coefficients_json(channel, channel.fit)},
          {"slope_method", coefficients_json(channel, channel.slopes)},
          {"polynomial_fit", coefficients_json(channel, channel.polynomial)},
          {"per_sample", per_sample_json(channel, sample_rate_hz)},
          {"points", points_json(channel)}};
}

/// The largest of a term over the axes of a sensor.
struct Largest {
  const AllanChannel* channel = nullptr;
  double value = 0.0;
  std::string hidden;  ///< axes that do not show it, "x, y"
};

Largest largest_of(const AllanAnalysis& analysis, SensorKind sensor, NoiseTerm term) {
  Largest largest;
  for (const AllanChannel& channel : analysis.channels) {
    if (channel.sensor != sensor) continue;
    const Coefficient& coefficient = channel.fit[term];
    if (!coefficient.observable) {
      largest.hidden += (largest.hidden.empty() ? "" : ", ") + std::string(1, channel.axis);
    } else if (coefficient.value > largest.value) {
      largest.value = coefficient.value;
      largest.channel = &channel;
    }
  }
  return largest;
}

std::string yaml_line(const AllanAnalysis& analysis, SensorKind sensor, NoiseTerm term,
                      const std::string& key) {
  const CoefficientUnit& unit = coefficient_units(sensor)[static_cast<std::size_t>(term)];
  const Largest largest = largest_of(analysis, sensor, term);
  if (largest.channel == nullptr) {
    return fmt::format("# {}: {}\n", key,
                       largest.hidden.empty() ? "the recording has no such columns"
                                              : "not observable in this recording, no axis shows it");
  }
  std::string comment = fmt::format("{}, axis {} (the largest)", unit.si, largest.channel->axis);
  if (!largest.hidden.empty()) comment += "; not observable on " + largest.hidden;
  return fmt::format("{}: {:.6e}  # {}\n", key, largest.value, comment);
}

}  // namespace

std::string allan_json(const AllanAnalysis& analysis) {
  Json channels = Json::object();
  for (const AllanChannel& channel : analysis.channels) {
    channels[channel.name()] = channel_json(channel, analysis.sample_rate_hz);
  }
  const files::Record::Counts& rows = analysis.rows;
  const Json document = {{"gyrod_version", version()},
                         {"input", analysis.input},
                         {"sample_rate_hz", analysis.sample_rate_hz},
                         {"sample_rate_given", analysis.rate_given},
                         {"samples", analysis.samples},
                         {"rows",
                          {{"read", rows.rows},
                           {"broken", rows.broken},
                           {"refused", rows.refused},
                           {"missing", rows.missing},
                           {"bridged", rows.bridged},
                           {"gaps", rows.gaps},
                           {"left_out", rows.left_out}}},
                         {"notes", analysis.notes},
                         {"confidence", analysis.options.confidence},
                         {"longest_tau_part", analysis.options.longest_part},
                         {"channels", channels}};
  return document.dump(2) + "\n";
}

std::string allan_csv(const AllanAnalysis& analysis, files::RateUnit unit) {
  std::string text = "tau_s,cluster_samples,terms";
  for (const AllanChannel& channel : analysis.channels) {
    const std::string suffix = deviation_unit(channel.sensor, unit).suffix;
    const std::string name = channel.name();
    text += fmt::format(",{0}_deviation_{1},{0}_lower_{1},{0}_upper_{1},{0}_edf,{0}_fit_{1}", name, suffix);
  }
  text += "\n";
  const std::size_t rows = analysis.channels.empty() ? 0 : analysis.channels.front().points.size();
  for (std::size_t row = 0; row < rows; ++row) {
    const core::AllanPoint& first = analysis.channels.front().points[row];
    files::append_number(text, first.tau_s);
    text += fmt::format(",{},{}", first.cluster_samples, first.terms);
    for (const AllanChannel& channel : analysis.channels) {
      const core::AllanPoint& point = channel.points[row];
      const double si = deviation_unit(channel.sensor, unit).si;
      const double fit = core::model_deviation(channel.fit, point.tau_s);
      for (const double value :
           {point.deviation / si, point.lower / si, point.upper / si, point.edf, fit / si}) {
        text += ",";
        files::append_number(text, value);
      }
    }
    text += "\n";
  }
  return text;
}

std::string kalibr_imu_yaml(const AllanAnalysis& analysis, const std::string& ros_topic) {
  using enum SensorKind;
  return std::string("# Made by gyrod ") + version() + " from " + analysis.input +
         " (overlapping Allan deviation, docs/allan.md).\n" +
         "# Continuous time, SI units. One value for all axes: that of the noisiest.\n"
         "# What a recording does not show stands here as a comment: take it from the data sheet or record "
         "longer.\n" +
         yaml_line(analysis, kAccelerometer, NoiseTerm::kAngleRandomWalk, "accelerometer_noise_density") +
         yaml_line(analysis, kAccelerometer, NoiseTerm::kRateRandomWalk, "accelerometer_random_walk") +
         yaml_line(analysis, kGyro, NoiseTerm::kAngleRandomWalk, "gyroscope_noise_density") +
         yaml_line(analysis, kGyro, NoiseTerm::kRateRandomWalk, "gyroscope_random_walk") +
         "rostopic: " + ros_topic + fmt::format("\nupdate_rate: {:.6g}  # Hz\n", analysis.sample_rate_hz);
}

}  // namespace gyrod::app
