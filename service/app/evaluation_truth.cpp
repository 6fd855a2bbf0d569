#include "app/evaluation_truth.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>

#include "app/angle_units.hpp"
#include "app/evaluation_series.hpp"
#include "core/joint/signal_band.hpp"
#include "files/column_names.hpp"
#include "files/csv_row.hpp"
#include "files/file_error.hpp"
#include "files/rate_unit.hpp"

namespace gyrod::app {
namespace {

std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

/// How a column of the truth begins, as Record::others spells it.
std::string beginning_of(const std::string& prefix, const std::string& axis) {
  return in_lower_case(prefix) + axis.back();
}

/// The unit that a column's name says after its beginning.
std::optional<files::RateUnit> unit_of(std::string_view name, std::string_view beginning) {
  if (!name.starts_with(beginning) || name.size() <= beginning.size() || name[beginning.size()] != '_')
    return std::nullopt;
  return files::rate_unit_of(name.substr(beginning.size() + 1));
}

/// Why there is no truth in columns that begin so; all names of the file, with and without numbers.
std::string lack_of(const std::vector<std::string>& names, const std::string& beginning) {
  for (const std::string& name : names) {
    if (unit_of(name, beginning)) return name + " holds no number";
  }
  for (const std::string& name : names) {
    if (name == beginning || name.starts_with(beginning + "_"))
      return name + " does not end in a unit that is known";
  }
  return "there is no column " + beginning + "_UNIT";
}

std::vector<std::string> all_names(const files::Record& record) {
  std::vector<std::string_view> cells;
  static_cast<void>(files::split_row(record.header.text, record.header.separator, cells));
  std::vector<std::string> names;
  for (const std::string_view cell : cells) names.push_back(in_lower_case(files::bare(cell)));
  return names;
}

std::vector<std::string> prefixes_of(const EvaluationInput& input) {
  if (input.truth_prefix) return {*input.truth_prefix};
  return {"truth_", "ref_gyro_"};
}

const std::string& truth_axis(const EvaluationInput& input, const std::string& axis) {
  return input.truth_axes[static_cast<std::size_t>(axis.back() - 'x')];
}

/// The axes that could be judged with this prefix: "x,z".
std::string judgeable(const files::Record& record, const std::string& prefix, const EvaluationInput& input) {
  std::string axes;
  for (const std::string axis : {"x", "y", "z"}) {
    const bool measured = !record.gyro_radps[static_cast<std::size_t>(axis.back() - 'x')].empty();
    if (!measured || truth_rates(record, prefix, truth_axis(input, axis)).empty()) continue;
    axes += (axes.empty() ? "" : ",") + axis;
  }
  return axes;
}

/// Whether a column seems to be meant for the truth.
bool is_tried(const std::vector<std::string>& names, const std::string& prefix) {
  return std::ranges::any_of(names, [&](const std::string& name) {
    return std::ranges::any_of(std::string_view("xyz"), [&](char axis) {
      const std::string beginning = beginning_of(prefix, std::string(1, axis));
      return name == beginning || name.starts_with(beginning + "_");
    });
  });
}

[[noreturn]] void complain_of_axes(const files::Record& record, const std::string& prefix,
                                   const EvaluationInput& input, const std::vector<std::string>& names) {
  std::string lacks;
  for (const std::string& axis : input.axes) {
    const std::string& of = truth_axis(input, axis);
    if (!truth_rates(record, prefix, of).empty()) continue;
    lacks += (lacks.empty() ? "" : "; ") + ("the truth of axis " + axis + " is missing: ") +
             lack_of(names, beginning_of(prefix, of));
  }
  const std::string others = judgeable(record, prefix, input);
  throw files::FileError(record.name + ": " + lacks + ". UNIT is one of " + files::known_rate_units() +
                         (others.empty() ? "" : "; --axis " + others + " judges what has a truth"));
}

[[noreturn]] void complain_of_no_truth(const files::Record& record, const EvaluationInput& input) {
  const std::string wanted =
      input.truth_prefix ? *input.truth_prefix + "x_UNIT" : std::string("truth_x_UNIT or ref_gyro_x_UNIT");
  throw files::FileError(record.name + ": no truth to compare with; expected columns " + wanted +
                         " and so on for y and z, UNIT one of " + files::known_rate_units() +
                         " (--truth-columns PREFIX for others), or --noise STILL.csv with "
                         "--signal-is-truth, which takes the recorded rates for the truth; found " +
                         files::names_of(record.others));
}

}  // namespace

std::vector<double> truth_rates(const files::Record& record, const std::string& prefix,
                                const std::string& axis) {
  const std::string beginning = beginning_of(prefix, axis);
  for (const auto& [name, values] : record.others) {
    const auto unit = unit_of(name, beginning);
    if (!unit) continue;
    const double sign = axis.front() == '-' ? -kDegPerRad : kDegPerRad;
    std::vector<double> truth = values;
    for (double& value : truth) value = sign * files::to_radps(value, *unit);
    return truth;
  }
  return {};
}

std::string truth_prefix(const files::Record& record, const EvaluationInput& input) {
  const std::vector<std::string> prefixes = prefixes_of(input);
  for (const std::string& prefix : prefixes) {
    const auto there = [&](const std::string& axis) {
      return !truth_rates(record, prefix, truth_axis(input, axis)).empty();
    };
    if (std::ranges::all_of(input.axes, there)) return prefix;
  }
  const std::vector<std::string> names = all_names(record);
  for (const std::string& prefix : prefixes) {
    if (is_tried(names, prefix)) complain_of_axes(record, prefix, input, names);
  }
  complain_of_no_truth(record, input);
}

std::vector<double> within_band(std::span<const double> truth, double rate_hz, double max_signal_hz) {
  core::SignalBand band;
  if (max_signal_hz > 0.0) band.set(max_signal_hz / rate_hz);
  std::vector<double> known(truth.begin(), truth.end());
  if (band.limits()) bridge_gaps(known, static_cast<std::size_t>(0.25 / band.cycles()));
  return core::low_passed(known, band);
}

}  // namespace gyrod::app
