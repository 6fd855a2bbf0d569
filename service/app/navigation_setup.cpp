#include "app/navigation_setup.hpp"

#include <algorithm>
#include <cmath>

#include "app/angle_units.hpp"
#include "app/navigation_starts.hpp"
#include "core/inertial/truth_calibration.hpp"
#include "files/file_error.hpp"

namespace gyrod::app {
namespace {

/// A truth that stays below this speed says nothing of the heading, m/s: a receiver's noise is a tenth of it.
constexpr double kLeastSpeedForHeading_mps = 1.0;

BiasSource chosen(BiasSource asked, bool attitude_known) noexcept {
  if (asked != BiasSource::kAutomatic) return asked;
  return attitude_known ? BiasSource::kTruth : BiasSource::kLevelling;
}

}  // namespace

NavigationSetup::NavigationSetup(const files::Record& record, const files::Accelerometer& accelerometer,
                                 const std::optional<files::NavigationTruth>& truth,
                                 const NavigationOptions& options)
    : record_(record),
      accelerometer_(accelerometer),
      truth_(truth),
      options_(options),
      bias_source_(chosen(options.bias, truth && truth->truth.has_attitude())) {
  if (bias_source_ == BiasSource::kTruth && !attitude_from_truth()) {
    throw files::FileError(record.name + ": biases cannot come from the truth: " +
                           (truth ? truth->source + " has no attitude" : "there is none") + "; see --bias");
  }
}

core::InertialSeries NavigationSetup::series_of(const NavigationRun& run) const {
  core::InertialSeries series;
  series.time_s = record_.time_s;
  series.rate_radps = run.gyro_radps;
  for (std::size_t i = 0; i < 3; ++i) series.specific_force_mps2[i] = accelerometer_.specific_force_mps2[i];
  series.rate_delay_samples = run.delay_samples;
  return series;
}

std::optional<core::SensorBias> NavigationSetup::constant_bias(const core::InertialSeries& series) const {
  if (bias_source_ != BiasSource::kTruth) return std::nullopt;
  const auto found =
      core::calibrated_on_truth(series, truth_->truth, options_.reference, {.max_gap_s = truth_->max_gap_s});
  if (found) return found->bias;
  throw files::FileError(record_.name + ": biases cannot come from the truth: " + truth_->source +
                         " has no second with an attitude at both ends; see --bias");
}

NavigationSetup::Start NavigationSetup::start_of(const core::InertialSeries& series,
                                                 const NavigationSpan& span,
                                                 const std::optional<core::SensorBias>& constant) const {
  Start start = start_with_heading(series, span, constant, kRadPerDeg * options_.heading_deg.value_or(0.0));
  if (!matches_heading()) return start;
  return start_with_heading(series, span, constant, matched_heading(series, span, start));
}

core::NavigationState NavigationSetup::known_state(std::size_t index) const {
  core::NavigationState state;
  state.position = options_.reference;
  if (!truth_) return state;
  const core::NavigationState truth = core::truth_at(truth_->truth, record_.time_s[index], truth_->max_gap_s);
  if (truth_->truth.has_attitude()) state.attitude = truth.attitude;
  if (truth_->truth.has_velocity()) state.velocity_mps = truth.velocity_mps;
  if (truth_->truth.has_position()) state.position = truth.position;
  return state;
}

core::InertialSample NavigationSetup::mean_at_rest(const core::InertialSeries& series,
                                                   std::size_t start) const {
  const auto first =
      std::ranges::lower_bound(record_.time_s, record_.time_s[start] - options_.level_s - kTimeTolerance_s);
  return core::mean_of(series, static_cast<std::size_t>(first - record_.time_s.begin()), start + 1);
}

NavigationSetup::Start NavigationSetup::start_with_heading(const core::InertialSeries& series,
                                                           const NavigationSpan& span,
                                                           const std::optional<core::SensorBias>& constant,
                                                           double heading_rad) const {
  Start start{known_state(span.first), constant.value_or(core::SensorBias{})};
  if (!needs_levelling()) return start;
  const core::InertialSample mean = mean_at_rest(series, span.first);
  if (!attitude_from_truth()) start.state.attitude = core::levelled(mean.specific_force_mps2, heading_rad);
  if (bias_source_ == BiasSource::kLevelling) {
    start.bias = core::bias_at_rest(mean.rate_radps, mean.specific_force_mps2, start.state.attitude,
                                    start.state.position);
  }
  return start;
}

/// The angle that turns the solution's changes of velocity, made with heading 0, into the truth's, by least squares.
double NavigationSetup::matched_heading(const core::InertialSeries& series, const NavigationSpan& span,
                                        const Start& start) const {
  const auto states = core::dead_reckoned(series, span.first, span.end, start.state, start.bias);
  const std::span<const double> times = series.time_s.subspan(span.first, span.end - span.first);
  const auto [first, end] = core::elements_within(truth_->truth, times.front(), times.back());
  double along = 0.0;
  double across = 0.0;
  double fastest = 0.0;
  for (std::size_t n = first; n < end; ++n) {
    const Eigen::Vector3d& truth = truth_->truth.velocity_mps[n];
    if (!core::is_known(truth)) continue;
    const Eigen::Vector3d its = truth - start.state.velocity_mps;
    const Eigen::Vector3d mine =
        core::state_at(times, states, truth_->truth.time_s[n]).velocity_mps - start.state.velocity_mps;
    along += mine.x() * its.x() + mine.y() * its.y();
    across += mine.x() * its.y() - mine.y() * its.x();
    fastest = std::max(fastest, its.head<2>().norm());
  }
  return fastest < kLeastSpeedForHeading_mps ? 0.0 : std::atan2(across, along);
}

}  // namespace gyrod::app
