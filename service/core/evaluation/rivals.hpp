/// The ordinary filters beside which ours stand.
///
/// Each has one parameter (One-Euro two) that decides how much it smooths, and a value of it with which it passes everything. All start as if their first input had been there for ever.
/// Units: any for rates; frequencies in cycles per sample. Functions are pure and may be called from any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace gyrod::core {

enum class Rival : std::uint8_t {
  kRaw,           ///< the record as it is
  kBiasRemoved,   ///< the record less the parameter
  kButterworth1,  ///< parameter: cut-off, cycles per sample
  kButterworth2,
  kButterworth4,
  kExponential,    ///< y += parameter (x - y); parameter 0..1
  kMovingAverage,  ///< parameter: samples, rounded
  kSavitzkyGolay,  ///< parabola through the last samples, read `delay` before its end; parameter: samples, rounded, 1 or at least 3
  kAlphaBeta,      ///< parameter: Kalata's tracking index
  kOneEuro,     ///< parameter: least cut-off; second: cut-off added per root mean square step of the record
  kZeroPhase1,  ///< Butterworth forward and backward, offline only; parameter: cut-off of one pass
  kZeroPhase2,
  kZeroPhase4,
};

inline constexpr std::size_t kRivals = 13;

inline constexpr std::array<Rival, kRivals> kAllRivals = {
    Rival::kRaw,          Rival::kBiasRemoved, Rival::kButterworth1,  Rival::kButterworth2,
    Rival::kButterworth4, Rival::kExponential, Rival::kMovingAverage, Rival::kSavitzkyGolay,
    Rival::kAlphaBeta,    Rival::kOneEuro,     Rival::kZeroPhase1,    Rival::kZeroPhase2,
    Rival::kZeroPhase4};

/// What users call it: "raw", "bias-removed", "butterworth-1", ...
[[nodiscard]] std::string_view name_of(Rival rival) noexcept;

/// False for the zero-phase ones, which need the whole record first.
[[nodiscard]] bool is_causal(Rival rival) noexcept;

/// What kind of number the parameter is.
enum class RivalParameter : std::uint8_t { kNone, kOffset, kCutoff, kShare, kSamples, kIndex };
[[nodiscard]] RivalParameter parameter_of(Rival rival) noexcept;

/// The parameter with which a filter passes what comes in as it is: a cut-off of half the sample rate (One-Euro, whose cut-off has no end:
/// infinite), a share of 1, one sample, an infinite index; 0 of what has no parameter to smooth with.
[[nodiscard]] double pass_through_of(Rival rival) noexcept;

/// One filter with its parameters.
struct RivalSetting {
  Rival rival = Rival::kRaw;
  double parameter = 0.0;
  double second = 0.0;
  std::size_t delay = 0;  ///< of its answer: the output at t is taken for the truth at t - delay
};

/// Its output: element t is what the filter says when x[t] has come in, about x[t - delay]. Only Savitzky-Golay's depends on the
/// delay. As long as x.
/// @pre x is finite; 0 < cut-off <= 0.5 (One-Euro: 0 < cut-off), 0 < share <= 1, index > 0, samples >= 1
[[nodiscard]] std::vector<double> rival_output(const RivalSetting& setting, std::span<const double> x);

/// The same as estimates: element t is of the truth at t; the last `delay` of them, which were never made, are NaN.
[[nodiscard]] std::vector<double> rival_estimate(const RivalSetting& setting, std::span<const double> x);

/// Gains of the steady alpha-beta filter for a tracking index L = (manoeuvre noise / measurement noise) T^2:
///   r = (4 + L - sqrt(8 L + L^2)) / 4,   alpha = 1 - r^2,   beta = 2 (2 - alpha) - 4 sqrt(1 - alpha).
/// Source: Kalata 1984, "The tracking index", IEEE Trans. AES-20(2).
struct AlphaBeta {
  double alpha;
  double beta;
};
[[nodiscard]] AlphaBeta alpha_beta_of(double tracking_index) noexcept;

}  // namespace gyrod::core
