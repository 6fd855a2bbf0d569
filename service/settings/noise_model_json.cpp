#include "settings/noise_model_json.hpp"

#include <algorithm>
#include <cmath>

namespace gyrod::settings {

nlohmann::json model_json(const core::NoiseModel& model) {
  nlohmann::json json = {{"white_std_radps", std::sqrt(model.white_variance)}};
  if (model.colour_order == 0) return json;
  json["colour_std_radps"] = std::sqrt(model.colour_variance);
  const auto colour = model.colour_coefficients();
  json["colour"] = std::vector<double>(colour.begin(), colour.end());
  return json;
}

core::NoiseModel model_of(const JsonFields& fields) {
  const double white = fields.positive("white_std_radps");
  core::NoiseModel model = core::white_noise(white * white);
  if (fields.has("colour")) {
    const std::vector<double> colour = fields.numbers("colour", core::kMaxNoiseColour);
    std::ranges::copy(colour, model.colour.begin());
    model.colour_order = colour.size();
    const double drive = fields.not_negative("colour_std_radps");
    model.colour_variance = drive * drive;
    if (!core::is_usable(model)) fields.fail("colour", "coefficients of a stable model");
  }
  if (!core::is_usable(model)) fields.fail("white_std_radps", "a standard deviation above 0");
  return model;
}

}  // namespace gyrod::settings
