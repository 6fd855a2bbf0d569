#include "settings/noise_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/noise/noise_units.hpp"
#include "settings/document.hpp"
#include "settings/noise_model_json.hpp"
#include "settings/text_file.hpp"
#include "stream/registry.hpp"
#include "stream/sample.hpp"

namespace gyrod::settings {
namespace {

using nlohmann::json;
using stream::kAxisNames;
namespace fs = std::filesystem;

constexpr const char* kCalibrationKey = "gyrod_noise";
constexpr int kCalibrationVersion = 1;
constexpr std::size_t kMaxCalibrationMebibytes = 1;
constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kSqrtSecondsPerSqrtHour = 60.0;
/// Figures are written with all digits; so much lets people round them.
constexpr double kAgree = 0.01;

json figures_of(const core::NoiseModel& model, double rate) {
  return {{"std_dps", std::sqrt(core::noise_variance(model)) * kDegPerRad},
          {"noise_density_dps_per_sqrt_hz", core::noise_density(model, rate) * kDegPerRad},
          {"arw_deg_per_sqrt_h", core::angle_random_walk(model, rate) * kDegPerRad * kSqrtSecondsPerSqrtHour},
          {"lag_1_correlation", core::lag_one_correlation(model)}};
}

json origin_json(const NoiseOrigin& origin) {
  json result = {{"source", origin.source}};
  if (origin.first_stamp_s) result["first_stamp_s"] = *origin.first_stamp_s;
  if (origin.still_s) result["still_s"] = *origin.still_s;
  return result;
}

NoiseOrigin origin_of(const JsonFields& fields) {
  fields.allow({"source", "first_stamp_s", "still_s"});
  NoiseOrigin origin{.source = fields.text("source"), .first_stamp_s = {}, .still_s = {}};
  if (fields.has("first_stamp_s")) origin.first_stamp_s = fields.number("first_stamp_s");
  if (fields.has("still_s")) origin.still_s = fields.positive("still_s");
  return origin;
}

/// Whoever changes the figures means to change the noise, which is elsewhere.
void check_figures(const JsonFields& given, const json& expected) {
  for (const auto& [key, value] : expected.items()) {
    if (!given.has(key)) continue;
    const double right = value.get<double>();
    const double scale = std::max(std::abs(right), kAgree);
    if (std::abs(given.number(key) - right) <= kAgree * scale) continue;
    given.fail(key, value.dump() + " by the model under \"axes\", which is what counts");
  }
}

void read_axes(const JsonFields& root, NoiseCalibration& calibration) {
  const JsonFields axes = root.fields("axes");
  axes.allow({"x", "y", "z"});
  if (axes.object().empty()) root.fail("axes", "the noise of one axis at least");
  for (std::size_t a = 0; a < kAxisNames.size(); ++a) {
    if (!axes.has(kAxisNames[a])) continue;
    const JsonFields axis = axes.fields(kAxisNames[a]);
    axis.allow({"white_std_radps", "colour_std_radps", "colour", "lines", "bias_radps"});
    calibration.models[a] = model_of(axis);
    if (axis.has("bias_radps")) calibration.bias_radps[a] = axis.number("bias_radps");
  }
}

void read_figures(const JsonFields& root, const NoiseCalibration& calibration) {
  if (!root.has("figures")) return;
  const JsonFields figures = root.fields("figures");
  figures.allow({"x", "y", "z"});
  for (std::size_t a = 0; a < kAxisNames.size(); ++a) {
    if (!figures.has(kAxisNames[a]) || !core::is_usable(calibration.models[a])) continue;
    check_figures(figures.fields(kAxisNames[a]),
                  figures_of(calibration.models[a], calibration.sample_rate_hz));
  }
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    if (entry->path().extension() == ".json") files.push_back(entry->path());
  }
  if (error) throw NoiseFileError(folder.string() + ": cannot be read: " + error.message());
  if (files.empty()) throw NoiseFileError(folder.string() + ": holds no file *.json; expected calibrations");
  std::ranges::sort(files);
  return files;
}

std::string words_for(const NoiseCalibration& calibration) {
  return calibration.sensor_id ? "sensor " + *calibration.sensor_id : "all sensors";
}

}  // namespace

std::string calibration_text(const NoiseCalibration& calibration) {
  json root = {{kCalibrationKey, kCalibrationVersion}, {"sample_rate_hz", calibration.sample_rate_hz}};
  if (calibration.sensor_id) root["sensor_id"] = *calibration.sensor_id;
  for (std::size_t a = 0; a < kAxisNames.size(); ++a) {
    if (!core::is_usable(calibration.models[a])) continue;
    json& axis = root["axes"][kAxisNames[a]] = model_json(calibration.models[a]);
    axis["bias_radps"] = calibration.bias_radps[a];
    root["figures"][kAxisNames[a]] = figures_of(calibration.models[a], calibration.sample_rate_hz);
  }
  root["origin"] = origin_json(calibration.origin);
  constexpr int kIndent = 2;
  return root.dump(kIndent, ' ', false, json::error_handler_t::replace) + "\n";
}

NoiseCalibration parse_calibration(const std::string& file, std::string_view text) {
  const json document =
      parse_versioned(file, text, kCalibrationKey, {kCalibrationVersion, kCalibrationVersion});
  const JsonFields root(file, document);
  root.allow({kCalibrationKey, "sensor_id", "sample_rate_hz", "axes", "figures", "origin"});
  NoiseCalibration calibration;
  calibration.sample_rate_hz = root.positive("sample_rate_hz");
  if (root.has("sensor_id")) {
    calibration.sensor_id = root.text("sensor_id");
    if (!stream::is_valid_sensor_id(*calibration.sensor_id))
      root.fail("sensor_id", "1 to 64 printable ASCII characters without spaces");
  }
  read_axes(root, calibration);
  read_figures(root, calibration);
  if (root.has("origin")) calibration.origin = origin_of(root.fields("origin"));
  return calibration;
}

std::vector<NoiseCalibration> load_calibrations(const fs::path& file_or_folder) {
  std::error_code error;
  const bool folder = fs::is_directory(file_or_folder, error);
  const auto files = folder ? files_in(file_or_folder) : std::vector<fs::path>{file_or_folder};
  std::vector<NoiseCalibration> calibrations;
  for (const fs::path& file : files) {
    const TextFile read = read_text_file(file, kMaxCalibrationMebibytes);
    if (!read.trouble.empty()) throw NoiseFileError(file.string() + ": " + read.trouble);
    NoiseCalibration calibration = parse_calibration(file.string(), read.text);
    const auto same = std::ranges::find(calibrations, calibration.sensor_id, &NoiseCalibration::sensor_id);
    if (same != calibrations.end()) {
      const fs::path& other = files[static_cast<std::size_t>(same - calibrations.begin())];
      throw NoiseFileError(file.string() + ": is for " + words_for(calibration) + ", as " +
                           other.filename().string() + " is; expected one file each");
    }
    calibrations.push_back(std::move(calibration));
  }
  return calibrations;
}

const NoiseCalibration* calibration_for(std::span<const NoiseCalibration> calibrations,
                                        std::string_view sensor_id) noexcept {
  const NoiseCalibration* for_all = nullptr;
  for (const NoiseCalibration& calibration : calibrations) {
    if (!calibration.sensor_id) for_all = &calibration;
    if (calibration.sensor_id && *calibration.sensor_id == sensor_id) return &calibration;
  }
  return for_all;
}

}  // namespace gyrod::settings
