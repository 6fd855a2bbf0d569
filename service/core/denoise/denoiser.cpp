#include "core/denoise/denoiser.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/denoise/noise_line.hpp"
#include "core/signal/moments.hpp"

namespace gyrod::core {
namespace {

/// Noise variance left in a series after its filter. Not the filter's own error variance, which takes the noise for white: the noise of
/// an IMF lies in the band of its signal, so the filter lets the same part of both through.
double noise_left(std::span<const double> filtered, double energy, double noise_variance,
                  bool used) noexcept {
  return used ? noise_variance * std::min(mean_square(filtered) / energy, 1.0) : noise_variance;
}

}  // namespace

Denoiser::Denoiser(std::size_t max_samples, const DenoiserOptions& options)
    : options_(options),
      max_samples_(std::max(max_samples, kMinSamples)),
      decomposition_(max_samples_, options.emd, options.screening),
      model_filter_(max_samples_, options.models, options.max_ar_order) {}

void Denoiser::denoise(std::span<const double> window, std::span<double> out, WindowReport& report,
                       std::optional<double> noise_variance) noexcept {
  assert(window.size() >= kMinSamples && window.size() <= max_samples_ && out.size() == window.size());
  report = WindowReport{};
  report.window_samples = window.size();
  report.mean = mean(window);
  if (options_.scheme == Scheme::kRaw) {
    std::ranges::copy(window, out.begin());
    return;
  }
  if (options_.scheme == Scheme::kDirect) {
    filter_directly(window, out, report, noise_variance);
  } else {
    decompose_and_filter(window, out, report, noise_variance);
  }
  if (options_.keep_mean) give_mean(report.mean, out);
}

void Denoiser::decompose_and_filter(std::span<const double> window, std::span<double> out,
                                    WindowReport& report, std::optional<double> noise_variance) noexcept {
  decomposition_.take_apart(window, report, noise_variance);  // eqs. (1) to (4)
  const std::size_t first = first_kept(options_.scheme, report);
  if (options_.scheme == Scheme::kImproved) {
    filter_mixed(report);  // models, eq. (5), and Kalman filters, eq. (6)
  } else {
    const double floor = report.noise_floor;
    report.output_noise = floor * std::sqrt(noise_line_rest(first + 1));
  }
  decomposition_.reconstruct(first, report.imf_count, out);  // eq. (7)
}

void Denoiser::filter_directly(std::span<const double> window, std::span<double> out, WindowReport& report,
                               std::optional<double> noise_variance) noexcept {
  report.noise_floor =
      std::sqrt(noise_variance ? *noise_variance : decomposition_.white_noise_variance_of(window));
  std::ranges::transform(window, out.begin(), [&report](double value) { return value - report.mean; });
  const FilterNoise noise = filter_noise_of_record(report, variance(out));
  report.direct_model = model_filter_.filter(out, noise);
  report.output_noise =
      std::sqrt(noise_left(out, noise.energy, noise.noise_variance, report.direct_model.used));
  if (report.direct_model.used) {
    for (double& value : out) value += report.mean;
  } else {
    std::ranges::copy(window, out.begin());
  }
}

void Denoiser::filter_mixed(WindowReport& report) noexcept {
  const double noise_variance = report.noise_floor * report.noise_floor;
  double passed = noise_variance * noise_line_rest(report.k + 1);
  for (std::size_t i = report.j; i < report.k; ++i) {
    const FilterNoise noise = filter_noise_of_imf(report, i, options_.models);
    report.imf[i].model = model_filter_.filter(decomposition_.imf(i), noise);
    passed += noise_left(decomposition_.imf(i), noise.energy, noise_variance * noise_line_energy(i + 1),
                         report.imf[i].model.used);
  }
  report.output_noise = std::sqrt(passed);
}

std::size_t first_kept(Scheme scheme, const WindowReport& report) noexcept {
  assert(scheme != Scheme::kRaw && scheme != Scheme::kDirect);
  return scheme == Scheme::kAcfEmd ? report.k : report.j;
}

FilterNoise filter_noise_of_imf(const WindowReport& report, std::size_t index, ModelChoice models) noexcept {
  // The model was fitted to signal and noise together; the signal's share of the energy is 1 - 1/excess.
  constexpr double kLeastSignalShare = 1e-3;
  const ImfFigures& figures = report.imf[index];
  // An IMF's noise fills the IMF's band as densely as the record's white noise fills all bands. The filter takes R for white: to have
  // the right density in the band, R is the white noise's whole variance. Windows keep the variance that falls into the IMF, which
  // filters less: of few samples the signal's share is not known well enough (docs/method.md).
  const double white = report.noise_floor * report.noise_floor;
  return {.energy = figures.energy,
          .noise_variance = models == ModelChoice::kIdentified ? white : white * noise_line_energy(index + 1),
          .signal_share = std::max(1.0 - 1.0 / std::max(figures.excess, 1.0), kLeastSignalShare)};
}

FilterNoise filter_noise_of_record(const WindowReport& report, double energy) noexcept {
  return {.energy = energy, .noise_variance = report.noise_floor * report.noise_floor, .signal_share = 1.0};
}

void give_mean(double mean, std::span<double> out) noexcept {
  const double shift = mean - core::mean(out);
  for (double& value : out) value += shift;
}

}  // namespace gyrod::core
