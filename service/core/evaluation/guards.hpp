/// What an estimator must not do to be good: an improvement that fails one of these is a defect.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/evaluation/contender.hpp"
#include "core/evaluation/statistics.hpp"

namespace gyrod::core {

enum class GuardKind : std::uint8_t {
  kMeanPreserved,  ///< shift of the record's mean, in standard errors of the noise's mean; at most 3
  kSlowTurnGain,   ///< gain of an added 0.1 Hz, 5 deg/s swing; off 1 by 0.01 at most
  kSwingGain,      ///< gain of an added 1 Hz, 5 deg/s swing; off 1 by 0.02 at most
  kScaleFactor,    ///< gain of the record's own motion, means over 1 s, ten a second; off 1 by 0.005 at most
  kSeamRoughness,  ///< rms second difference at seams over that elsewhere; at most 1.2, or what the truth's or other places let expect
  kSeamOutliers,  ///< share of second differences at seams beyond the elsewhere 95 % quantile; at most 0.05 + 3 standard errors, or likewise
  kSeamWorstStep,  ///< worst sample-to-sample step at a seam in standard deviations of those elsewhere; at most 3, or likewise
  kDelay,  ///< shift of greatest correlation with the truth, samples (GuardCase::truth_has_own_clock); 0.5 at most, where that is known to 0.25
  kVibrationGain,  ///< gain of an added 27 Hz tone (fs/4 at most) of 1 deg/s; off 1 by 0.1 at most, unless it is beyond the signal band
};

enum class Verdict : std::uint8_t { kPass, kFail, kNotApplicable };

struct Guard {
  GuardKind kind{};
  Verdict verdict = Verdict::kNotApplicable;
  std::optional<double> value;           ///< what the list above names; gains as gains
  std::optional<double> standard_error;  ///< of the value, where it is known
  double limit = 0.0;                    ///< for gains: of |value - 1|
  std::string reason;                    ///< why it is not applicable
  /// Of the three gains: how late the added sine comes out, samples; the group delay of an estimator that answers at once.
  std::optional<double> group_delay_samples = std::nullopt;
};

/// "mean-preserved", ...
[[nodiscard]] std::string_view name_of(GuardKind kind) noexcept;

/// The record on which a method is tried. Rates in deg/s.
struct GuardCase {
  std::span<const double> noisy_dps;  ///< finite
  std::span<const double> truth_dps;  ///< as long; NaN where not known
  SampleRange range;
  double rate_hz = 100.0;
  double max_signal_hz = 0.0;  ///< end of the signal band; 0: there is none
  /// The truth is another sensor's, whose clock may be off by a part of a sample: the guard delay is what is added to that of the record itself.
  bool truth_has_own_clock = false;
};

struct GuardLimits {
  double mean_standard_errors = 3.0;
  double slow_turn = 0.01;
  double swing = 0.02;
  double scale_factor = 0.005;
  double roughness = 1.2;
  double worst_step = 3.0;
  double delay_samples = 0.5;
  double vibration = 0.1;
};

/// All guards of a method, in the order of GuardKind. Runs the method three times more, on the record with a swing added: the change
/// of its answer is regressed on the swing, so that gains do not depend on the record's own motion.
/// @param plain what the method made of the record itself
[[nodiscard]] std::vector<Guard> guards(const Method& method, const Contender& plain, const GuardCase& on,
                                        const GuardLimits& limits = {});

/// The response to a swing of frequency_hz, amplitude_dps, by running the method on the record with it: also the group delay of an
/// estimator that answers at once.
[[nodiscard]] std::optional<SwingResponse> added_swing(const Method& method, const Contender& plain,
                                                       const GuardCase& on, double frequency_hz,
                                                       double amplitude_dps);

}  // namespace gyrod::core
