/// The two-speed estimator on rows of support/drive_rows.hpp, beside the Butterworth filters tuned on their truth and beside the prototype
/// that gyrod was designed with: what joint_study prints and what core_joint_drives_test holds. Link gyrod_core_evaluation,
/// gyrod_core_joint, gyrod_core_noise, gyrod_files.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/evaluation/butterworth.hpp"
#include "core/evaluation/tuning.hpp"
#include "core/joint/joint_fit.hpp"
#include "core/joint/kalman_bank.hpp"
#include "core/joint/signal_band.hpp"
#include "core/noise/standstill_learner.hpp"
#include "core/noise/still_noise.hpp"
#include "support/drive_rows.hpp"
#include "support/slow_gain.hpp"

namespace gyrod::test {

inline constexpr std::array<std::size_t, 6> kJointLags = {0, 4, 8, 12, 16, 32};
using ByLag = std::array<double, kJointLags.size()>;

/// The prototype's RMSE, deg/s, with noise imu1 x from sample 0: the design's table, to three digits.
struct PrototypeRow {
  static constexpr std::array<std::size_t, 3> kLagIndex = {0, 2, 4};  ///< lags 0, 8, 16 in kJointLags
  const char* row;
  std::array<double, 3> rmse;
};
inline constexpr std::array<PrototypeRow, 18> kPrototype = {{{"06 x", {.240, .213, .211}},
                                                             {"06 y", {.241, .205, .203}},
                                                             {"06 z", {.118, .098, .099}},
                                                             {"09 x", {.273, .243, .243}},
                                                             {"09 y", {.262, .225, .225}},
                                                             {"09 z", {.152, .110, .107}},
                                                             {"06 x at 0.3", {.092, .088, .087}},
                                                             {"06 y at 0.3", {.092, .086, .086}},
                                                             {"06 z at 0.3", {.061, .053, .053}},
                                                             {"09 x at 0.3", {.101, .098, .097}},
                                                             {"09 y at 0.3", {.099, .092, .092}},
                                                             {"09 z at 0.3", {.070, .055, .054}},
                                                             {"06 x at 3", {.503, .458, .456}},
                                                             {"06 y at 3", {.504, .446, .439}},
                                                             {"06 z at 3", {.217, .194, .188}},
                                                             {"09 x at 3", {.521, .482, .482}},
                                                             {"09 y at 3", {.500, .441, .431}},
                                                             {"09 z at 3", {.298, .241, .225}}}};

/// Of a row of hand_rows: nullptr.
inline const PrototypeRow* prototype_of(const DriveRow& row) {
  const auto found =
      std::ranges::find_if(kPrototype, [&row](const PrototypeRow& known) { return row.name == known.row; });
  return found == kPrototype.end() ? nullptr : &*found;
}

struct JointSetting {
  core::JointOptions options;
  std::size_t window = 1024;
  bool told_rate = true;  ///< false: the estimator does not know the sample rate
  double from_s = 20.0;   ///< the part that is judged
  double to_s = 80.0;
  double max_signal_hz =
      0.0;  ///< end of the signal band, which limit() has to know of, too; 0: there is none
};

struct JointFigures {
  ByLag rmse{};                          ///< deg/s
  double normalised_error = 0.0;         ///< mean of error^2 / published variance, lag 16
  double innovation = 0.0;               ///< mean of nu^2 / S
  double alarm = 0.0;                    ///< part of the windows whose noise is said to be wrong
  std::array<core::Measured, 2> gain{};  ///< of slow motion, as the guard scale-factor has it, lag 0 and 16
};

/// What the learner makes of the first minute of the row's noise at rest; (deg/s)^2.
inline core::NoiseModel learned_at_rest(const DriveRow& row) {
  constexpr double kRadians = std::numbers::pi / 180.0;
  core::StandstillLearner learner(row.rate_hz);
  const auto minute = static_cast<std::size_t>(60.0 * row.rate_hz);
  for (const double dps : std::span(row.still_dps).first(minute)) {
    learner.step({dps * kRadians, dps * kRadians, dps * kRadians});
  }
  return core::scaled(learner.models()[0], 1.0 / kRadians);
}

/// A sine in the noise, and in what it is calibrated on: amplitude in standard deviations of the noise, frequency in cycles per sample. None where either is 0.
inline void add_sine(DriveRow& row, double amplitude, double cycles) {
  if (amplitude <= 0.0 || cycles <= 0.0) return;
  const double size = amplitude * std::sqrt(core::noise_variance(core::still_noise(row.still_dps).value()));
  for (std::vector<double>* series : {&row.noisy_dps, &row.still_dps}) {
    for (std::size_t t = 0; t < series->size(); ++t)
      (*series)[t] += size * std::sin(2.0 * std::numbers::pi * cycles * static_cast<double>(t));
  }
}

/// The row at another sample rate: truth by lines, the noise sample by sample.
inline void resample(DriveRow& row, double rate_hz) {
  if (rate_hz == row.rate_hz) return;
  const double step = row.rate_hz / rate_hz;
  const auto count = static_cast<std::size_t>(static_cast<double>(row.truth_dps.size() - 1) / step);
  std::vector<double> noise;  // without the samples that the reference lost
  for (std::size_t n = 0; n < row.noisy_dps.size(); ++n) {
    const double difference = row.noisy_dps[n] - row.truth_dps[n];
    if (std::isfinite(difference)) noise.push_back(difference);
  }
  const std::vector<double> motion = bridged(row.truth_dps);
  std::vector<double> truth(count);
  for (std::size_t n = 0; n < count; ++n) {
    const double at = static_cast<double>(n) * step;
    const auto k = static_cast<std::size_t>(at);
    truth[n] = std::lerp(motion[k], motion[k + 1], at - static_cast<double>(k));
  }
  std::vector<double> noisy(count);
  for (std::size_t n = 0; n < count; ++n) {
    noisy[n] = truth[n] + noise[n % noise.size()];
  }
  row.truth_dps = std::move(truth);
  row.noisy_dps = std::move(noisy);
  row.rate_hz = rate_hz;
}

/// The noise as of a sensor with a low-pass of its own, second order, and so what it is calibrated on. @pre the row is at its sample rate
inline void low_pass_noise(DriveRow& row, double cutoff_hz) {
  const auto sections = core::butterworth(2, cutoff_hz / row.rate_hz);
  core::filter_forward(sections, row.still_dps);
  const std::vector<double> motion = bridged(row.truth_dps);
  for (std::size_t n = 0; n < motion.size(); ++n) row.noisy_dps[n] -= motion[n];
  core::filter_forward(sections, row.noisy_dps);
  for (std::size_t n = 0; n < motion.size(); ++n) row.noisy_dps[n] += motion[n];
}

/// What is asked of the row where there is a signal band.
inline void limit(DriveRow& row, double max_signal_hz) {
  core::SignalBand band;
  band.set(max_signal_hz / row.rate_hz);
  row.truth_dps = core::low_passed(bridged(row.truth_dps), band);
}

/// [begin, end) in samples; the answers to the last of them are 32 late at most.
inline std::array<std::size_t, 2> judged_part(const DriveRow& row, const JointSetting& setting) {
  const auto begin = static_cast<std::size_t>(setting.from_s * row.rate_hz);
  const auto end = static_cast<std::size_t>(setting.to_s * row.rate_hz);
  return {begin, std::min(end, row.noisy_dps.size() - kJointLags.back())};
}

/// The estimator at all lags, from the row's first sample on.
inline JointFigures joint_figures(const DriveRow& row, const core::NoiseModel& noise,
                                  const JointSetting& setting) {
  const std::size_t hop = setting.options.hop_samples;
  core::JointFit fit(setting.window, setting.options);
  fit.set_sample_rate(setting.told_rate ? row.rate_hz : 0.0);
  const bool limited = setting.max_signal_hz > 0.0;
  if (limited) fit.set_max_signal(setting.max_signal_hz / row.rate_hz);
  // Each answers at once, too; for lag 0 that of lag 16 does, as the default has it.
  static_assert(kJointLags.front() == 0);
  constexpr std::size_t kAtOnceOf = 16;
  std::vector<core::KalmanBank> banks;
  for (const std::size_t lag : std::span(kJointLags).subspan(1)) {
    banks.emplace_back(setting.options, lag,
                       limited ? core::SignalBandLimit::kPossible : core::SignalBandLimit::kNone);
    if (core::is_usable(noise)) banks.back().expect_noise(core::noise_variance(noise));
  }
  const auto model = std::make_unique<core::JointModel>();
  core::WindowReport report;
  const auto [begin, end] = judged_part(row, setting);
  JointFigures figures;
  std::array<SlowGain, 2> gains{SlowGain(row.rate_hz), SlowGain(row.rate_hz)};
  double windows = 0.0;
  std::size_t judged = 0;
  for (std::size_t t = 0; t < end + kJointLags.back(); ++t) {
    const std::size_t to = t >= hop && t % hop == 0 ? t - hop : 0;
    if (to >= core::JointFit::kMinSamples) {
      const std::size_t from = to - std::min(to, setting.window);
      fit.fit(std::span(row.noisy_dps).subspan(from, to - from), noise, *model, report);
      for (auto& bank : banks) bank.use(*model);
      if (t >= begin) {
        windows += 1.0;
        figures.alarm += model->noise.disagrees() || model->noise.is_hidden() ? 1.0 : 0.0;
      }
    }
    std::array<core::BankEstimate, kJointLags.size()> estimates;
    for (std::size_t i = 1; i < kJointLags.size(); ++i) {
      const core::BankEstimates answers = banks[i - 1].step(row.noisy_dps[t]);
      if (kJointLags[i] == kAtOnceOf) estimates[0] = answers.realtime;
      estimates[i] = answers.denoised;
    }
    for (std::size_t i = 0; i < kJointLags.size(); ++i) {
      const core::BankEstimate& estimate = estimates[i];
      const std::size_t lag = kJointLags[i];
      if (t < begin + lag || t >= end + lag) continue;
      if (lag == 0 || lag == 16)
        gains[lag / 16].add(row.truth_dps[t - lag], estimate.rate - row.noisy_dps[t - lag]);
      const double error = estimate.rate - row.truth_dps[t - lag];
      if (std::isnan(error)) continue;
      figures.rmse[i] += error * error;
      if (lag != 16) continue;
      ++judged;
      figures.normalised_error += error * error / estimate.variance;
      figures.innovation += banks[i - 1].normalised_innovation();
    }
  }
  const auto count = static_cast<double>(judged);
  for (double& sum : figures.rmse) sum = std::sqrt(sum / count);
  figures.normalised_error /= count;
  figures.innovation /= count;
  figures.alarm /= windows;
  figures.gain = {gains[0].gain(), gains[1].gain()};
  return figures;
}

/// RMSE of the best causal Butterworth filter of order 1, 2 or 4 at any delay up to each lag, its cut-off tuned on the truth; or of raw, where
/// none is better.
inline ByLag best_butterworth(const DriveRow& row, const JointSetting& setting) {
  ByLag best{};
  const auto [begin, end] = judged_part(row, setting);
  double sum = 0.0;
  std::size_t known = 0;
  for (std::size_t n = begin; n < end; ++n) {
    const double error = row.noisy_dps[n] - row.truth_dps[n];
    if (std::isnan(error)) continue;
    sum += error * error;
    ++known;
  }
  best.fill(std::sqrt(sum / static_cast<double>(known)));
  for (const core::Rival rival :
       {core::Rival::kButterworth1, core::Rival::kButterworth2, core::Rival::kButterworth4}) {
    const auto tuned = core::tune(rival, {row.noisy_dps, row.truth_dps, {begin, end}}, kJointLags);
    for (std::size_t i = 0; i < best.size(); ++i) best[i] = std::min(best[i], tuned[i].rmse);
  }
  return best;
}

}  // namespace gyrod::test
