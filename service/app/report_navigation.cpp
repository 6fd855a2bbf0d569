#include "app/report_navigation.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <utility>

#include "files/file_error.hpp"
#include "files/navigation_columns.hpp"
#include "report/axis_input.hpp"

namespace gyrod::app {
namespace {

using report::Json;
using Triple = std::array<core::ErrorStatistics, 3>;

constexpr std::array<const char*, 3> kEulerKeys = {"roll_deg", "pitch_deg", "heading_deg"};
constexpr std::array<const char*, 3> kVelocityKeys = {"north_mps", "east_mps", "down_mps"};
constexpr std::array<const char*, 3> kPositionKeys = {"north_m", "east_m", "down_m"};

/// Where the record was made, if its reference does not say; gyrod navigate assumes the same.
constexpr double kAssumedLatitudeRad = std::numbers::pi / 4.0;

/// Points of an error curve: these are smooth, so that every so many samples are enough.
constexpr std::size_t kErrorPoints = 1000;

Json triple_json(const std::array<const char*, 3>& keys, const Triple& figures) {
  Json all;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    all[keys[i]] = Json{{"mean", figures[i].mean},
                        {"std", figures[i].standard_deviation},
                        {"rmse", figures[i].rmse},
                        {"max", figures[i].max_abs}};
  }
  return all;
}

Json series_json(const std::vector<NavigationErrorSample>& samples) {
  const std::size_t stride = samples.size() / kErrorPoints + 1;
  const auto column = [&](auto&& value) {
    std::vector<double> values;
    for (std::size_t n = 0; n < samples.size(); n += stride) values.push_back(value(samples[n]));
    return report::rounded(values);
  };
  Json all{{"time_s", column([](const auto& sample) { return sample.time_s; })}};
  const auto add = [&](const std::array<const char*, 3>& keys, Eigen::Vector3d core::TrajectoryError::*part) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      all[keys[i]] =
          column([&](const auto& sample) { return (sample.error.*part)(static_cast<Eigen::Index>(i)); });
    }
  };
  add(kEulerKeys, &core::TrajectoryError::euler_deg);
  add(kVelocityKeys, &core::TrajectoryError::velocity_mps);
  add(kPositionKeys, &core::TrajectoryError::position_m);
  return all;
}

/// The first start's errors are drawn; all starts' are in the file.
Json run_json(const NavigationRunResult& run) {
  Json series = Json::array();
  if (!run.series.empty()) series.push_back(series_json(run.series.front()));
  return Json{{"scheme", run.name},
              {"attitude", triple_json(kEulerKeys, run.pooled.euler_deg)},
              {"velocity", triple_json(kVelocityKeys, run.pooled.velocity_mps)},
              {"position", triple_json(kPositionKeys, run.pooled.position_m)},
              {"series", std::move(series)}};
}

/// The paper's Tables 7 to 9.
Json paper_tables() {
  const auto figures = [](double mean, double deviation) { return Json{{"mean", mean}, {"std", deviation}}; };
  Json attitude;
  attitude["raw"] = {{"roll_deg", figures(0.1037, 0.0595)},
                     {"pitch_deg", figures(0.0693, 0.0402)},
                     {"heading_deg", figures(0.0941, 0.0538)}};
  attitude["acf-emd"] = {{"roll_deg", figures(0.0993, 0.0570)},
                         {"pitch_deg", figures(0.0643, 0.0375)},
                         {"heading_deg", figures(0.0887, 0.0510)}};
  attitude["improved"] = {{"roll_deg", figures(0.0919, 0.0527)},
                          {"pitch_deg", figures(0.0548, 0.0318)},
                          {"heading_deg", figures(0.0809, 0.0463)}};
  Json velocity;
  velocity["raw"] = {{"north_mps", figures(-0.0575, 0.0559)}, {"east_mps", figures(0.1379, 0.1120)}};
  velocity["acf-emd"] = {{"north_mps", figures(-0.0555, 0.0549)}, {"east_mps", figures(0.1245, 0.1000)}};
  velocity["improved"] = {{"north_mps", figures(-0.0410, 0.0412)}, {"east_mps", figures(0.1046, 0.0710)}};
  Json position;
  position["raw"] = {{"east_m", figures(0.9245, 0.9723)}, {"north_m", figures(-0.2680, 0.3219)}};
  position["acf-emd"] = {{"east_m", figures(0.8412, 0.8780)}, {"north_m", figures(-0.2545, 0.3107)}};
  position["improved"] = {{"east_m", figures(0.7892, 0.7553)}, {"north_m", figures(-0.1849, 0.2282)}};
  return Json{{"attitude", attitude}, {"velocity", velocity}, {"position", position}};
}

