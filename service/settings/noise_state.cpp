#include "settings/noise_state.hpp"

#include <algorithm>
#include <array>

#include "settings/noise_model_json.hpp"
#include "stream/registry.hpp"
#include "stream/sample.hpp"

namespace gyrod::settings {
namespace {

using nlohmann::json;
using stream::kAxisNames;

constexpr const char* kStateKey = "gyrod_noise_state";
constexpr int kStateVersion = 1;

bool has_model(const core::StandstillState& state) {
  return std::ranges::any_of(state.models, core::is_usable);
}

json state_json(const core::StandstillState& state) {
  json axes = json::object();
  for (std::size_t a = 0; a < kAxisNames.size(); ++a) {
    if (core::is_usable(state.models[a])) axes[kAxisNames[a]] = model_json(state.models[a]);
  }
  return {{"sample_rate_hz", state.sample_rate_hz},
          {"rest_s", state.rest_seconds},
          {"segments", state.segments},
          {"bias_radps", state.bias},
          {"bias_rest_s", state.bias_seconds},
          {"axes", std::move(axes)}};
}

core::StandstillState state_of(const JsonFields& fields) {
  fields.allow({"sample_rate_hz", "rest_s", "segments", "bias_radps", "bias_rest_s", "axes"});
  core::StandstillState state;
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
  const json root = parse_versioned(file, text, kStateKey, kStateVersion);
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
