#include "app/evaluation_report.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "app/version.hpp"
#include "core/signal/moments.hpp"
#include "settings/enum_names.hpp"
#include "stream/hop_schedule.hpp"

namespace gyrod::app {
namespace {

using report::Json;

constexpr std::array<const char*, 4> kKinds = {"method", "untouched", "filter", "bound"};
constexpr std::array<const char*, 3> kVerdicts = {"pass", "fail", "not applicable"};

Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }
Json value_of(const std::optional<core::Measured>& measured) {
  return measured ? Json(measured->value) : Json(nullptr);
}
Json error_of(const std::optional<core::Measured>& measured) {
  return measured ? Json(measured->standard_error) : Json(nullptr);
}

void add_angle(Json& json, const std::string& window, const std::optional<core::AngleError>& angle) {
  const std::string key = "angle_" + window;
  json[key + "_windows"] = angle ? angle->windows : 0;
  json[key + "_rms_deg"] = angle ? Json(angle->rms) : Json(nullptr);
  json[key + "_mean_deg"] = angle ? Json(angle->mean) : Json(nullptr);
  json[key + "_std_deg"] = angle && angle->windows > 1 ? Json(angle->std) : Json(nullptr);
  json[key + "_max_deg"] = angle ? Json(angle->max_abs) : Json(nullptr);
}

Json lag_json(const JudgedLag& lag) {
  const core::ErrorFigures& figures = lag.figures;
  Json json{{"lag_bound_samples", lag.lag_bound},
            {"lag_samples", lag.lag_samples},
            {"tuning", lag.tuning},
            {"rmse_dps", figures.rmse},
            {"rmse_without_bias_dps", figures.rmse_without_bias},
            {"bias_dps", value_of(figures.bias)},
            {"bias_standard_error_dps", error_of(figures.bias)},
            {"normalised_error", number(figures.normalised_error)},
            {"normalised_error_without_bias", number(figures.normalised_error_without_bias)}};
  add_angle(json, "10s", figures.angle_10s);
  add_angle(json, "60s", figures.angle_60s);
  json["scale_factor"] = value_of(figures.scale_factor);
  json["scale_factor_standard_error"] = error_of(figures.scale_factor);
  json["peak_lag_samples"] = value_of(figures.peak_lag_samples);
  json["peak_lag_standard_error_samples"] = error_of(figures.peak_lag_samples);
  json["samples"] = figures.samples;
  json["lost_truth_samples"] = figures.lost_truth;
  json["lost_estimate_samples"] = figures.lost_estimate;
  return json;
}

Json estimators_json(const JudgedRow& row) {
  Json all = Json::array();
  for (const JudgedEstimator& estimator : row.estimators) {
    Json lags = Json::array();
    for (const JudgedLag& lag : estimator.lags) lags.push_back(lag_json(lag));
    all.push_back(Json{{"name", estimator.name},
                       {"kind", kKinds[static_cast<std::size_t>(estimator.kind)]},
                       {"lags", std::move(lags)}});
  }
  return all;
}

Json guards_json(const JudgedRow& row) {
  Json all = Json::array();
  for (const JudgedGuards& judged : row.guards) {
    for (const core::Guard& guard : judged.guards) {
      all.push_back(Json{{"name", judged.name},
                         {"guard", core::name_of(guard.kind)},
                         {"verdict", kVerdicts[static_cast<std::size_t>(guard.verdict)]},
                         {"value", number(guard.value)},
                         {"standard_error", number(guard.standard_error)},
                         {"limit", guard.limit},
                         {"group_delay_samples", number(guard.group_delay_samples)},
                         {"reason", guard.reason}});
    }
  }
  return all;
}

Json turns_json(const JudgedRow& row) {
  Json all = Json::array();
  for (const JudgedTurn& turn : row.turns) {
    const core::TurnResponse& response = turn.response;
    all.push_back(Json{{"name", turn.name},
                       {"turn", turn.profile},
                       {"half_delay_s", number(response.half_delay_s)},
                       {"half_delay_error_s", number(response.half_delay_error_s)},
                       {"time_95_s", number(response.time_95_s)},
                       {"overshoot", response.overshoot},
                       {"peak_error_dps", response.peak_error_dps},
                       {"trace_start_s", response.trace_start_s},
                       {"trace_dps", report::rounded(response.trace_dps)},
                       {"trace_truth_dps", report::rounded(response.trace_truth_dps)}});
  }
  return all;
}

Json histograms_json(const JudgedRow& row) {
  Json all = Json::array();
  for (const ErrorHistogram& histogram : row.histograms) {
    all.push_back(Json{{"name", histogram.name}, {"shares", report::rounded(histogram.shares)}});
  }
  return Json{{"bin_centres_dps", report::rounded(row.bin_centres_dps)}, {"of", std::move(all)}};
}

/// {"x": "-y"}: of the judged axes.
Json axes_json(const EvaluationRows& rows, const std::array<std::string, 3>& axes) {
  Json json = Json::object();
  for (const std::string& axis : rows.axes) json[axis] = axes[static_cast<std::size_t>(axis[0] - 'x')];
  return json;
}

Json record_json(const EvaluationRows& rows) {
  const bool added = !rows.noise_name.empty();
  return Json{{"name", rows.name},
              {"samples", rows.samples},
              {"sample_rate_hz", rows.rate_hz},
              {"truth_columns", rows.truth_columns},
              {"truth_axes", rows.signal_is_truth ? Json(nullptr) : axes_json(rows, rows.truth_axes)},
              {"noise", added ? Json(rows.noise_name) : Json(nullptr)},
              {"noise_axes", added ? axes_json(rows, rows.noise_axes) : Json(nullptr)},
              {"noise_start_sample", added ? Json(rows.noise_start) : Json(nullptr)},
              {"noise_spare_samples", added ? Json(rows.spare_samples) : Json(nullptr)},
              {"calibration", rows.calibration_file.empty() ? Json(nullptr) : Json(rows.calibration_file)}};
}

Json configuration_json(const EvaluationRows& rows, const EvaluationOptions& options) {
  const stream::EngineOptions& engine = options.settings.engine;
  const unsigned doublings = stream::doublings_at(engine, rows.rate_hz);
  return Json{{"methods", options.methods},
              {"window_samples", engine.window_samples},
              {"hop_samples", engine.hop_samples},
              {"joint_window_samples", engine.window_samples << doublings},
              {"joint_hop_samples", engine.hop_samples << stream::hop_doublings(doublings)},
              {"lag_samples", engine.lag_samples},
              {"max_signal_hz", options.settings.denoise.max_signal_hz},
              {"noise_source", settings::name_of(rows.noise_source)},
              {"turn_repeats", options.turns ? Json(options.turn_repeats) : Json(nullptr)}};
}

Json row_json(const JudgedRow& row) {
  return Json{{"axis", row.axis},
              {"noise_scale", row.noise_scale},
              {"noise_std_dps", row.noise_std_dps},
              {"truth_std_dps", row.truth_std_dps},
              {"noise_model", noise_model_words(row)},
              {"noise_known_from_sample",
               row.noise_known_from_sample ? Json(*row.noise_known_from_sample) : Json(nullptr)},
              {"misfit_share", number(row.misfit_share)},
              {"hidden_noise_share", row.hidden_noise_share},
              {"noise_ratio", row.noise_ratio},
              {"estimators", estimators_json(row)},
              {"guards", guards_json(row)},
              {"turns", turns_json(row)},
              {"histograms", histograms_json(row)}};
}

/// Rows of a list in every row, with axis and noise scale in front and without what is drawn only.
Json with_axis(const Json& evaluation, const char* list) {
  Json all = Json::array();
  for (const Json& row : evaluation.at("rows")) {
    for (const Json& entry : row.at(list)) {
      Json line{{"axis", row.at("axis")}, {"noise_scale", row.at("noise_scale")}};
      for (const auto& [key, value] : entry.items()) {
        if (!key.starts_with("trace_")) line[key] = value;
      }
      all.push_back(std::move(line));
    }
  }
  return all;
}

}  // namespace

