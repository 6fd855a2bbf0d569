#include "app/navigation_comparison.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "app/angle_units.hpp"
#include "app/navigation_setup.hpp"
#include "app/navigation_starts.hpp"
#include "core/inertial/attitude.hpp"
#include "files/file_error.hpp"

namespace gyrod::app {
namespace {

using Errors = std::vector<NavigationErrorSample>;
using MaybeTruth = std::optional<files::NavigationTruth>;

void check_lengths(const files::Record& record, const std::vector<NavigationRun>& runs) {
  for (const NavigationRun& run : runs) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t size = run.gyro_radps[i].size();
      if (size == record.size()) continue;
      throw files::FileError(record.name + ": the rates '" + run.name + "' about " + "xyz"[i] + " have " +
                             std::to_string(size) + " samples; expected " + std::to_string(record.size()) +
                             ", as many as the recording" +
                             (size == 0 ? " (navigation needs all three axes)" : ""));
    }
  }
}

std::vector<NavigationSpan> spans_of(const files::Record& record, const StartFinder& finder,
                                     const NavigationOptions& options) {
  std::vector<std::size_t> starts;
  if (options.starts_s.empty()) starts = finder.spread(options.start_count);
  for (const double start_s : options.starts_s) starts.push_back(finder.at(start_s));
  std::vector<NavigationSpan> spans;
  for (const std::size_t first : starts) {
    const double last_s = record.time_s[first] + options.duration_s + kTimeTolerance_s;
    const auto end = std::ranges::upper_bound(record.time_s, last_s);
    spans.push_back({first, static_cast<std::size_t>(end - record.time_s.begin())});
  }
  return spans;
}

/// Against a vehicle that stays where it was.
Errors errors_at_rest(std::span<const double> times, const std::vector<core::NavigationState>& states) {
  Errors errors;
  for (std::size_t n = 1; n < states.size(); ++n)
    errors.push_back({times[n] - times.front(), core::error_of(states[n], states.front())});
  return errors;
}

bool is_whole(const core::Truth& truth, std::size_t n) {
  return (!truth.has_attitude() || core::is_known(truth.attitude[n])) &&
         (!truth.has_velocity() || core::is_known(truth.velocity_mps[n])) &&
         (!truth.has_position() || core::is_known(truth.position[n]));
}

/// At the truth's own times. @param lost is set to the number of its elements that are not known in full
Errors errors_against(const core::Truth& truth, std::span<const double> times,
                      const std::vector<core::NavigationState>& states, std::size_t& lost) {
  Errors errors;
  lost = 0;
  const auto [first, end] = core::elements_within(truth, times.front(), times.back());
  for (std::size_t n = first; n < end; ++n) {
    lost += is_whole(truth, n) ? 0U : 1U;
    const core::NavigationState solution = core::state_at(times, states, truth.time_s[n]);
    errors.push_back({truth.time_s[n] - times.front(), core::error_of(solution, core::state_of(truth, n))});
  }
  return errors;
}

NavigationRunResult navigate(const NavigationRun& run, const NavigationSetup& setup, const MaybeTruth& truth,
                             const std::vector<NavigationSpan>& spans, std::vector<NavigationStart>& starts) {
  const core::InertialSeries series = setup.series_of(run);
  const auto constant = setup.constant_bias(series);
  NavigationRunResult result;
  result.name = run.name;
  result.delay_samples = run.delay_samples;
  core::TrajectoryAccumulator pooled;
  for (std::size_t k = 0; k < spans.size(); ++k) {
    const auto start = setup.start_of(series, spans[k], constant);
    const auto states = core::dead_reckoned(series, spans[k].first, spans[k].end, start.state, start.bias);
    const auto times = series.time_s.subspan(spans[k].first, states.size());
    Errors errors =
        truth ? errors_against(truth->truth, times, states, starts[k].lost) : errors_at_rest(times, states);
    starts[k].compared = errors.size() - starts[k].lost;
    starts[k].heading_deg = kDegPerRad * core::euler_of(start.state.attitude).heading_rad;
    core::TrajectoryAccumulator own;
    for (const NavigationErrorSample& sample : errors) {
      own.add(sample.error);
      pooled.add(sample.error);
    }
    result.per_start.push_back(own.statistics());
    result.bias.push_back(start.bias);
    result.series.push_back(std::move(errors));
  }
  result.pooled = pooled.statistics();
  return result;
}

