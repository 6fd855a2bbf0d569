#include "core/joint/whittle_fit.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numbers>

#include "core/joint/ar_response.hpp"
#include "core/signal/levinson.hpp"
#include "core/signal/portable_math.hpp"
#include "core/signal/sums.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kLags = kModeLags;
/// Cycles a sample, a hundredth of a bin. Without it the roots of the slow mode go onto the unit circle where nothing else explains the lowest bin,
/// and rounding decides what is made of it.
constexpr double kSlowBandwidth = 1e-5;
/// Of the variance of a mode that is not slow, what the bin at frequency 0 holds at the most.
constexpr double kMostInABin = 0.9;
/// A line of the noise that is stronger than this, in parts of the noise around it, may be stronger still, or beside its place: what is missing there
/// is not motion's.
constexpr double kLineStandsOut = 0.2;
/// Bands where modes may be missing begin here: below, the slow mode's foot is what is not quite right.
constexpr std::size_t kFirstBin = 8;
constexpr std::size_t kNarrowestBand = 4;

}  // namespace

WhittleFit::WhittleFit(std::size_t transform_samples, double bandwidth_cycles, EmdKernel kernel)
    : kernel_(&spectral_kernel(kernel)),
      bins_(transform_samples / 2 + 1),
      cosines_(kLags * bins_),
      sines_(kLags * bins_),
      weights_(kLags * bins_),
      noise_(bins_),
      rest_(bins_),
      observed_(bins_),
      sum_(bins_),
      deviation_(bins_),
      spectra_(kMaxModes * bins_) {
  const auto length = static_cast<double>(transform_samples);
  for (std::size_t lag = 0; lag < kLags; ++lag) {
    const double angle = 2.0 * std::numbers::pi * bandwidth_cycles * static_cast<double>(lag);
    narrowing_[lag] = portable_exp(-0.5 * angle * angle);
    const double slow_angle = 2.0 * std::numbers::pi * kSlowBandwidth * static_cast<double>(lag);
    slow_narrowing_[lag] = portable_exp(-0.5 * slow_angle * slow_angle);
    for (std::size_t k = 0; k < bins_; ++k) {
      const auto [sine, cosine] = portable_sine_cosine(static_cast<double>(k * lag) / length);
      const double both_signs = k == 0 || k + 1 == bins_ ? 1.0 : 2.0;
      cosines_[lag * bins_ + k] = cosine;
      sines_[lag * bins_ + k] = sine;
      weights_[lag * bins_ + k] = both_signs * cosine / length;
    }
  }
}

void WhittleFit::observe(std::span<const double> periodogram, const NoiseModel& noise,
                         std::span<const SpectralMode> lines) noexcept {
  assert(is_usable(noise) && lines.size() <= kMaxNoiseLines);
  observe(periodogram);
  sum_noise(noise);
  std::ranges::copy(rest_, noise_.begin());
  if (!lines.empty()) {
    for (const SpectralMode& line : lines)
      kernel_->add_spectrum(bins_, line, cosines_.data(), sines_.data(), row(0).data(), noise_.data());
    return;
  }
  for (const SpectralLine& line : noise.lines()) {
    for (std::size_t k = 0; k < bins_; ++k)
      noise_[k] += spread_density(line, 0.5 * static_cast<double>(k) / static_cast<double>(bins_ - 1));
  }
}

void WhittleFit::observe(std::span<const double> periodogram) noexcept {
  assert(periodogram.size() == bins_);
  std::ranges::copy(periodogram, observed_.begin());
}

/// noise_spectrum() without lines at every bin.
void WhittleFit::sum_noise(const NoiseModel& noise) noexcept {
  const double* const cosine = cosines_.data() + bins_;
  const double* const sine = sines_.data() + bins_;
  const auto colour = std::span(noise.colour).first(noise.colour_order);
  for (std::size_t k = 0; k < bins_; ++k)
    rest_[k] = noise.white_variance + noise.colour_variance / ar_response(colour, cosine[k], sine[k]);
}

std::span<const double> WhittleFit::explained(const ModeSet& modes) noexcept {
  sum_spectra(modes);
  double expected = 0.0;
  double believed = 0.0;
  for (std::size_t k = 0; k < bins_; ++k) {
    const double line = noise_[k] - rest_[k];
    const double part = line / sum_[k];
    expected += line + part * part * (observed_[k] - sum_[k]);
    believed += line;
  }
  const double e = believed > 0.0 ? expected / believed : 0.0;
  for (std::size_t k = 0; k < bins_; ++k) sum_[k] += e * (noise_[k] - rest_[k]) - noise_[k];
  return sum_;
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
  LogarithmOfProduct between;
  LogarithmOfProduct ends;
  for (std::size_t k = 0; k < bins_; ++k) {
    const bool end = k == 0 || k + 1 == bins_;
    (end ? ends : between).multiply(sum_[k]);
    sum -= (end ? 0.5 : 1.0) * observed_[k] / sum_[k];
  }
  return sum - between.value() - 0.5 * ends.value();
}

/// Up to each bin: I / M, in deviation_, and I - M.
void WhittleFit::sum_up_missing(std::span<double> power) noexcept {
  double ratios = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < bins_; ++k) {
    double ratio = observed_[k] / sum_[k];
    if (noise_[k] > (1.0 + kLineStandsOut) * rest_[k]) ratio = std::min(ratio, 1.0);
    ratios += ratio;
    sum += (ratio - 1.0) * sum_[k];
    deviation_[k] = ratios;
    power[k] = sum;
  }
}

