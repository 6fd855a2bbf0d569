#include "settings/noise_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "settings/noise_model_json.hpp"
#include "stream/registry.hpp"
#include "stream/sample.hpp"

namespace gyrod::settings {
namespace {

using nlohmann::json;
using stream::kAxisNames;

constexpr const char* kStateKey = "gyrod_noise_state";
/// 2 has Allan sums.
constexpr int kStateVersion = 2;
constexpr int kOldestVersion = 1;

bool has_model(const core::StandstillState& state) {
  return std::ranges::any_of(state.models, core::is_usable);
}

/// Octaves without a term are left out at the end: the lists are as long as the curve.
json curve_json(const core::AllanSums& sums) {
  const auto end = std::ranges::find(sums.terms, std::uint64_t{0});
  const auto octaves = static_cast<std::size_t>(end - sums.terms.begin());
  return {{"terms", std::vector(sums.terms.begin(), end)},
          {"squares_rad2ps2", std::vector(sums.squares.begin(), sums.squares.begin() + octaves)}};
}

json curves_json(const stream::AllanCurves& curves) {
  json axes = json::object();
  for (std::size_t a = 0; a < kAxisNames.size(); ++a) {
    if (curves[a].terms[0] > 0) axes[kAxisNames[a]] = curve_json(curves[a]);
  }
  return axes;
}

core::AllanSums curve_of(const JsonFields& fields) {
  fields.allow({"terms", "squares_rad2ps2"});
  const auto terms = fields.numbers("terms", core::kAllanOctaves);
  const auto squares = fields.numbers("squares_rad2ps2", core::kAllanOctaves);
  core::AllanSums sums;
  constexpr double kMostTerms = 1ULL << 53U;
  for (const double count : terms) {
    if (!(count >= 1.0 && count <= kMostTerms && count == std::floor(count)))
      fields.fail("terms", "whole numbers of 1 and more");
  }
  if (squares.size() != terms.size()) fields.fail("squares_rad2ps2", "as many numbers as terms");
  std::ranges::transform(terms, sums.terms.begin(),
                         [](double count) { return static_cast<std::uint64_t>(count); });
  std::ranges::copy(squares, sums.squares.begin());
  if (!core::is_possible(sums)) fields.fail("terms", "fewer for longer clusters, and squares of 0 and more");
  return sums;
}

stream::AllanCurves curves_of(const JsonFields& fields) {
  fields.allow({"x", "y", "z"});
  stream::AllanCurves curves{};
  for (std::size_t a = 0; a < kAxisNames.size(); ++a) {
    if (fields.has(kAxisNames[a])) curves[a] = curve_of(fields.fields(kAxisNames[a]));
  }
  return curves;
}

json state_json(const stream::RememberedNoise& state) {
  json axes = json::object();
  for (std::size_t a = 0; a < kAxisNames.size(); ++a) {
    if (core::is_usable(state.models[a])) axes[kAxisNames[a]] = model_json(state.models[a]);
  }
  return {{"sample_rate_hz", state.sample_rate_hz},
          {"rest_s", state.rest_seconds},
          {"segments", state.segments},
          {"bias_radps", state.bias},
          {"bias_rest_s", state.bias_seconds},
          {"axes", std::move(axes)},
          {"allan", curves_json(state.curves)}};
}

stream::RememberedNoise state_of(const JsonFields& fields) {
  fields.allow({"sample_rate_hz", "rest_s", "segments", "bias_radps", "bias_rest_s", "axes", "allan"});
  stream::RememberedNoise state;
  state.sample_rate_hz = fields.positive("sample_rate_hz");
  state.rest_seconds = fields.positive("rest_s");
  state.segments = fields.positive("segments");
  state.bias_seconds = fields.positive("bias_rest_s");
  const auto bias = fields.numbers("bias_radps", kAxisNames.size());
  if (bias.size() != kAxisNames.size()) fields.fail("bias_radps", "a list of 3 numbers");
  std::ranges::copy(bias, state.bias.begin());
  const JsonFields axes = fields.fields("axes");
  axes.allow({"x", "y", "z"});
  for (std::size_t a = 0; a < kAxisNames.size(); ++a) {
    if (axes.has(kAxisNames[a])) state.models[a] = model_of(axes.fields(kAxisNames[a]));
  }
  if (!has_model(state)) fields.fail("axes", "the noise of one axis at least");
  if (fields.has("allan")) state.curves = curves_of(fields.fields("allan"));
  return state;
}

}  // namespace

std::string noise_state_text(const NoiseStates& states) {
  json sensors = json::object();
  for (const auto& [id, state] : states) {
    if (has_model(state)) sensors[id] = state_json(state);
  }
  const json root = {{kStateKey, kStateVersion}, {"sensors", std::move(sensors)}};
  return root.dump(1) + "\n";
}

NoiseStates parse_noise_state(const std::string& file, std::string_view text) {
  const json root = parse_versioned(file, text, kStateKey, {kOldestVersion, kStateVersion});
  const JsonFields fields(file, root);
  fields.allow({kStateKey, "sensors"});
  const JsonFields sensors = fields.fields("sensors");
  NoiseStates states;
  for (const auto& [id, unused] : sensors.object().items()) {
    if (!stream::is_valid_sensor_id(id))
      sensors.fail(id, "a sensor id of 1 to 64 printable ASCII characters without spaces");
    states.emplace(id, state_of(sensors.fields(id)));
  }
  return states;
}

}  // namespace gyrod::settings
