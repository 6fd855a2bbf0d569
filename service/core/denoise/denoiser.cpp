#include "core/denoise/denoiser.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/denoise/noise_line.hpp"
#include "core/signal/moments.hpp"

namespace gyrod::core {

Denoiser::Denoiser(std::size_t max_samples, const DenoiserOptions& options)
    : options_(options),
      max_samples_(std::max(max_samples, kMinSamples)),
      emd_(max_samples_, options.emd),
      autocorrelation_(max_samples_),
      ar_fitter_(max_samples_, options.max_ar_order) {
  const auto max_imfs = static_cast<std::size_t>(options.emd.max_imfs);
  if (max_imfs > kMaxImfs) {
    throw std::invalid_argument("IMF limit is " + std::to_string(max_imfs) + ", expected at most " +
                                std::to_string(kMaxImfs));
  }
  imfs_.resize((max_imfs + 1) *
               max_samples_);  // one row more: the EMD is offered a row before it says there is no mode
  reference_.resize(max_samples_);
}

void Denoiser::denoise(std::span<const double> window, std::span<double> out, WindowReport& report) noexcept {
  assert(window.size() >= kMinSamples && window.size() <= max_samples_ && out.size() == window.size());
  report = WindowReport{};
  report.window_samples = window.size();
  report.mean = mean(window);

  decompose(window, report);  // eq. (1), and the ACF boundary k, eq. (3)
  screen(window, report);     // the PCC boundary j, eq. (2), and the partition, eq. (4)
  model_and_filter(report);   // AR models, eq. (5), and Kalman filters, eq. (6)
  reconstruct(report, out);   // eq. (7)
}

void Denoiser::decompose(std::span<const double> window, WindowReport& report) noexcept {
  const bool stop_at_signal = options_.screening.rule == ScreeningRule::kWindowed;
  emd_.start(window);
  double noise_variance = 0.0;
  bool signal_found = false;
  while (emd_.next_imf(imf(report.imf_count, window.size()))) {
    const std::size_t index = ++report.imf_count;
    const auto mode = imf(index - 1, window.size());
    if (index == 1) noise_variance = white_noise_variance(variance(mode));
    ImfFigures& figures = report.imf[index - 1];
    figures = imf_figures(mode, index, noise_variance, autocorrelation_);
    signal_found = signal_found || is_signal(figures, options_.screening);
    if (!signal_found) report.k = index;
    // What remains beside a signal IMF is kept as it is, so it need not be taken apart.
    if (signal_found && stop_at_signal) break;
  }
  report.noise_floor = std::sqrt(noise_variance);
}

void Denoiser::screen(std::span<const double> window, WindowReport& report) noexcept {
  const std::span<double> reference{reference_.data(), window.size()};
  if (options_.screening.rule == ScreeningRule::kPaper) {
    std::copy(window.begin(), window.end(), reference.begin());
  } else {
    std::fill(reference.begin(), reference.end(), 0.0);
    for (std::size_t i = 0; i < report.k; ++i) {
      const auto mode = imf(i, window.size());
      for (std::size_t n = 0; n < mode.size(); ++n) reference[n] += mode[n];
    }
  }
  for (std::size_t i = 0; i < report.imf_count; ++i) {
    report.imf[i].pcc = pearson_correlation(imf(i, window.size()), reference);
  }
  partition(report, options_.screening);
}

void Denoiser::model_and_filter(WindowReport& report) noexcept {
  const double noise_variance = report.noise_floor * report.noise_floor;
  double passed = noise_variance * noise_line_rest(report.k + 1);
  for (std::size_t i = report.j; i < report.k; ++i) {
    const double line = noise_variance * noise_line_energy(i + 1);
    passed += filter_mixed(imf(i, report.window_samples), report.imf[i], line);
  }
  report.output_noise = std::sqrt(passed);
}

/// Filters one mixed IMF in place; returns the noise variance left in it.
double Denoiser::filter_mixed(std::span<double> imf, ImfFigures& figures, double noise_variance) noexcept {
  const ArModel model = ar_fitter_.fit(imf);
  figures.model.family = model.order > 0 ? ModelFamily::kAr : ModelFamily::kNone;
  figures.model.ar_order = model.order;
  figures.model.ar_coefficients = model.a;
  figures.model.innovation_variance = model.innovation_variance;
  if (model.order == 0) return noise_variance;
  // The model was fitted to signal and noise together; the signal's share of the energy is 1 - 1/excess.
  constexpr double kLeastSignalShare = 1e-3;
  // A spline is so smooth that its AR model predicts it to 1e-17, which no gain can be computed from, nor
  // believed.
  constexpr double kLeastInnovation = 1e-7;
  const double share = std::max(1.0 - 1.0 / std::max(figures.excess, 1.0), kLeastSignalShare);
  const double innovation = std::max(model.innovation_variance * share, kLeastInnovation * figures.energy);
  if (!kalman_.design(model.coefficients(), innovation, noise_variance)) return noise_variance;
  kalman_.filter(imf);
  figures.model.used = true;
  // Not the filter's own error variance, which takes the noise for white: the noise of an IMF lies in the
  // band of its signal, so the filter lets the same part of both through.
  return noise_variance * std::min(mean_square(imf) / figures.energy, 1.0);
}

void Denoiser::reconstruct(const WindowReport& report, std::span<double> out) const noexcept {
  const auto rest = emd_.residue();
  std::copy(rest.begin(), rest.end(), out.begin());
  for (std::size_t i = report.imf_count; i > report.j; --i) {  // smallest rounding: slow modes first
    const auto mode = imf(i - 1, out.size());
    for (std::size_t n = 0; n < out.size(); ++n) out[n] += mode[n];
  }
}

std::span<double> Denoiser::imf(std::size_t index, std::size_t samples) noexcept {
  return {imfs_.data() + index * max_samples_, samples};
}

std::span<const double> Denoiser::imf(std::size_t index, std::size_t samples) const noexcept {
  return {imfs_.data() + index * max_samples_, samples};
}

}  // namespace gyrod::core