WhittleFit::Band WhittleFit::least_explained(const ModeSet& modes) noexcept {
  assert(!modes.full());
  sum_spectra(modes);
  const std::span<double> power = row(modes.size());
  sum_up_missing(power);
  const double cycles_a_bin = 0.5 / static_cast<double>(bins_ - 1);
  Band least;
  for (std::size_t width = kNarrowestBand; width <= bins_ / 8; width *= 2) {
    const auto bins = static_cast<double>(width);
    for (std::size_t first = kFirstBin; first + width < bins_; first += width / 4) {
      const std::size_t last = first + width - 1;
      const double mean = (deviation_[last] - deviation_[first - 1]) / bins;
      if (!(mean > 1.0)) continue;
      const double gain = 2.0 * bins * (mean - 1.0 - portable_log(mean));
      if (!(gain > least.gain)) continue;
      least = {.centre_cycles = (static_cast<double>(first) + 0.5 * (bins - 1.0)) * cycles_a_bin,
               .width_cycles = bins * cycles_a_bin,
               .power = 2.0 * (power[last] - power[first - 1]) * cycles_a_bin,
               .gain = gain};
    }
  }
  return least;
}

/// S at every bin; in place of the first row of spectra_ and of sum_.
std::span<const double> WhittleFit::spectrum_of(const SpectralMode& mode) noexcept {
  std::ranges::fill(sum_, 0.0);
  kernel_->add_spectrum(bins_, mode, cosines_.data(), sines_.data(), row(0).data(), sum_.data());
  return row(0);
}

WhittleFit::Weight WhittleFit::weigh(const SpectralMode& mode) noexcept {
  const auto spectrum = spectrum_of(mode);
  double power = 0.0;
  double moment = 0.0;
  for (std::size_t k = 0; k < bins_; ++k) {
    power += spectrum[k];
    moment += spectrum[k] * static_cast<double>(k);
  }
  return {.centre_cycles = power > 0.0 ? 0.5 * moment / power / static_cast<double>(bins_ - 1) : 0.0,
          .power = power / static_cast<double>(bins_)};
}

double WhittleFit::power_from(const SpectralMode& mode, double cycles) noexcept {
  const auto spectrum = spectrum_of(mode);
  double power = 0.0;
  for (std::size_t k = 0; k < bins_; ++k) {
    if (0.5 * static_cast<double>(k) > cycles * static_cast<double>(bins_ - 1)) power += spectrum[k];
  }
  return power / static_cast<double>(bins_);
}

SpectralMode WhittleFit::mode_of(std::span<const double> autocovariance, bool slow) const noexcept {
  assert(autocovariance.size() == kLags);
  std::array<double, kLags> r{};
  for (std::size_t lag = 0; lag < kLags; ++lag)
    r[lag] = autocovariance[lag] * (slow ? slow_narrowing_ : narrowing_)[lag];
  SpectralMode mode;
  mode.slow = slow;
  mode.variance = r[0];
  mode.drive = levinson(r, mode.a);
  return mode;
}

/// S_j of every mode, and M.
void WhittleFit::sum_spectra(const ModeSet& modes) noexcept {
  std::ranges::copy(noise_, sum_.begin());
  for (std::size_t j = 0; j < modes.size(); ++j) {
    kernel_->add_spectrum(bins_, modes.modes()[j], cosines_.data(), sines_.data(), row(j).data(),
                          sum_.data());
  }
  bound_slowest_bin(modes);
}

/// A pole that is much narrower than a bin makes its spectrum at frequency 0 many times what the bin holds. Where two modes have such a pole, either may be
/// what is there, and by S_1 S_2 / M each would be given ever more of it.
void WhittleFit::bound_slowest_bin(const ModeSet& modes) noexcept {
  double sum = noise_[0];
  for (std::size_t j = 0; j < modes.size(); ++j) {
    const SpectralMode& mode = modes.modes()[j];
    const double most = kMostInABin * static_cast<double>(2 * (bins_ - 1)) * mode.variance;
    if (!mode.slow && mode.variance > 0.0) row(j)[0] = std::min(row(j)[0], most);
    sum += row(j)[0];
  }
  sum_[0] = sum;
}

/// post_j = S_j + S_j^2 (I - M) / M^2, and the model that has its autocovariances.
void WhittleFit::maximise(SpectralMode& mode, std::span<const double> spectrum) noexcept {
  std::array<double, kLags> r{};
  kernel_->autocovariances(bins_, spectrum.data(), deviation_.data(), weights_.data(), r.data());
  const bool tone = mode.tone;
  mode = mode_of(r, mode.slow);
  mode.tone = tone;
  if (!mode.slow) mode.drive *= kept_;
}

/// What a mode adds to 2 ln L: 2 sum (ln (M - S) + I / (M - S) - ln M - I / M).
double WhittleFit::gain_of(std::span<const double> spectrum) const noexcept {
  double sum = 0.0;
  LogarithmOfProduct between;
  LogarithmOfProduct ends;
  for (std::size_t k = 0; k < bins_; ++k) {
    const double rest = std::max(sum_[k] - spectrum[k], noise_[k]);
    const bool end = k == 0 || k + 1 == bins_;
    (end ? ends : between).multiply(rest / sum_[k]);
    sum += (end ? 1.0 : 2.0) * (observed_[k] / rest - observed_[k] / sum_[k]);
  }
  return sum + 2.0 * between.value() + ends.value();
}

}  // namespace gyrod::core
