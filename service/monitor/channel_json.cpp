#include "monitor/channel_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/allan/online_allan.hpp"
#include "monitor/channel_rows.hpp"
#include "monitor/sensor_figures.hpp"

namespace gyrod::monitor {
namespace {

using core::NoiseTerm;

std::string_view name_of(core::ImfClass imf) noexcept {
  switch (imf) {
    case core::ImfClass::kNoise:
      return "noise";
    case core::ImfClass::kMixed:
      return "mixed";
    case core::ImfClass::kSignal:
      break;
  }
  return "signal";
}

std::string_view name_of(core::ModelFamily family) noexcept {
  switch (family) {
    case core::ModelFamily::kNone:
      break;
    case core::ModelFamily::kWhite:
      return "white";
    case core::ModelFamily::kAr:
      return "ar";
    case core::ModelFamily::kMa:
      return "ma";
    case core::ModelFamily::kArma:
      return "arma";
  }
  return "none";
}

Json flags_of(std::uint32_t flags) {
  using stream::SampleFlag;
  constexpr std::array<std::pair<SampleFlag, const char*>, 5> kNames = {
      {{SampleFlag::kWarmingUp, "warming_up"},
       {SampleFlag::kTail, "tail"},
       {SampleFlag::kPassThrough, "pass_through"},
       {SampleFlag::kHopWidened, "hop_widened"},
       {SampleFlag::kModelMisfit, "model_misfit"}}};
  Json names = Json::array();
  for (const auto& [flag, name] : kNames) {
    if ((flags & static_cast<std::uint32_t>(flag)) != 0) names.push_back(name);
  }
  return names;
}

Json json_of(const core::ModelFigures& model) {
  if (model.family == core::ModelFamily::kNone) return nullptr;
  return {{"family", name_of(model.family)},
          {"ar_order", model.ar_order},
          {"ma_order", model.ma_order},
          {"innovation_std_radps", std::sqrt(model.innovation_variance)},
          {"used", model.used}};
}

/// @param rate_hz 0 while unknown
Json json_of(const core::ImfFigures& imf, double rate_hz) {
  // Where the floor is unknown or the noise line does not hold, all of these are 0.
  const bool correlated = imf.acf_variance > 0.0;  // by the paper's rules only
  const bool tested = imf.noise_excess_high > 0.0;
  return {{"class", name_of(imf.imf_class)},
          {"mean_period_s", rate_hz > 0.0 ? json_if_known(imf.mean_period_samples / rate_hz) : Json(nullptr)},
          {"mean_period_samples", json_if_known(imf.mean_period_samples)},
          {"energy", imf.energy},
          {"rms_radps", std::sqrt(imf.energy)},
          {"pcc", correlated ? monitor::json_of(Value(imf.pcc)) : Json(nullptr)},
          {"acf_variance", correlated ? monitor::json_of(Value(imf.acf_variance)) : Json(nullptr)},
          {"acf_concentration", correlated ? monitor::json_of(Value(imf.acf_concentration)) : Json(nullptr)},
          {"excess", json_if_known(imf.excess)},
          {"noise_excess_low", tested ? monitor::json_of(Value(imf.noise_excess_low)) : Json(nullptr)},
          {"noise_excess_high", tested ? monitor::json_of(Value(imf.noise_excess_high)) : Json(nullptr)},
          {"noise_probability", tested ? monitor::json_of(Value(imf.noise_probability)) : Json(nullptr)},
          {"model", json_of(imf.model)}};
}

Json tone_of(const stream::ChannelSnapshot& sensor, std::size_t axis) {
  const Value frequency = tone_frequency(sensor, axis);
  if (!frequency) return nullptr;
  return {{"frequency_hz", *frequency}, {"amplitude_radps", sensor.last_report.axis[axis].tone_amplitude}};
}

Json fit_of(const stream::NoiseReport& report, std::size_t axis) {
  if (!report.model_fit) return nullptr;
  const stream::ModelFit& fit = (*report.model_fit)[axis];
  return {{"normalised_innovation", fit.normalised_innovation},
          {"misfit", fit.misfit},
          {"misfits", fit.misfits},
          {"fallbacks", fit.fallbacks},
          {"wrong_noise", fit.wrong_noise},
          {"noise_ratio", fit.noise_ratio},
          {"hidden_noise", fit.hidden_noise}};
}

Json axis_json(const stream::ChannelSnapshot& sensor, std::size_t axis) {
  const core::WindowReport& window = sensor.last_report.axis[axis];
  Json imfs = Json::array();
  for (std::size_t i = 0; i < window.imf_count; ++i)
    imfs.push_back(json_of(window.imf[i], sensor.last_report.sample_rate_hz));
  return {{"j", window.j},
          {"k", window.k},
          {"modes", window.modes},
          {"mean_radps", window.mean},
          {"noise_floor_radps", json_if_known(window.noise_floor)},
          {"output_noise_radps", json_if_known(window.output_noise)},
          {"tone", tone_of(sensor, axis)},
          {"fit", fit_of(sensor.last_report, axis)},
          {"imfs", std::move(imfs)}};
}

Json report_json(const stream::ChannelSnapshot& sensor) {
  if (!has_report(sensor)) return nullptr;
  const stream::NoiseReport& report = sensor.last_report;
  Json axes = Json::array();
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) axes.push_back(axis_json(sensor, axis));
  return {{"model_epoch", report.model_epoch},
          {"window_samples", report.axis[0].window_samples},
          {"window_time_s", report.window_time_s},
          {"lag_samples", report.lag_samples},
          {"hop_samples", report.hop_samples},
          {"sample_rate_hz", json_if_known(report.sample_rate_hz)},
          {"last_sequence", std::to_string(report.last_sequence)},
          {"last_stamp_ns", json_of_stamp(report.last_stamp_ns)},
          {"flags", flags_of(report.flags)},
          {"axes", std::move(axes)}};
}

Json bias_json(const stream::ChannelSnapshot& sensor) {
  if (!(sensor.bias_s > 0.0)) return nullptr;
  return {{"axes_radps", sensor.bias_radps}, {"seconds", sensor.bias_s}};
}

/// Where the terms are read off the curve, s: B at its floor, which lies at 100 s or beyond with MEMS gyros.
constexpr double kTauOfN = 1.0;
constexpr double kTauOfB = 100.0;

/// Rest, s, after which the deviation at a cluster time is known to a quarter: T seconds of white noise give it the relative standard error
///   1 / sqrt(2 (T / tau - 1)).
/// Source: IEEE Std 952-1997, annex C. Overlapping clusters do no worse. No term shows sooner; later it does if the fit finds it.
double rest_for(double tau_s) {
  constexpr double kError = 0.25;
  return tau_s * (1.0 + 1.0 / (2.0 * kError * kError));
}

Value needs(const stream::ChannelSnapshot& sensor, std::size_t axis) {
  if (!coefficient(sensor, axis, NoiseTerm::kAngleRandomWalk)) return rest_for(kTauOfN);
  if (!coefficient(sensor, axis, NoiseTerm::kBiasInstability)) return rest_for(kTauOfB);
  return std::nullopt;
}

Json allan_axis(const stream::ChannelSnapshot& sensor, std::size_t axis) {
  Json tau = Json::array();
  Json deviation = Json::array();
  Json terms = Json::array();
  if (sensor.curves_rate_hz > 0.0) {
    for (const core::AllanPoint& point : core::allan_points(sensor.curves[axis], sensor.curves_rate_hz)) {
      tau.push_back(point.tau_s);
      deviation.push_back(point.deviation);
      terms.push_back(point.terms);
    }
  }
  const auto term = [&](NoiseTerm which) { return monitor::json_of(coefficient(sensor, axis, which)); };
  return {{"tau_s", std::move(tau)},
          {"deviation_radps", std::move(deviation)},
          {"terms", std::move(terms)},
          {"angle_random_walk_radps_sqrt_hz", term(NoiseTerm::kAngleRandomWalk)},
          {"bias_instability_radps", term(NoiseTerm::kBiasInstability)},
          {"rate_random_walk_radps_sqrt_s", term(NoiseTerm::kRateRandomWalk)},
          {"needs_s", monitor::json_of(needs(sensor, axis))}};
}

Json allan_json(const stream::ChannelSnapshot& sensor) {
  Json axes = Json::array();
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) axes.push_back(allan_axis(sensor, axis));
  return {{"at_rest_s", monitor::json_of(rest_seconds(sensor))}, {"axes", std::move(axes)}};
}

}  // namespace

Json channel_json(const stream::ChannelSnapshot& sensor, double time_s) {
  Json json = json_of(row_of(sensor));
  json["time_s"] = time_s;
  json["counts"] = json_of(sensor.counts);
  json["queued_windows"] = sensor.queued_windows;
  json["last_stamp_ns"] =
      has_report(sensor) ? json_of_stamp(sensor.last_report.last_stamp_ns) : Json(nullptr);
  json["report"] = report_json(sensor);
  json["bias"] = bias_json(sensor);
  json["allan"] = allan_json(sensor);
  return json;
}

}  // namespace gyrod::monitor
