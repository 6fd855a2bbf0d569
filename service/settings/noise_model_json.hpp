/// A noise model as JSON, in rad/s.
#pragma once

#include <nlohmann/json.hpp>

#include "core/noise/noise_model.hpp"
#include "settings/json_fields.hpp"

namespace gyrod::settings {

/// {"white_std_radps": sqrt(white_variance), "colour_std_radps": sqrt(colour_variance), "colour": [c_1 .. c_p], "lines":
/// [{"cycles_per_sample": .., "half_width_cycles_per_sample": .., "std_radps": sqrt(variance)}, ..]}; without what the noise does not have.
[[nodiscard]] nlohmann::json model_json(const core::NoiseModel& model);

/// The other way round. Other keys of the object are not looked at.
/// @throws NoiseFileError for a value that does not fit and for a model that is not usable
[[nodiscard]] core::NoiseModel model_of(const JsonFields& fields);

}  // namespace gyrod::settings
