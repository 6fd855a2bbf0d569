/// What the denoiser found in one window of one axis: the figures behind the decision which modes are noise.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace gyrod::core {

/// IMFs a report has room for; EmdOptions::max_imfs may not exceed it.
inline constexpr std::size_t kMaxImfs = 32;
/// Largest AR order that can be asked for.
inline constexpr std::size_t kMaxArOrder = 16;
/// Largest MA order that can be asked for.
inline constexpr std::size_t kMaxMaOrder = 8;

/// Kind of a time-series model, [Yang2019] Table 2.
enum class ModelFamily : std::uint8_t {
  kNone,   ///< no model
  kWhite,  ///< white noise: p = q = 0
  kAr,     ///< AR(p)
  kMa,     ///< MA(q)
  kArma,   ///< ARMA(p, q)
};

/// The time-series model of an IMF or of a record,
///   x[k] = a_1 x[k-1] + ... + a_p x[k-p] + w[k] + b_1 w[k-1] + ... + b_q w[k-q].
struct ModelFigures {
  ModelFamily family = ModelFamily::kNone;
  std::size_t ar_order = 0;
  std::size_t ma_order = 0;
  std::array<double, kMaxArOrder> ar_coefficients{};
  std::array<double, kMaxMaOrder> ma_coefficients{};
  /// Variance of w, unit^2.
  double innovation_variance = 0.0;
  /// Whether the residuals were tested; they are where the family was identified, not on every window.
  bool tested = false;
  /// The residuals look white: the Ljung-Box test did not reject it at 5 % (core/denoise/whiteness.hpp).
  bool adequate = false;
  double ljung_box_p = 0.0;
  /// A Kalman filter was made of it and used; false: what it stands for stayed as it was.
  bool used = false;
};

/// What an IMF was taken for, [Yang2019] eq. (4).
enum class ImfClass : std::uint8_t {
  kNoise,   ///< dropped
  kMixed,   ///< modelled and Kalman filtered
  kSignal,  ///< kept
};

/// One IMF's figures.
struct ImfFigures {
  ImfClass imf_class = ImfClass::kSignal;
  /// Pearson correlation with what the rule set compares with (the raw window, or the sum of IMF 1..k).
  double pcc = 0.0;
  /// Variance of the normalised autocorrelation function over all lags 0..N-1.
  double acf_variance = 0.0;
  /// c_i = acf_variance * N / T_i: for noise 0.63 (IMF 1), 0.54, 0.51, falling to 0.4 with i, at any N.
  double acf_concentration = 0.0;
  /// Mean period T_i = 2 N / zero crossings, samples.
  double mean_period_samples = 0.0;
  /// Variance, unit^2.
  double energy = 0.0;
  /// Energy over that of the channel's white noise in this IMF (the noise line); about 1 is noise. 0 if the
  /// floor is unknown.
  double excess = 0.0;
  /// Excess that white noise has in this IMF, but for the false-alarm rate of the test (ScreeningOptions), and the probability that it is
  /// at least as far from its mean as here; about 0 is no noise. All 0 if the floor is unknown or the noise line does not hold.
  double noise_excess_low = 0.0;
  double noise_excess_high = 0.0;
  double noise_probability = 0.0;
  /// Mixed IMFs only; else none.
  ModelFigures model;
};

/// One axis of one window. Fixed size, so that it is passed around without allocating.
struct WindowReport {
  /// Samples in the window.
  std::size_t window_samples = 0;
  /// Number of IMFs taken out; `imf[0..imf_count)` are valid.
  std::size_t imf_count = 0;
  /// IMF 1..j are noise, j+1..k mixed, the rest (and the residue) signal.
  std::size_t j = 0;
  std::size_t k = 0;
  /// Standard deviation of the input's white noise, in the input's unit; 0 if unknown.
  double noise_floor = 0.0;
  /// Estimated standard deviation of the noise left in the output, in the input's unit. Of model methods not the window's: who runs the filter
  /// fills it in.
  double output_noise = 0.0;
  /// Mean of the window, in the input's unit.
  double mean = 0.0;
  // Model methods only; else 0.
  /// Components of the joint model beside its slowest part.
  std::size_t modes = 0;
  /// The narrow tone that stands out most, cycles per sample, 0 to 0.5; 0 where none is sure (core/joint/tone.hpp).
  double tone_frequency_cycles = 0.0;
  /// Its amplitude, in the input's unit.
  double tone_amplitude = 0.0;
  /// Model of the window itself (scheme direct only; else none).
  ModelFigures direct_model;
  std::array<ImfFigures, kMaxImfs> imf{};
};

}  // namespace gyrod::core
