#include "app/joint_contender.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "core/denoise/window_report.hpp"
#include "core/joint/joint_fit.hpp"
#include "core/joint/kalman_bank.hpp"

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

}  // namespace

core::Contender joint_contender(const JointRun& run, std::span<const double> noisy) {
  const std::size_t hop = run.options.hop_samples;
  core::JointFit fit(run.window_samples, run.options);
  fit.set_sample_rate(run.sample_rate_hz);
  if (run.max_signal_hz > 0.0 && run.sample_rate_hz > 0.0)
    fit.set_max_signal(run.max_signal_hz / run.sample_rate_hz);
  core::KalmanBank bank(run.options, run.lag_samples);
  const core::NoiseModel first = known_at(run.noise, 1);
  if (core::is_usable(first)) bank.expect_noise(core::noise_variance(first));
  const auto model = std::make_unique<core::JointModel>();
  core::WindowReport report;
  Estimates estimates(noisy.size());
  for (std::size_t t = 0; t < noisy.size(); ++t) {
    const std::size_t end = t >= hop && t % hop == 0 ? t - hop : 0;  // of the window whose model begins here
    if (end >= core::JointFit::kMinSamples) {
      const std::size_t begin = end - std::min(end, run.window_samples);
      fit.fit(noisy.subspan(begin, end - begin), known_at(run.noise, end), *model, report);
      bank.use(*model);
    }
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
  estimates.contender.joints = core::JointPattern{hop, (hop - lag % hop) % hop};
  return std::move(estimates.contender);
}

}  // namespace gyrod::app
