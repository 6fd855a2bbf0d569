#include "app/joint_contender.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "core/denoise/window_report.hpp"
#include "core/joint/joint_fit.hpp"
#include "core/joint/kalman_bank.hpp"
#include "stream/hop_schedule.hpp"

namespace gyrod::app {
namespace {

/// Estimates and claimed deviations, each at the sample that it is of.
class Estimates {
 public:
  explicit Estimates(std::size_t samples) {
    contender.estimate.assign(samples, std::numeric_limits<double>::quiet_NaN());
    contender.std.emplace(samples, std::numeric_limits<double>::quiet_NaN());
  }

  void put(std::size_t t, const core::BankEstimate& estimate) {
    contender.estimate[t] = estimate.rate;
    (*contender.std)[t] = std::sqrt(estimate.variance);
  }

  core::Contender contender;
};

/// The windows of a record, and the models of each: what the stream's intake and its workers do.
class SlowLoop {
 public:
  explicit SlowLoop(const JointRun& run)
      : run_(run),
        schedule_({.window = static_cast<stream::Position>(run.window_samples),
                   .hop = static_cast<stream::Position>(run.options.hop_samples),
                   .max_hop = static_cast<stream::Position>(run.options.hop_samples),
                   .lag = 0}) {
    prepare_fit();
  }

  /// Makes the model that is used from sample `end` on, if one is. @return null where there is none
  const core::JointModel* model_from(std::size_t end, std::span<const double> noisy) {
    const auto position = static_cast<stream::Position>(end);
    if (end == 0 || !schedule_.due(position)) return nullptr;
    const core::JointModel* made = nullptr;
    if (window_ &&
        window_->end - window_->begin >= static_cast<stream::Position>(core::JointFit::kMinSamples))
      made = fit(noisy);
    if (schedule_.doublings() < run_.doublings && schedule_.can_double(position)) {
      schedule_.double_windows(position);
      prepare_fit();
    }
    window_ = schedule_.take(position);
    return made;
  }

  [[nodiscard]] std::size_t hop() const noexcept { return static_cast<std::size_t>(schedule_.step()); }

 private:
  void prepare_fit() {
    core::JointOptions options = run_.options;
    options.hop_samples = hop();
    fit_.emplace(static_cast<std::size_t>(schedule_.window()), options);
    fit_->set_sample_rate(run_.sample_rate_hz);
    if (run_.max_signal_hz > 0.0 && run_.sample_rate_hz > 0.0)
      fit_->set_max_signal(run_.max_signal_hz / run_.sample_rate_hz);
  }

  const core::JointModel* fit(std::span<const double> noisy) {
    const auto begin = static_cast<std::size_t>(window_->begin);
    const auto end = static_cast<std::size_t>(window_->end);
    fit_->fit(noisy.subspan(begin, end - begin), known_at(run_.noise, end), *model_, report_);
    return model_.get();
  }

  const JointRun& run_;
  stream::HopSchedule schedule_;
  std::optional<core::JointFit> fit_;
  std::optional<stream::WindowJob> window_;  ///< the last one, whose models are still to come
  std::unique_ptr<core::JointModel> model_ = std::make_unique<core::JointModel>();
  core::WindowReport report_;
};

}  // namespace

core::Contender joint_contender(const JointRun& run, std::span<const double> noisy) {
  SlowLoop slow_loop(run);
  core::KalmanBank bank(run.options, run.lag_samples);
  const core::NoiseModel first = known_at(run.noise, 1);
  if (core::is_usable(first)) bank.expect_noise(core::noise_variance(first));
  Estimates estimates(noisy.size());
  for (std::size_t t = 0; t < noisy.size(); ++t) {
    if (const core::JointModel* model = slow_loop.model_from(t, noisy)) bank.use(*model);
    const core::BankEstimates both = bank.step(noisy[t]);
    if (run.realtime) {
      estimates.put(t, both.realtime);
    } else if (t >= run.lag_samples) {
      estimates.put(t - run.lag_samples, both.denoised);
    }
  }
  for (std::size_t age = 0; !run.realtime && age < std::min(run.lag_samples, noisy.size()); ++age) {
    estimates.put(noisy.size() - 1 - age, bank.held(age));
  }
  const std::size_t lag = run.realtime ? 0 : run.lag_samples;
  estimates.contender.name = run.realtime ? "realtime" : "joint";
  estimates.contender.lag_samples = lag;
  estimates.contender.seams = core::seams_every(slow_loop.hop(), lag);
  return std::move(estimates.contender);
}

}  // namespace gyrod::app
