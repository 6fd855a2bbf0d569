#include "app/evaluation.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <mutex>
#include <span>
#include <utility>

#include "app/evaluated_methods.hpp"
#include "app/rival_families.hpp"
#include "core/signal/moments.hpp"

namespace gyrod::app {
namespace {

constexpr std::size_t kRecordsOfGuards = 4;  ///< the record, and three with a swing on top

double known_std(const std::vector<double>& x, core::SampleRange range) {
  std::vector<double> known;
  for (std::size_t t = range.begin; t < range.end; ++t) {
    if (std::isfinite(x[t])) known.push_back(x[t]);
  }
  return std::sqrt(core::variance(known));
}

/// Tells how far all rows are; remembers that it is to stop. Asked by the threads of all of them.
class Steps {
 public:
  Steps(std::size_t total, const std::function<bool(double)>& look) : total_(total), look_(look) {}

  /// @return false to stop
  bool next() {
    const std::lock_guard lock(mutex_);
    if (!stopped_ && look_) stopped_ = !look_(static_cast<double>(done_) / static_cast<double>(total_));
    ++done_;
    return !stopped_;
  }
  [[nodiscard]] bool stopped() const {
    const std::lock_guard lock(mutex_);
    return stopped_;
  }

 private:
  mutable std::mutex mutex_;
  std::size_t total_;
  const std::function<bool(double)>& look_;
  std::size_t done_ = 0;
  bool stopped_ = false;
};

/// The lags that the methods answer with, rising.
std::vector<std::size_t> own_lags(const EvaluationOptions& options) {
  std::vector<std::size_t> lags;
  for (const std::string& name : options.methods) {
    lags.push_back(answers_at_once(name) ? 0 : options.settings.engine.lag_samples);
  }
  std::ranges::sort(lags);
  lags.erase(std::unique(lags.begin(), lags.end()), lags.end());
  return lags;
}

class RowJudge {
 public:
  RowJudge(const EvaluationRow& row, const EvaluationRows& rows, const EvaluationOptions& options,
           Steps& steps)
      : row_(row),
        rate_hz_(rows.rate_hz),
        truth_has_own_clock_(rows.noise_name.empty()),
        options_(options),
        steps_(steps) {
    judged_.axis = row.axis;
    judged_.noise_scale = row.noise_scale;
    judged_.noise_known_by = row.noise.by;
    judged_.noise_known_from_sample = row.noise.from_sample;
    judged_.noise_std_dps = known_std(row.noise_dps, options.range);
    judged_.truth_std_dps = known_std(row.truth_dps, options.range);
  }

  [[nodiscard]] JudgedRow judge() {
    judge_methods();
    for (const RivalFamily& family : rival_families()) judge_family(family);
    std::vector<core::Method> chosen = evaluated_methods(with_own_lag(), context(), kRecordsOfGuards);
    for (const std::size_t lag : own_lags(options_)) chosen.push_back(butterworth(lag));
    for (const core::Method& one : chosen) closer_look(one);
    if (options_.turns) take_turns(std::span(chosen).subspan(options_.methods.size()));
    return std::move(judged_);
  }

 private:
  [[nodiscard]] std::size_t own_lag() const noexcept { return options_.settings.engine.lag_samples; }
  [[nodiscard]] std::vector<WantedMethod> with_own_lag() const {
    std::vector<WantedMethod> wanted;
    for (const std::string& name : options_.methods) wanted.push_back({name, own_lag()});
    return wanted;
  }
  [[nodiscard]] MethodContext context() const {
    return {.settings = options_.settings,
            .rate_hz = rate_hz_,
            .noise = row_.noise.course,
            .axis = axis_index(row_.axis),
            .sensor = row_.sensor};
  }
  /// For runs that are no part of the record: where rest tells the noise, their own rest does.
  [[nodiscard]] MethodContext context_elsewhere() const {
    return {.settings = options_.settings,
            .rate_hz = rate_hz_,
            .noise = row_.noise.course,
            .learns_itself = row_.noise.learns};
  }
  [[nodiscard]] core::TuningCase tuning_case() const {
    return {row_.noisy_dps, row_.truth_dps, options_.range};
  }

  [[nodiscard]] core::ErrorFigures figures(const core::Contender& contender) const {
    return core::error_figures(row_.truth_dps, contender, {.rate_hz = rate_hz_, .range = options_.range});
  }

  /// What answers at once is judged once, whatever the lag.
  void judge_methods() {
    std::vector<WantedMethod> wanted;
    for (const std::string& name : options_.methods) {
      for (const std::size_t lag : options_.lag_samples) {
        if (lag == options_.lag_samples.front() || !answers_at_once(name)) wanted.push_back({name, lag});
      }
    }
    const std::vector<core::Method> methods = evaluated_methods(wanted, context());
    auto method = methods.begin();
    for (const std::string& name : options_.methods) {
      JudgedEstimator estimator{name, EstimatorKind::kMethod, {}};
      for (const std::size_t lag : options_.lag_samples) {
        if (!steps_.next()) return;
        if (!estimator.lags.empty() && answers_at_once(name)) {
          estimator.lags.push_back(estimator.lags.back());
          estimator.lags.back().lag_bound = lag;
          continue;
        }
        estimator.lags.push_back({lag, method->lag_samples, "", figures(method->run(row_.noisy_dps))});
        ++method;
      }
      judged_.estimators.push_back(std::move(estimator));
    }
  }