std::string shown(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string note_on_truth(const MaybeTruth& truth) {
  if (!truth) return "truth: at rest throughout; velocity 0, position and attitude as at each start";
  std::string note = "truth: " + truth->source;
  if (truth->velocity_differentiated) note += "; velocity by differences of its positions";
  if (truth->local) note += "; its x axis is taken as north";
  if (truth->held > 0)
    note += "; " + std::to_string(truth->held) + " rows that repeat the one before left out";
  return note;
}

std::string note_on_start(const NavigationSetup& setup, const NavigationOptions& options, bool truth) {
  if (setup.attitude_from_truth()) return "start: attitude, velocity and position of the truth";
  std::string note = "start: roll and pitch levelled on the " + shown(options.level_s) + " s before";
  if (setup.matches_heading()) {
    note += "; heading such that the velocity fits the truth's best over the run, for each row of its own";
  } else {
    note += "; heading " + shown(options.heading_deg.value_or(0.0)) + " deg";
  }
  return note + (truth ? "; velocity and position of the truth" : "; velocity 0");
}

std::string note_on_bias(const NavigationSetup& setup, const NavigationOptions& options) {
  switch (setup.bias_source()) {
    case BiasSource::kTruth:
      return "bias: one constant an axis that fits the truth of the whole recording best, for gyro and "
             "accelerometer, each row from its own rates";
    case BiasSource::kLevelling:
      return "bias: mean of the " + shown(options.level_s) +
             " s before each start, at rest; gyro less earth rate, each row from its own rates; "
             "accelerometer along "
             "gravity only";
    default:
      return "bias: nothing is taken off";
  }
}

std::string note_on_place(const MaybeTruth& truth, const NavigationOptions& options) {
  if (truth && truth->truth.has_position() && !truth->local) return "place: the truth's";
  return "place: latitude " + shown(kDegPerRad * options.reference.latitude_rad) + " deg, longitude " +
         shown(kDegPerRad * options.reference.longitude_rad) + " deg, height " +
         shown(options.reference.height_m) + " m (assumed unless given)";
}

}  // namespace

NavigationResult compare_navigation(const files::Record& record, const files::Accelerometer& accelerometer,
                                    const std::vector<NavigationRun>& runs, const MaybeTruth& truth,
                                    const NavigationOptions& options) {
  check_lengths(record, runs);
  const NavigationSetup setup(record, accelerometer, truth, options);
  const StartFinder finder(record.time_s, truth,
                           {options.duration_s, setup.needs_levelling() ? options.level_s : 0.0},
                           record.name);
  const std::vector<NavigationSpan> spans = spans_of(record, finder, options);

  NavigationResult result;
  result.duration_s = options.duration_s;
  result.has_attitude = !truth || truth->truth.has_attitude();
  result.has_velocity = !truth || truth->truth.has_velocity();
  result.has_position = !truth || truth->truth.has_position();
  result.local_frame = truth && truth->local;
  for (const NavigationSpan& span : spans) result.starts.push_back({.time_s = record.time_s[span.first]});
  for (const NavigationRun& run : runs) {
    result.runs.push_back(navigate(run, setup, truth, spans, result.starts));
    if (!options.keep_series) result.runs.back().series.clear();
  }
  result.notes = {note_on_truth(truth), note_on_start(setup, options, truth.has_value()),
                  note_on_bias(setup, options), note_on_place(truth, options)};
  if (accelerometer.bridged > 0)
    result.notes.push_back("accelerometer: " + std::to_string(accelerometer.bridged) +
                           " samples bridged by straight lines");
  return result;
}

}  // namespace gyrod::app
