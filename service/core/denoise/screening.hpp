/// Screening: which IMFs are noise (dropped), mixed (modelled and filtered) and signal (kept).
#pragma once

#include <cstdint>
#include <span>

#include "core/denoise/significance.hpp"
#include "core/denoise/window_report.hpp"
#include "core/signal/autocorrelation.hpp"

namespace gyrod::core {

enum class ScreeningRule : std::uint8_t {
  /// [Yang2019] steps 2 and 3 to the letter: |PCC| with the raw record, ACF variance against 0.001. For long
  /// still records.
  kPaper,
  /// The same two tests restated for windows and moving sensors (docs/method.md, Screen): the ACF variance is
  /// made independent of N, k comes first, and the PCC is taken against the sum of IMF 1..k, so that motion
  /// does not hide the noise.
  kWindowed,
  /// Noise is what lies within the scatter of white noise on the noise line, at a stated rate of false alarms; signal what has more
  /// than max_mixed_excess. Correlations are not asked. For 10 sifts and the mirror rule: Decomposition refuses others.
  kSignificance,
};

struct ScreeningOptions {
  ScreeningRule rule = ScreeningRule::kWindowed;
  /// |PCC| below this is "very weak". Range 0..1. Source: [Yang2019] Table 1.
  double very_weak_pcc = 0.20;
  /// Paper rule: ACF variance above this is signal. Range 0..1. Source: [Yang2019], for N = 360 000.
  double acf_variance = 0.001;
  /// Windowed rule: c_i above this is signal; of 3700 noise IMFs at N = 1024 none exceeded 1.02. Range
  /// 0.5..100.
  double acf_concentration = 1.2;
  /// Windowed rule: a mean period above this is signal, samples; what 0.001 means at N = 360 000
  /// (docs/method.md, Screen). 2..1e6.
  double max_noise_period_samples = 800.0;
  /// Windowed rule: an IMF whose energy exceeds the noise line by this factor is not pure noise, whatever its
  /// PCC. 1..1000.
  double max_noise_excess = 2.0;
  /// Windowed rule: an IMF whose energy exceeds the noise line by this factor is signal. Motion of N/8 to 800
  /// samples a period stays below both figures of the ACF test, and inside the sum of IMF 1..k it would hide
  /// the noise from the PCC. Range 2..1e9.
  double max_mixed_excess = 30.0;
  /// Significance rule: rate at which one IMF of white noise is not taken for noise. Range 1e-6..0.5. Source: the usual 1 %
  /// (Wu, Huang 2004).
  double false_alarm_rate = 0.01;
};

/// Figures of IMF number `index` (1 = fastest) that need the IMF alone: energy, mean period, ACF variance,
/// c_i, excess. Where the excess is known, the evidence of `significance` beside it.
/// @param significance nothing: the noise line does not hold for these IMFs
/// @param noise_variance variance of the channel's white noise, unit^2; 0 if unknown, then excess is 0
[[nodiscard]] ImfFigures imf_figures(std::span<const double> imf, std::size_t index, double noise_variance,
                                     Autocorrelation& autocorrelation,
                                     const SignificanceTest* significance = nullptr) noexcept;

/// The ACF test: true where the rule set takes this IMF for signal.
[[nodiscard]] bool is_signal(const ImfFigures& figures, const ScreeningOptions& options) noexcept;

/// Sets j from the PCCs in report.imf[0..k), 0 <= j <= k: noise are the IMFs from the first one on whose
/// |PCC| stays above "very weak" (and, under the windowed rule, whose energy stays near the noise line); under the significance rule those within the noise band. Then
/// sets every imf_class from j, k.
/// @pre report.imf_count and report.k are set
void partition(WindowReport& report, const ScreeningOptions& options) noexcept;

}  // namespace gyrod::core
