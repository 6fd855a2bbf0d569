#include "core/joint/whittle_fit.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/signal/levinson.hpp"
#include "core/signal/sums.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kLags = kModeOrder + 1;
static_assert(kModeOrder == 3, "spectrum_of() is written out for three coefficients");

/// Smallest |a|^2 that a spectrum is divided by: a pole 1e-12 from the unit circle, far below what the fit can tell.
constexpr double kLeastResponse = 1e-24;

}  // namespace

WhittleFit::WhittleFit(std::size_t transform_samples, double bandwidth_cycles)
    : bins_(transform_samples / 2 + 1),
      cosines_(kLags * bins_),
      sines_(kLags * bins_),
      weights_(kLags * bins_),
      noise_(bins_),
      observed_(bins_),
      sum_(bins_),
      deviation_(bins_),
      posterior_(bins_),
      spectra_(kMaxModes * bins_) {
  const auto length = static_cast<double>(transform_samples);
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    const double angle = 2.0 * std::numbers::pi * bandwidth_cycles * static_cast<double>(lag);
    narrowing_[lag] = std::exp(-0.5 * angle * angle);
    for (std::size_t k = 0; k < bins_; ++k) {
      const double w = 2.0 * std::numbers::pi * static_cast<double>(k * lag) / length;
      const double both_signs = k == 0 || k + 1 == bins_ ? 1.0 : 2.0;
      cosines_[lag * bins_ + k] = std::cos(w);
      sines_[lag * bins_ + k] = std::sin(w);
      weights_[lag * bins_ + k] = both_signs * std::cos(w) / length;
    }
  }
}

void WhittleFit::observe(std::span<const double> periodogram, const NoiseModel& noise) noexcept {
  assert(periodogram.size() == bins_ && is_usable(noise));
  std::ranges::copy(periodogram, observed_.begin());
  if (noise == noise_model_) return;
  noise_model_ = noise;
  for (std::size_t k = 0; k < bins_; ++k) {
    noise_[k] =
        noise_spectrum(noise, std::numbers::pi * static_cast<double>(k) / static_cast<double>(bins_ - 1));
  }
}

void WhittleFit::iterate(ModeSet& modes, int iterations) noexcept {
  for (int i = 0; i < iterations; ++i) {
    sum_spectra(modes);
    for (std::size_t k = 0; k < bins_; ++k) deviation_[k] = (observed_[k] - sum_[k]) / (sum_[k] * sum_[k]);
    for (std::size_t j = 0; j < modes.size(); ++j) maximise(modes.modes()[j], row(j));
  }
}

void WhittleFit::prune(ModeSet& modes, double gain) noexcept {
  while (modes.size() > 1) {
    sum_spectra(modes);
    double least = std::numeric_limits<double>::infinity();
    std::size_t weakest = 0;
    for (std::size_t j = 0; j < modes.size(); ++j) {
      if (modes.modes()[j].slow) continue;
      const double its_gain = gain_of(row(j));
      if (its_gain < least) {
        least = its_gain;
        weakest = j;
      }
    }
    if (!(least < gain)) return;
    modes.remove(weakest);
  }
}

double WhittleFit::log_likelihood(const ModeSet& modes) noexcept {
  sum_spectra(modes);
  double sum = 0.0;
  for (std::size_t k = 0; k < bins_; ++k) {
    const double weight = k == 0 || k + 1 == bins_ ? 0.5 : 1.0;
    sum -= weight * (std::log(sum_[k]) + observed_[k] / sum_[k]);
  }
  return sum;
}

double WhittleFit::centre_cycles(const SpectralMode& mode) noexcept {
  spectrum_of(mode, posterior_);
  double power = 0.0;
  double moment = 0.0;
  for (std::size_t k = 0; k < bins_; ++k) {
    power += posterior_[k];
    moment += posterior_[k] * static_cast<double>(k);
  }
  return power > 0.0 ? 0.5 * moment / power / static_cast<double>(bins_ - 1) : 0.0;
}

SpectralMode WhittleFit::mode_of(std::span<const double> autocovariance, bool slow) const noexcept {
  assert(autocovariance.size() == kLags);
  std::array<double, kLags> r{};
  for (std::size_t lag = 0; lag < kLags; ++lag) r[lag] = autocovariance[lag] * (slow ? 1.0 : narrowing_[lag]);
  SpectralMode mode;
  mode.slow = slow;
  mode.drive = levinson(r, mode.a);
  return mode;
}

/// S_j of every mode, and M.
void WhittleFit::sum_spectra(const ModeSet& modes) noexcept {
  std::ranges::copy(noise_, sum_.begin());
  for (std::size_t j = 0; j < modes.size(); ++j) {
    const auto spectrum = row(j);
    spectrum_of(modes.modes()[j], spectrum);
    for (std::size_t k = 0; k < bins_; ++k) sum_[k] += spectrum[k];
  }
}

/// drive / |a|^2, from real and imaginary part: near zero frequency the coefficients of |a|^2 itself would cancel.
void WhittleFit::spectrum_of(const SpectralMode& mode, std::span<double> out) const noexcept {
  const double* const cosine = cosines_.data();
  const double* const sine = sines_.data();
  const std::size_t n = bins_;
  for (std::size_t k = 0; k < n; ++k) {
    const double real =
        1.0 - mode.a[0] * cosine[n + k] - mode.a[1] * cosine[2 * n + k] - mode.a[2] * cosine[3 * n + k];
    const double imaginary =
        mode.a[0] * sine[n + k] + mode.a[1] * sine[2 * n + k] + mode.a[2] * sine[3 * n + k];
    out[k] = mode.drive / (real * real + imaginary * imaginary + kLeastResponse);
  }
}

/// post_j = S_j + S_j^2 (I - M) / M^2, and the model that has its autocovariances.
void WhittleFit::maximise(SpectralMode& mode, std::span<const double> spectrum) noexcept {
  for (std::size_t k = 0; k < bins_; ++k) {
    posterior_[k] = spectrum[k] + spectrum[k] * spectrum[k] * deviation_[k];
  }
  std::array<double, kLags> r{};
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    const std::span<const double> weights{weights_.data() + lag * bins_, bins_};
    r[lag] = sum_of(posterior_, weights, [](auto power, auto weight) { return power * weight; });
  }
  mode = mode_of(r, mode.slow);
}

/// What a mode adds to 2 ln L: 2 sum (ln (M - S) + I / (M - S) - ln M - I / M).
double WhittleFit::gain_of(std::span<const double> spectrum) const noexcept {
  double sum = 0.0;
  for (std::size_t k = 0; k < bins_; ++k) {
    const double rest = std::max(sum_[k] - spectrum[k], noise_[k]);
    const double weight = k == 0 || k + 1 == bins_ ? 1.0 : 2.0;
    sum += weight * (std::log(rest / sum_[k]) + observed_[k] / rest - observed_[k] / sum_[k]);
  }
  return sum;
}

}  // namespace gyrod::core