  void judge_family(const RivalFamily& family) {
    if (!steps_.next()) return;
    JudgedEstimator estimator{family.name, family.kind, {}};
    for (const core::TunedRival& best : tuned(family, tuning_case(), options_.lag_samples)) {
      const core::Contender contender = core::method_of(best).run(row_.noisy_dps);
      estimator.lags.push_back(
          {best.lag_bound, best.setting.delay, tuning_words(best.setting, rate_hz_), figures(contender)});
    }
    judged_.estimators.push_back(std::move(estimator));
  }

  /// The best that is allowed this lag.
  [[nodiscard]] core::Method butterworth(std::size_t lag) const {
    const auto best = tuned(tuned_butterworths(), tuning_case(), {lag});
    core::Method tuned_one = core::method_of(best[0]);
    tuned_one.name = lag == own_lag() ? kTunedName : std::string(kTunedName) + ", lag " + std::to_string(lag);
    return tuned_one;
  }

  void closer_look(const core::Method& one) {
    if (!steps_.next()) return;
    const core::Contender plain = one.run(row_.noisy_dps);
    add_histogram(one.name, plain);
    if (plain.misfit) note_fit(plain);
    if (!steps_.next()) return;
    const core::GuardCase on{row_.noisy_dps,
                             row_.truth_dps,
                             options_.range,
                             rate_hz_,
                             options_.settings.denoise.max_signal_hz,
                             truth_has_own_clock_};
    judged_.guards.push_back({one.name, core::guards(one, plain, on)});
  }

  /// Of the judged samples.
  [[nodiscard]] double judged_share(const std::vector<bool>& flags) const {
    const auto begin = flags.begin() + static_cast<std::ptrdiff_t>(options_.range.begin);
    const auto end = flags.begin() + static_cast<std::ptrdiff_t>(options_.range.end);
    return static_cast<double>(std::count(begin, end, true)) / static_cast<double>(end - begin);
  }

  void note_fit(const core::Contender& contender) {
    judged_.misfit_share = judged_share(*contender.misfit);
    if (contender.hidden_noise) judged_.hidden_noise_share = judged_share(*contender.hidden_noise);
    judged_.noise_ratio = contender.noise_ratio;
  }

  void take_turns(std::span<const core::Method> filters) {
    std::vector<core::Method> chosen =
        evaluated_methods(with_own_lag(), context_elsewhere(), options_.turn_repeats);
    chosen.insert(chosen.end(), filters.begin(), filters.end());
    core::TurnOptions turn;
    turn.rate_hz = rate_hz_;
    turn.repeats = options_.turn_repeats;
    std::vector<core::TurnTrials> trials;
    for (const core::Method& one : chosen) {
      if (!steps_.next()) return;
      trials.emplace_back(one, row_.noise_dps, turn);
    }
    for (const core::TurnProfile& profile : core::kTurnProfiles) {
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        if (!steps_.next()) return;
        judged_.turns.push_back({chosen[i].name, std::string(profile.name), trials[i].take(profile)});
      }
    }
  }

  /// Bins from -4 to 4 standard deviations of the noise.
  void add_histogram(const std::string& name, const core::Contender& contender) {
    constexpr std::size_t kBins = 81;
    constexpr double kMiddle = 40.0;  // of them
    const double width = 8.0 * std::max(judged_.noise_std_dps, 1e-9) / static_cast<double>(kBins);
    judged_.bin_centres_dps.resize(kBins);
    for (std::size_t i = 0; i < kBins; ++i) {
      judged_.bin_centres_dps[i] = width * (static_cast<double>(i) - kMiddle);
    }
    ErrorHistogram histogram{name, std::vector<double>(kBins, 0.0)};
    double count = 0.0;
    for (std::size_t t = options_.range.begin; t < options_.range.end; ++t) {
      const double error = contender.estimate[t] - row_.truth_dps[t];
      if (!std::isfinite(error)) continue;
      const double bin =
          std::clamp(std::floor(error / width + 0.5 * kBins), 0.0, static_cast<double>(kBins - 1));
      histogram.shares[static_cast<std::size_t>(bin)] += 1.0;
      count += 1.0;
    }
    for (double& share : histogram.shares) share /= std::max(count, 1.0);
    judged_.histograms.push_back(std::move(histogram));
  }

  const EvaluationRow& row_;
  double rate_hz_;
  bool truth_has_own_clock_;  ///< nothing was added to it: what is judged was measured beside it
  const EvaluationOptions& options_;
  Steps& steps_;
  JudgedRow judged_;
};

std::size_t steps_a_row(const EvaluationOptions& options) {
  const std::size_t close = 2 + (options.turns ? 1 + core::kTurnProfiles.size() : 0);
  return options.methods.size() * options.lag_samples.size() + rival_families().size() +
         (own_lags(options).size() + options.methods.size()) * close;
}

}  // namespace

std::vector<JudgedRow> evaluate(const EvaluationRows& rows, const EvaluationOptions& options) {
  Steps steps(rows.rows.size() * steps_a_row(options), options.look);
  std::vector<JudgedRow> judged(rows.rows.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t row = next++; row < judged.size() && !steps.stopped(); row = next++)
      judged[row] = RowJudge(rows.rows[row], rows, options, steps).judge();
  };
  const std::size_t threads = std::clamp<std::size_t>(options.threads, 1, judged.size());
  std::vector<std::future<void>> at_work;
  while (at_work.size() < threads) at_work.push_back(std::async(std::launch::async, work));
  for (std::future<void>& one : at_work) one.get();
  if (steps.stopped()) return {};
  return judged;
}

}  // namespace gyrod::app
