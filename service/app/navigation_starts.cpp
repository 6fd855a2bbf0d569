#include "app/navigation_starts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include <CLI/CLI.hpp>

#include "core/inertial/truth.hpp"
#include "files/file_error.hpp"

namespace gyrod::app {
namespace {

std::string seconds(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g s", value);
  return text;
}

std::vector<double> moving_times(const core::Truth& truth) {
  std::vector<double> times;
  for (std::size_t n = 0; n < truth.velocity_mps.size(); ++n) {
    if (truth.velocity_mps[n].head<2>().norm() > StartFinder::kRestSpeed_mps)
      times.push_back(truth.time_s[n]);
  }
  return times;
}

}  // namespace

StartFinder::StartFinder(std::span<const double> time_s, const std::optional<files::NavigationTruth>& truth,
                         const StartRules& rules, std::string name)
    : time_s_(time_s), truth_(truth), rules_(rules), name_(std::move(name)) {
  if (truth_ && rules_.level_s > 0.0) moving_s_ = moving_times(truth_->truth);
}

StartFinder::Verdict StartFinder::verdict(std::size_t index) const {
  const double t = time_s_[index];
  if (t + rules_.duration_s > time_s_.back() + kTimeTolerance_s) return Verdict::kTooLate;
  if (t + kTimeTolerance_s < rules_.level_s) return Verdict::kTooEarly;
  if (!truth_) return Verdict::kPossible;
  const core::Truth& truth = truth_->truth;
  const core::NavigationState state = core::truth_at(truth, t, truth_->max_gap_s);
  const bool known = (!truth.has_attitude() || core::is_known(state.attitude)) &&
                     (!truth.has_velocity() || core::is_known(state.velocity_mps)) &&
                     (!truth.has_position() || core::is_known(state.position));
  if (!known) return Verdict::kTruthLost;
  const auto moving = std::ranges::lower_bound(moving_s_, t - rules_.level_s);
  return moving != moving_s_.end() && *moving <= t ? Verdict::kMoving : Verdict::kPossible;
}

std::size_t StartFinder::at(double time_s) const {
  const auto found = std::ranges::lower_bound(time_s_, time_s - kTimeTolerance_s);
  if (time_s < 0.0 || found == time_s_.end()) {
    throw CLI::ValidationError(
        "--start",
        "is " + seconds(time_s) + "; expected a time within the recording, 0 to " + seconds(time_s_.back()));
  }
  auto index = static_cast<std::size_t>(found - time_s_.begin());
  while (index + 1 < time_s_.size() && verdict(index) == Verdict::kTruthLost) ++index;
  const Verdict there = verdict(index);
  if (there == Verdict::kPossible) return index;
  throw files::FileError(name_ + ": cannot start at " + seconds(time_s) + ": " + reason(there));
}

std::vector<std::size_t> StartFinder::spread(std::size_t count) const {
  std::vector<std::size_t> possible;
  std::array<std::size_t, 5> tally{};
  for (std::size_t n = 0; n < time_s_.size(); ++n) {
    const Verdict there = verdict(n);
    ++tally[static_cast<std::size_t>(there)];
    if (there == Verdict::kPossible) possible.push_back(n);
  }
  if (possible.empty()) {
    // Of several reasons the one to name is that of the samples that time alone would allow.
    Verdict main =
        rules_.level_s + rules_.duration_s > time_s_.back() ? Verdict::kTooLate : Verdict::kTruthLost;
    if (tally[static_cast<std::size_t>(Verdict::kMoving)] > 0) main = Verdict::kMoving;
    throw files::FileError(name_ + ": cannot start anywhere: " + reason(main));
  }
  std::vector<std::size_t> starts;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t place = count > 1 ? k * (possible.size() - 1) / (count - 1) : 0;
    if (starts.empty() || possible[place] != starts.back()) starts.push_back(possible[place]);
  }
  return starts;
}

std::string StartFinder::reason(Verdict verdict) const {
  switch (verdict) {
    case Verdict::kPossible:
      break;
    case Verdict::kTooEarly:
      return "levelling needs " + seconds(rules_.level_s) + " at rest before it (--level-seconds)";
    case Verdict::kTooLate:
      return "the recording lasts " + seconds(time_s_.back()) + "; needed are " +
             (rules_.level_s > 0.0 ? seconds(rules_.level_s) + " for levelling (--level-seconds) and " : "") +
             seconds(rules_.duration_s) + " of navigation (--duration)";
    case Verdict::kTruthLost:
      return "the truth (" + truth_->source + ") does not know the state there or anywhere after it";
    case Verdict::kMoving:
      return "the truth (" + truth_->source + ") has no attitude, and shows motion in the " +
             seconds(rules_.level_s) + " that roll and pitch would come from; try a shorter --level-seconds";
  }
  return {};
}

}  // namespace gyrod::app
