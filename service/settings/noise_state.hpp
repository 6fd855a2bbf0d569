/// What the daemon has learned of its sensors' noise, as text.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/noise/standstill_learner.hpp"
#include "settings/json_fields.hpp"

namespace gyrod::settings {

/// By sensor id.
using NoiseStates = std::map<std::string, core::StandstillState, std::less<>>;

/// JSON: {"gyrod_noise_state": 1, "sensors": {ID: {...}}}.
/// @pre the states are such as StandstillLearner::state() gives once it has a model; others are left out
[[nodiscard]] std::string noise_state_text(const NoiseStates& states);

/// @param file for messages
/// @throws NoiseFileError for anything that noise_state_text() would not have written: all of it or nothing
[[nodiscard]] NoiseStates parse_noise_state(const std::string& file, std::string_view text);

}  // namespace gyrod::settings
