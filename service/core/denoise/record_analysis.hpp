/// Everything the paper shows of one axis of a whole record, from one decomposition.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/denoise/denoiser.hpp"
#include "core/denoise/identification.hpp"
#include "core/denoise/scheme.hpp"
#include "core/denoise/window_report.hpp"

namespace gyrod::core {

struct RecordAnalysis {
  /// Per IMF: PCC, ACF variance, c_i, mean period, energy, class, model; and j, k, noise floor. As Denoiser reports for the scheme
  /// improved.
  WindowReport report;
  /// IMF 1 at [0]; report.imf_count of them, each as long as the record. As decomposed: mixed ones are not filtered.
  std::vector<std::vector<double>> imfs;
  std::vector<double> residue;
  /// Of IMF j+1 at [0]; k - j of them. Models and evidence behind report.imf[j..k).model.
  std::vector<Identification> mixed;
  /// Of the record itself: the model of the scheme direct.
  Identification direct;
  /// The denoised record of every scheme, at [index of the scheme]; raw is the record itself.
  std::array<std::vector<double>, kSchemes> outputs;

  [[nodiscard]] const std::vector<double>& output(Scheme scheme) const {
    return outputs[static_cast<std::size_t>(scheme)];
  }
};

/// What the paper does with a whole record: its screening rule to the letter, models identified, the mean kept.
[[nodiscard]] DenoiserOptions whole_record_options(DenoiserOptions options = {});

/// Decomposes completely, screens, identifies the model of every mixed IMF and of the record, and makes all schemes' outputs.
/// output(s) is what Denoiser gives for the scheme s with the same options, bit for bit (but for scheme and its cost); models are
/// always identified, so options.models is taken for kIdentified.
/// Allocates; a record of N samples with n IMFs takes about (n + 20) N doubles. Reentrant: axes may run in threads of their own.
/// @param record uniformly sampled, finite, any unit; fewer than Denoiser::kMinSamples samples: no IMF, all outputs are the record
/// @throws std::invalid_argument for an option outside its range
[[nodiscard]] RecordAnalysis analyse_record(std::span<const double> record,
                                            const DenoiserOptions& options = whole_record_options());

}  // namespace gyrod::core
