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
double noise_left(std::span<const double> filtered, const ModelFigures& model,
                  const FilterNoise& noise) noexcept {
  if (!model.used) return noise.noise_variance;
  return noise.noise_variance * std::min(mean_square(filtered) / noise.energy, 1.0);
}

}  // namespace

Denoiser::Denoiser(std::size_t max_samples, const DenoiserOptions& options)
    : options_(options),
      max_samples_(std::max(max_samples, kMinSamples)),
      decomposition_(max_samples_, options.emd, options.screening),
      model_filter_(max_samples_, options.models, options.max_ar_order) {}

void Denoiser::denoise(std::span<const double> window, std::span<double> out, WindowReport& report) noexcept {
  assert(window.size() >= kMinSamples && window.size() <= max_samples_ && out.size() == window.size());
  report = WindowReport{};
  report.window_samples = window.size();
  report.mean = mean(window);
  if (options_.scheme == Scheme::kRaw) {
    std::ranges::copy(window, out.begin());
    return;
  }
  if (options_.scheme == Scheme::kDirect) {
    filter_directly(window, out, report);
    return;
  }
  decomposition_.take_apart(window, report);  // eqs. (1) to (4)
  const std::size_t first = first_kept(options_.scheme, report);
  if (options_.scheme == Scheme::kImproved) {
    filter_mixed(report);  // models, eq. (5), and Kalman filters, eq. (6)
  } else {
    const double floor = report.noise_floor;
    report.output_noise = floor * std::sqrt(noise_line_rest(first + 1));
  }
  decomposition_.reconstruct(first, report.imf_count, out);  // eq. (7)
}

void Denoiser::filter_directly(std::span<const double> window, std::span<double> out,
                               WindowReport& report) noexcept {
  report.noise_floor = std::sqrt(decomposition_.white_noise_variance_of(window));
  std::ranges::transform(window, out.begin(), [&report](double value) { return value - report.mean; });
  const FilterNoise noise = filter_noise_of_record(report, variance(out));
  report.direct_model = model_filter_.filter(out, noise);
  report.output_noise = std::sqrt(noise_left(out, report.direct_model, noise));
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
    const FilterNoise noise = filter_noise_of_imf(report, i);
    report.imf[i].model = model_filter_.filter(decomposition_.imf(i), noise);
    passed += noise_left(decomposition_.imf(i), report.imf[i].model, noise);
  }
  report.output_noise = std::sqrt(passed);
}

std::size_t first_kept(Scheme scheme, const WindowReport& report) noexcept {
  assert(scheme != Scheme::kRaw && scheme != Scheme::kDirect);
  return scheme == Scheme::kAcfEmd ? report.k : report.j;
}

FilterNoise filter_noise_of_imf(const WindowReport& report, std::size_t index) noexcept {
  // The model was fitted to signal and noise together; the signal's share of the energy is 1 - 1/excess.
  constexpr double kLeastSignalShare = 1e-3;
  const ImfFigures& figures = report.imf[index];
  return {.energy = figures.energy,
          .noise_variance = report.noise_floor * report.noise_floor * noise_line_energy(index + 1),
          .signal_share = std::max(1.0 - 1.0 / std::max(figures.excess, 1.0), kLeastSignalShare)};
}

FilterNoise filter_noise_of_record(const WindowReport& report, double energy) noexcept {
  return {.energy = energy, .noise_variance = report.noise_floor * report.noise_floor, .signal_share = 1.0};
}

}  // namespace gyrod::core
