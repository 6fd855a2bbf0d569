#include "core/evaluation/guards.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/evaluation/seams.hpp"

namespace gyrod::core {
namespace {

constexpr double kSwingDps = 5.0;
constexpr double kVibrationDps = 1.0;
constexpr double kVibrationHz = 27.0;
/// Up to this part of the signal band's end its low-pass passes everything.
constexpr double kWithinBand = 0.9;

constexpr std::array<std::string_view, 9> kNames = {"mean-preserved",  "slow-turn-gain", "swing-gain",
                                                    "scale-factor",    "seam-roughness", "seam-outliers",
                                                    "seam-worst-step", "delay",          "vibration-gain"};

Guard not_applicable(GuardKind kind, double limit, std::string reason) {
  return {kind, Verdict::kNotApplicable, std::nullopt, std::nullopt, limit, std::move(reason)};
}

Verdict verdict(bool pass) noexcept { return pass ? Verdict::kPass : Verdict::kFail; }

/// a - b over the range, as long as that.
std::vector<double> difference(std::span<const double> a, std::span<const double> b, SampleRange range) {
  const std::size_t end = std::min({range.end, a.size(), b.size()});
  std::vector<double> result;
  for (std::size_t t = range.begin; t < end; ++t) result.push_back(a[t] - b[t]);
  return result;
}

std::size_t second_of(const GuardCase& on) noexcept {
  return static_cast<std::size_t>(std::max(1LL, std::llround(on.rate_hz)));
}

Guard mean_preserved(const Contender& plain, const GuardCase& on, double limit) {
  const auto moved = batch_mean(difference(plain.estimate, on.noisy_dps, on.range), second_of(on));
  const auto noise = batch_mean(difference(on.noisy_dps, on.truth_dps, on.range), second_of(on));
  if (!moved || !noise) return not_applicable(GuardKind::kMeanPreserved, limit, "less than 2 s are known");
  if (noise->standard_error <= 0.0)
    return not_applicable(GuardKind::kMeanPreserved, limit, "the record has no noise");
  const double value = std::abs(moved->value) / noise->standard_error;
  return {GuardKind::kMeanPreserved, verdict(value <= limit), value, std::nullopt, limit, ""};
}

/// Of a deviation that is known to two standard errors: within the limit, beyond it, or too uncertain to tell.
/// @param expected what the guard's value is where nothing deviates
Guard uncertain_guard(GuardKind kind, const Measured& deviation, double expected, double limit,
                      std::string reason) {
  const auto known = within(deviation, limit);
  Guard guard{
      kind, verdict(known.value_or(false)), expected + deviation.value, deviation.standard_error, limit, ""};
  if (!known) {
    guard.verdict = Verdict::kNotApplicable;
    guard.reason = std::move(reason);
  }
  return guard;
}

struct GainTest {
  GuardKind kind;
  double frequency_hz;
  double amplitude_dps;
  double limit;
};

Guard gain_guard(const Method& method, const Contender& plain, const GuardCase& on, const GainTest& test) {
  if (test.frequency_hz >= on.rate_hz / 2.0)
    return not_applicable(test.kind, test.limit, "it is not below half the sample rate (Nyquist's)");
  const auto response = added_swing(method, plain, on, test.frequency_hz, test.amplitude_dps);
  if (!response)
    return not_applicable(test.kind, test.limit, "the judged samples hold no whole period of it");
  const bool known = std::isfinite(response->standard_error);
  Guard guard = uncertain_guard(test.kind, {response->gain - 1.0, response->standard_error}, 1.0, test.limit,
                                known ? "the answer varies too much to tell" : "less than 20 s are known");
  if (!known) guard.standard_error.reset();
  guard.group_delay_samples = response->delay_samples;
  if (on.max_signal_hz > 0.0 && test.frequency_hz > kWithinBand * on.max_signal_hz) {
    guard.verdict = Verdict::kNotApplicable;
    guard.reason = "it is not within the signal band, which ends at denoise.max_signal_hz";
  }
  return guard;
}

/// What the estimator took away is regressed on the truth: slow noise, which it leaves, is then no part of the uncertainty.
Guard scale_factor(const Contender& plain, const GuardCase& on, double limit) {
  const auto taken = difference(plain.estimate, on.noisy_dps, on.range);
  const auto slope = slow_slope(on.truth_dps.subspan(on.range.begin, taken.size()), taken, on.rate_hz);
  if (!slope)
    return not_applicable(GuardKind::kScaleFactor, limit, "less than 20 s of motion, or none, are known");
  return uncertain_guard(GuardKind::kScaleFactor, *slope, 1.0, limit, "too little slow motion to tell");
}

/// A method may add to the squares of second differences, in parts of what they are elsewhere, limit^2 - 1; where the truth happens to be rougher
/// at seams, as taps that fall there make it, it is not the method's.
double added_roughness(const SeamFigures& figures, double limit) noexcept {
  const double own = std::max(figures.roughness_of_truth, 1.0);
  return std::sqrt(own * own + limit * limit - 1.0);
}

void seam_guards(const Contender& plain, const GuardCase& on, const GuardLimits& limits,
                 std::vector<Guard>& all) {
  const auto figures = seam_figures(plain, on.truth_dps, on.range);
  if (!figures) {
    const std::string reason = plain.seams ? "too few seams among the judged samples" : "it has no seams";
    all.push_back(not_applicable(GuardKind::kSeamRoughness, limits.roughness, reason));
    all.push_back(not_applicable(GuardKind::kSeamOutliers, 0.05, reason));
    all.push_back(not_applicable(GuardKind::kSeamWorstStep, limits.worst_step, reason));
    return;
  }
  const double share_limit =
      std::max(0.05 + 3.0 * figures->outlier_standard_error, figures->outlier_share_by_chance);
  const double roughness_limit =
      std::max(added_roughness(*figures, limits.roughness), figures->roughness_by_chance);
  const double step_limit = std::max(limits.worst_step, figures->worst_step_by_chance);
  all.push_back({GuardKind::kSeamRoughness, verdict(figures->roughness <= roughness_limit),
                 figures->roughness, std::nullopt, roughness_limit, ""});
  all.push_back({GuardKind::kSeamOutliers, verdict(figures->outlier_share <= share_limit),
                 figures->outlier_share, figures->outlier_standard_error, share_limit, ""});
  all.push_back({GuardKind::kSeamWorstStep, verdict(figures->worst_step <= step_limit), figures->worst_step,
                 std::nullopt, step_limit, ""});
}

std::optional<Measured> shift_against_truth(std::span<const double> rates, const GuardCase& on) {
  constexpr std::size_t kFarthest = 64;
  return correlation_peak(on.truth_dps, rates, on.range, kFarthest, kBatchSeconds * second_of(on));
}

Guard delay_guard(const Contender& plain, const GuardCase& on, double limit) {
  auto peak = shift_against_truth(plain.estimate, on);
  if (on.truth_has_own_clock && peak) {
    const auto of_record = shift_against_truth(on.noisy_dps, on);
    peak = of_record ? std::optional(Measured{peak->value - of_record->value,
                                              std::hypot(peak->standard_error, of_record->standard_error)})
                     : std::nullopt;
  }
  if (!peak) return not_applicable(GuardKind::kDelay, limit, "its correlation with the truth has no peak");
  Guard guard = uncertain_guard(GuardKind::kDelay, *peak, 0.0, limit,
                                "too little motion that is fast enough, and in the answer, to tell");
  if (plain.lag_samples == 0) {
    guard.verdict = Verdict::kNotApplicable;
    guard.reason = "answers at once: this is its measured delay";
  }
  return guard;
}

}  // namespace

std::string_view name_of(GuardKind kind) noexcept { return kNames[static_cast<std::size_t>(kind)]; }

std::optional<SwingResponse> added_swing(const Method& method, const Contender& plain, const GuardCase& on,
                                         double frequency_hz, double amplitude_dps) {
  const double frequency = frequency_hz / on.rate_hz;
  if (frequency >= 0.5) return std::nullopt;
  std::vector<double> swung(on.noisy_dps.begin(), on.noisy_dps.end());
  for (std::size_t t = 0; t < swung.size(); ++t) {
    swung[t] += amplitude_dps * std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(t));
  }
  std::vector<double> change = method.run(swung).estimate;
  assert(change.size() == plain.estimate.size());
  for (std::size_t t = 0; t < change.size(); ++t) change[t] -= plain.estimate[t];
  return swing_response(change, on.range, frequency, amplitude_dps, kBatchSeconds * second_of(on));
}

std::vector<Guard> guards(const Method& method, const Contender& plain, const GuardCase& on,
                          const GuardLimits& limits) {
  const double vibration_hz = std::min(kVibrationHz, on.rate_hz / 4.0);
  std::vector<Guard> all;
  all.push_back(mean_preserved(plain, on, limits.mean_standard_errors));
  all.push_back(gain_guard(method, plain, on, {GuardKind::kSlowTurnGain, 0.1, kSwingDps, limits.slow_turn}));
  all.push_back(gain_guard(method, plain, on, {GuardKind::kSwingGain, 1.0, kSwingDps, limits.swing}));
  all.push_back(scale_factor(plain, on, limits.scale_factor));
  seam_guards(plain, on, limits, all);
  all.push_back(delay_guard(plain, on, limits.delay_samples));
  all.push_back(gain_guard(method, plain, on,
                           {GuardKind::kVibrationGain, vibration_hz, kVibrationDps, limits.vibration}));
  return all;
}

}  // namespace gyrod::core
