#include "settings/noise_model_json.hpp"

#include <algorithm>
#include <cmath>

namespace gyrod::settings {
namespace {

constexpr const char* kFrequency = "cycles_per_sample";
constexpr const char* kHalfWidth = "half_width_cycles_per_sample";

core::SpectralLine line_of(const JsonFields& fields) {
  fields.allow({kFrequency, kHalfWidth, "std_radps"});
  const double deviation = fields.positive("std_radps");
  const core::SpectralLine line{.cycles = fields.positive(kFrequency),
                                .half_width = fields.positive(kHalfWidth),
                                .variance = deviation * deviation};
  if (!(line.variance > 0.0)) fields.fail("std_radps", "a standard deviation above 0");
  if (!(line.cycles < 0.5)) fields.fail(kFrequency, "a number below 0.5, half the sample rate");
  return line;
}

}  // namespace

nlohmann::json model_json(const core::NoiseModel& model) {
  nlohmann::json json = {{"white_std_radps", std::sqrt(model.white_variance)}};
  if (model.colour_order > 0) {
    json["colour_std_radps"] = std::sqrt(model.colour_variance);
    const auto colour = model.colour_coefficients();
    json["colour"] = std::vector<double>(colour.begin(), colour.end());
  }
  for (const core::SpectralLine& line : model.lines()) {
    json["lines"].push_back(
        {{kFrequency, line.cycles}, {kHalfWidth, line.half_width}, {"std_radps", std::sqrt(line.variance)}});
  }
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
  if (fields.has("lines")) {
    for (const JsonFields& line : fields.list("lines", core::kMaxNoiseLines)) {
      const double before = model.line_count > 0 ? model.line[model.line_count - 1].cycles : 0.0;
      model.line[model.line_count] = line_of(line);
      if (!(model.line[model.line_count].cycles > before))
        line.fail(kFrequency, "lines by frequency, the lowest first");
      ++model.line_count;
    }
  }
  if (!core::is_usable(model)) fields.fail("white_std_radps", "a standard deviation above 0");
  return model;
}

}  // namespace gyrod::settings
