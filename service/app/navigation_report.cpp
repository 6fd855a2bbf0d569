#include "app/navigation_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <sstream>
#include <string_view>

#include <nlohmann/json.hpp>

#include "files/number_text.hpp"

namespace gyrod::app {
namespace {

using Json = nlohmann::ordered_json;
using Triple = std::array<core::ErrorStatistics, 3>;

/// One quantity of the tables.
struct Quantity {
  std::string_view title;
  std::array<std::string_view, 3> components;
  Triple core::TrajectoryStatistics::*figures;
  /// The three in one: angle between attitudes, horizontal distance.
  std::string_view total_name;
  core::ErrorStatistics core::TrajectoryStatistics::*total;
};

constexpr Quantity kAttitude = {"Attitude error, deg (Table 7)",
                                {"roll", "pitch", "heading"},
                                &core::TrajectoryStatistics::euler_deg,
                                "whole angle",
                                &core::TrajectoryStatistics::total_rotation_deg};
constexpr Quantity kVelocity = {"Velocity error, m/s (Table 8)",
                                {"north", "east", "down"},
                                &core::TrajectoryStatistics::velocity_mps,
                                "",
                                nullptr};
constexpr Quantity kPosition = {"Position error, m (Table 9)",
                                {"north", "east", "down"},
                                &core::TrajectoryStatistics::position_m,
                                "horizontal",
                                &core::TrajectoryStatistics::horizontal_m};

constexpr std::array<const Quantity*, 3> kQuantities = {&kAttitude, &kVelocity, &kPosition};

bool is_known(const NavigationResult& result, const Quantity* quantity) {
  if (quantity == &kAttitude) return result.has_attitude;
  return quantity == &kVelocity ? result.has_velocity : result.has_position;
}

void add_row(std::ostringstream& out, std::string_view component, const std::string& run,
             const core::ErrorStatistics& figures) {
  out << "  " << std::left << std::setw(13) << component << std::setw(24) << run << std::right;
  for (const double value : {figures.mean, figures.standard_deviation, figures.rmse, figures.max_abs})
    out << std::setw(12) << value;
  out << "\n";
}

void add_table(std::ostringstream& out, const NavigationResult& result, const Quantity& quantity) {
  out << "\n"
      << std::left << std::setw(39) << quantity.title << std::right << std::setw(12) << "mean"
      << std::setw(12) << "std" << std::setw(12) << "RMSE" << std::setw(12) << "max"
      << "\n";
  for (std::size_t i = 0; i < 3; ++i) {
    for (const NavigationRunResult& run : result.runs)
      add_row(out, &run == &result.runs.front() ? quantity.components[i] : "", label_of(run),
              (run.pooled.*quantity.figures)[i]);
  }
  if (quantity.total == nullptr) return;
  for (const NavigationRunResult& run : result.runs)
    add_row(out, &run == &result.runs.front() ? quantity.total_name : "", label_of(run),
            run.pooled.*quantity.total);
}

/// Roll or heading errors far beyond the angle between the attitudes come from the Euler angles, not from the solution.
bool euler_misleads(const NavigationResult& result) {
  return std::ranges::any_of(result.runs, [](const NavigationRunResult& run) {
    const double whole = run.pooled.total_rotation_deg.max_abs;
    return std::max(run.pooled.euler_deg[0].max_abs, run.pooled.euler_deg[2].max_abs) > 2.0 * whole;
  });
}

std::uint64_t sum_of(const NavigationResult& result, std::size_t NavigationStart::*count) {
  std::uint64_t sum = 0;
  for (const NavigationStart& start : result.starts) sum += start.*count;
  return sum;
}

/// RMSE of every start: what the pooled figures hide.
void add_starts(std::ostringstream& out, const NavigationResult& result) {
  out << "\nEach start, RMSE                         angle, deg  v north, m/s  v east, m/s  horizontal, m   "
         "lost\n";
  for (std::size_t k = 0; k < result.starts.size(); ++k) {
    for (const NavigationRunResult& run : result.runs) {
      const core::TrajectoryStatistics& figures = run.per_start[k];
      std::ostringstream start;
      if (&run == &result.runs.front())
        start << std::fixed << std::setprecision(2) << result.starts[k].time_s << " s";
      out << "  " << std::left << std::setw(13) << start.str() << std::setw(24) << label_of(run)
          << std::right;
      const auto add = [&out](bool known, double value) {
        if (known) {
          out << std::setw(13) << value;
        } else {
          out << std::setw(13) << "-";
        }
      };
      add(result.has_attitude, figures.total_rotation_deg.rmse);
      add(result.has_velocity, figures.velocity_mps[0].rmse);
      add(result.has_velocity, figures.velocity_mps[1].rmse);
      add(result.has_position, figures.horizontal_m.rmse);
      out << std::setw(7) << result.starts[k].lost << "\n";
    }
  }
}

Json json_of(const core::ErrorStatistics& figures) {
  return {{"samples", figures.count},
          {"mean", figures.mean},
          {"standard_deviation", figures.standard_deviation},
          {"rmse", figures.rmse},
          {"max_abs", figures.max_abs}};
}

Json json_of(const Triple& figures, const std::array<std::string_view, 3>& names) {
  Json json;
  for (std::size_t i = 0; i < 3; ++i) json[names[i]] = json_of(figures[i]);
  return json;
}

Json json_of(const core::TrajectoryStatistics& figures, const NavigationResult& result) {
  Json json = Json::object();
  if (result.has_attitude) {
    json["attitude_deg"] = json_of(figures.euler_deg, kAttitude.components);
    json["rotation_deg"] = json_of(figures.rotation_deg, kVelocity.components);
    json["rotation_deg"]["total"] = json_of(figures.total_rotation_deg);
  }
  if (result.has_velocity) json["velocity_mps"] = json_of(figures.velocity_mps, kVelocity.components);
  if (result.has_position) {
    json["position_m"] = json_of(figures.position_m, kPosition.components);
    json["position_m"]["horizontal"] = json_of(figures.horizontal_m);
  }
  return json;
}

Json json_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json json_of(const NavigationRunResult& run, const NavigationResult& result) {
  Json json = {{"scheme", run.name},
               {"delay_samples", run.delay_samples},
               {"pooled", json_of(run.pooled, result)},
               {"starts", Json::array()}};
  for (std::size_t k = 0; k < run.per_start.size(); ++k) {
    Json start = {{"gyro_bias_radps", json_of(run.bias[k].gyro_radps)},
                  {"accel_bias_mps2", json_of(run.bias[k].accel_mps2)}};
    start.update(json_of(run.per_start[k], result));
    json["starts"].push_back(std::move(start));
  }
  return json;
}

void append_cells(std::string& row, const Eigen::Vector3d& values) {
  for (const double value : values) {
    row += ',';
    if (std::isfinite(value)) files::append_number(row, value);
  }
}

}  // namespace

std::string label_of(const NavigationRunResult& run) {
  return run.delay_samples == 0 ? run.name : run.name + ", " + std::to_string(run.delay_samples) + " late";
}

std::string navigation_text(const files::Record& record, const NavigationResult& result) {
  std::ostringstream out;
  out << record.name << ": " << record.size() << " samples, " << record.time_s.back() << " s at "
      << record.sample_rate_hz << " Hz\n";
  out << result.starts.size() << (result.starts.size() == 1 ? " start of " : " starts of ")
      << result.duration_s << " s; compared with the truth at " << sum_of(result, &NavigationStart::compared)
      << " of its samples, " << sum_of(result, &NavigationStart::lost) << " skipped where it is lost\n";
  for (const std::string& note : result.notes) out << "  " << note << "\n";
  out << std::fixed << std::setprecision(4);
  for (const Quantity* quantity : kQuantities) {
    if (is_known(result, quantity)) {
      add_table(out, result, *quantity);
    } else {
      out << "\n" << quantity->title << ": the truth does not know it\n";
    }
    if (quantity == &kAttitude && result.has_attitude && euler_misleads(result))
      out << "  Near pitch +-90 deg roll and heading say little; go by the whole angle.\n";
  }
  add_starts(out, result);
  return out.str();
}

std::string navigation_json(const files::Record& record, const NavigationResult& result) {
  Json json = {{"input", record.name},     {"sample_rate_hz", record.sample_rate_hz},
               {"samples", record.size()}, {"duration_s", result.duration_s},
               {"notes", result.notes},    {"local_frame", result.local_frame},
               {"starts", Json::array()},  {"runs", Json::array()}};
  for (const NavigationStart& start : result.starts) {
    json["starts"].push_back({{"start_s", start.time_s},
                              {"heading_deg", start.heading_deg},
                              {"compared_samples", start.compared},
                              {"lost_samples", start.lost}});
  }
  for (const NavigationRunResult& run : result.runs) json["runs"].push_back(json_of(run, result));
  return json.dump(2) + "\n";
}

void write_navigation_csv(const NavigationResult& result, files::OutputFile& file) {
  file.write(
      "scheme,delay_samples,start_s,time_s,roll_error_deg,pitch_error_deg,heading_error_deg,rotation_north_"
      "deg,"
      "rotation_east_deg,rotation_down_deg,velocity_north_error_mps,velocity_east_error_mps,"
      "velocity_down_error_mps,position_north_error_m,position_east_error_m,position_down_error_m\n");
  for (const NavigationRunResult& run : result.runs) {
    for (std::size_t k = 0; k < run.series.size(); ++k) {
      std::string head = run.name + "," + std::to_string(run.delay_samples) + ",";
      files::append_number(head, result.starts[k].time_s);
      for (const NavigationErrorSample& sample : run.series[k]) {
        std::string row = head + ",";
        files::append_number(row, sample.time_s);
        append_cells(row, sample.error.euler_deg);
        append_cells(row, sample.error.rotation_deg);
        append_cells(row, sample.error.velocity_mps);
        append_cells(row, sample.error.position_m);
        file.write(row + "\n");
      }
    }
  }
}

}  // namespace gyrod::app
