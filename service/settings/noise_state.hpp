/// What the daemon has learned of its sensors' noise, as text.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "settings/json_fields.hpp"
#include "stream/standstill_noise.hpp"

namespace gyrod::settings {

/// By sensor id.
using NoiseStates = std::map<std::string, stream::RememberedNoise, std::less<>>;

/// JSON: {"gyrod_noise_state": 2, "sensors": {ID: {...}}}. Version 1, without Allan sums, is read too.
/// @pre the states are such as StandstillLearner::state() gives once it has a model; others are left out
[[nodiscard]] std::string noise_state_text(const NoiseStates& states);

/// @param file for messages
/// @throws NoiseFileError for anything that noise_state_text() would not have written: all of it or nothing
[[nodiscard]] NoiseStates parse_noise_state(const std::string& file, std::string_view text);

}  // namespace gyrod::settings