Json evaluation_json(const Evaluation& evaluation) {
  const auto& [rows, options, judged] = evaluation;
  Json json{{"format", 1},
            {"made_by", std::string("gyrod ") + version()},
            {"record", record_json(rows)},
            {"configuration", configuration_json(rows, options)},
            {"judged_from_sample", options.range.begin},
            {"judged_to_sample", options.range.end},
            {"lags_samples", options.lag_samples},
            {"own_lag_samples", options.settings.engine.lag_samples},
            {"cautions", cautions_of(evaluation)}};
  json["rows"] = Json::array();
  for (const JudgedRow& row : judged) json["rows"].push_back(row_json(row));
  return json;
}

Json estimator_rows(const Json& evaluation) {
  Json all = Json::array();
  for (const Json& row : evaluation.at("rows")) {
    for (const Json& estimator : row.at("estimators")) {
      for (const Json& lag : estimator.at("lags")) {
        Json line{{"axis", row.at("axis")},
                  {"noise_scale", row.at("noise_scale")},
                  {"noise_std_dps", row.at("noise_std_dps")},
                  {"name", estimator.at("name")},
                  {"kind", estimator.at("kind")}};
        line.update(lag);
        all.push_back(std::move(line));
      }
    }
  }
  return all;
}

Json guard_rows(const Json& evaluation) { return with_axis(evaluation, "guards"); }

Json turn_rows(const Json& evaluation) { return with_axis(evaluation, "turns"); }

}  // namespace gyrod::app