/// With a capital letter and a full stop.
std::string as_sentence(std::string note) {
  if (note.empty()) return note;
  if (note.front() >= 'a' && note.front() <= 'z') note.front() = static_cast<char>(note.front() - 'a' + 'A');
  return note.back() == '.' ? note : note + ".";
}

Json words_of(const NavigationResult& result, bool at_rest) {
  Json words = Json::array();
  std::string starts = "Strapdown navigation over " + report::number_text(result.duration_s, 2) + " s from " +
                       std::to_string(result.starts.size()) + " starts, at";
  std::size_t lost = 0;
  for (const NavigationStart& start : result.starts) {
    starts += (&start == &result.starts.front() ? " " : ", ") + report::number_text(start.time_s, 3);
    lost += start.lost;
  }
  words.push_back(starts +
                  " s, with every scheme's rates at their own stamps: no lag. The tables pool all starts.");
  if (at_rest) words.push_back("The sensor lies still, and that is the truth: all that moves is error.");
  if (lost > 0) {
    words.push_back(std::to_string(lost) +
                    " samples of the truth within these times are not known; they are left out.");
  }
  for (const std::string& note : result.notes) words.push_back(as_sentence(note));
  words.push_back(
      "White noise of the rate averages out in the integral by itself: expect denoising to change these "
      "errors little.");
  return words;
}

Json section_of(const NavigationResult& result, bool at_rest, bool still) {
  Json runs = Json::array();
  for (const NavigationRunResult& run : result.runs) runs.push_back(run_json(run));
  Json section{
      {"words", words_of(result, at_rest)},
      {"figure_start", 0},
      {"figure_words", "From the first start, at " + report::number_text(result.starts.front().time_s, 3) +
                           " s. All starts, sample by sample: navigation.csv."},
      {"runs", std::move(runs)}};
  const auto unknown = [&section](bool known, const char* key, const char* what) {
    if (!known) section[key] = std::string("the reference does not hold the ") + what + ".";
  };
  unknown(result.has_attitude, "attitude_absent", "attitude");
  unknown(result.has_velocity, "velocity_absent", "velocity");
  unknown(result.has_position, "position_absent", "position");
  if (still) section["paper"] = paper_tables();
  return section;
}

std::vector<NavigationRun> runs_of(const ReportedAxes& axes) {
  std::vector<NavigationRun> runs;
  for (const core::Scheme scheme : core::kAllSchemes) {
    NavigationRun run{std::string(core::name_of(scheme)), {}, 0};
    for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
      run.gyro_radps[axis] = axes[axis]->outputs_radps[static_cast<std::size_t>(scheme)];
    }
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace

ReportNavigation report_navigation(const files::Record& record, const ReportedAxes& axes, bool still) {
  const bool all_axes = std::ranges::all_of(axes, [](const auto& axis) { return axis.has_value(); });
  if (!all_axes) return {report::absent("navigation needs all three axes."), std::nullopt};
  try {
    const files::Accelerometer accelerometer = files::accelerometer_of(record);
    NavigationOptions options;
    options.reference.latitude_rad = kAssumedLatitudeRad;
    options.keep_series = true;
    const auto truth = files::truth_columns(record, std::nullopt, options.reference);
    if (!truth && !still) {
      return {report::absent("the record moves and has no reference to compare with (attitude, velocity or "
                             "position columns)."),
              std::nullopt};
    }
    NavigationResult result = compare_navigation(record, accelerometer, runs_of(axes), truth, options);
    Json section = section_of(result, !truth, still);
    return {std::move(section), std::move(result)};
  } catch (const files::FileError& error) {
    return {report::absent(error.what()), std::nullopt};
  }
}

}  // namespace gyrod::app
