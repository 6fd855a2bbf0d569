/// The whole two-speed loop, and models to feed it with, for the tests of core/joint.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/joint/joint_fit.hpp"
#include "core/joint/kalman_bank.hpp"
#include "support/signals.hpp"

namespace gyrod::testing {

/// What the loop answered: at sample t the estimate of x[t], from z[..t] and from z[..t+lag] (NaN where there is none).
struct JointOutput {
  Signal realtime, realtime_variance;
  Signal denoised, denoised_variance;
  std::size_t fallbacks = 0;
  bool usable = false;
};

/// A fit every 32 samples from `first` samples on, over windows that grow up to 1024; each model is used one hop later.
inline JointOutput run_joint(const Signal& z, const core::NoiseModel& noise, std::size_t lag,
                             std::size_t first = core::JointFit::kMinSamples, double max_signal_cycles = 0.5,
                             const core::JointOptions& options = {}) {
  constexpr std::size_t kHop = 32;
  constexpr std::size_t kWindow = 1024;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  core::JointFit fit(kWindow, options);
  fit.set_max_signal(max_signal_cycles);
  core::KalmanBank bank(options, lag, core::SignalBandLimit::kPossible);
  core::JointModel model;
  core::WindowReport report;
  JointOutput out;
  for (Signal* signal : {&out.realtime, &out.realtime_variance, &out.denoised, &out.denoised_variance}) {
    signal->assign(z.size(), kNone);
  }
  for (std::size_t t = 0; t < z.size(); ++t) {
    if (t > 0 && t % kHop == 0) {
      bank.use(model);
      const std::size_t samples = std::min(t, kWindow);
      if (samples >= first) {
        fit.fit(std::span(z).subspan(t - samples, samples), noise, model, report);
        out.fallbacks += model.fallbacks;
      }
    }
    const core::BankEstimates now = bank.step(z[t]);
    out.realtime[t] = now.realtime.rate;
    out.realtime_variance[t] = now.realtime.variance;
    if (t < lag) continue;
    out.denoised[t - lag] = now.denoised.rate;
    out.denoised_variance[t - lag] = now.denoised.variance;
  }
  out.usable = model.usable();
  return out;
}

/// Root mean square of a - b over [begin, end).
inline double rms_difference(const Signal& a, const Signal& b, std::size_t begin, std::size_t end) {
  double squares = 0.0;
  for (std::size_t t = begin; t < end; ++t) squares += (a[t] - b[t]) * (a[t] - b[t]);
  return std::sqrt(squares / static_cast<double>(end - begin));
}

/// RMSE of the answers 16 samples late in white noise of variance 1, from sample `begin` on.
inline double denoised_error(const Signal& truth, const Signal& noisy, std::size_t begin,
                             const core::JointOptions& options) {
  const JointOutput out =
      run_joint(noisy, core::white_noise(1.0), 16, core::JointFit::kMinSamples, 0.5, options);
  return rms_difference(out.denoised, truth, begin, truth.size() - 100);
}

/// Of a mode at w, in radians a sample.
inline double spectrum_of(const core::SpectralMode& mode, double w) {
  std::complex<double> a(1.0);
  for (std::size_t i = 0; i < core::kModeOrder; ++i)
    a -= mode.a[i] * std::polar(1.0, -w * static_cast<double>(i + 1));
  return mode.drive / std::norm(a);
}

/// A block whose roots are radius e^(+-i angle).
inline core::FilterBlock oscillation(double radius, double angle, double drive, double signal = 1.0) {
  return {
      .order = 2, .a = {2.0 * radius * std::cos(angle), -radius * radius}, .drive = drive, .signal = signal};
}

}  // namespace gyrod::testing
