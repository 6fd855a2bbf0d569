/// Models a series and filters it on the model: what the schemes do with a mixed IMF, and with a record in the scheme direct.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/denoise/ar_kalman.hpp"
#include "core/denoise/ar_model.hpp"
#include "core/denoise/arma_kalman.hpp"
#include "core/denoise/identification.hpp"

namespace gyrod::core {

/// How models are chosen.
enum class ModelChoice : std::uint8_t {
  kAr,          ///< AR(p), order by BIC, residuals not tested: quick enough for every window
  kIdentified,  ///< AR, MA or ARMA by core/denoise/identification.hpp: for whole records
};

/// What a Kalman filter is told besides the model.
struct FilterNoise {
  /// Variance of the series, unit^2.
  double energy = 0.0;
  /// R, variance of the measurement noise, unit^2.
  double noise_variance = 0.0;
  /// Part of the model's innovation variance that is the signal's, 0..1: q.
  double signal_share = 1.0;
};

/// A model that fails the test of its residuals is used all the same, and reported as not adequate: it is the best of its kind, and a
/// smooth IMF, which is no ARMA process, has none that passes. Where there is no model, or no filter of it, the series stays as it is.
/// Sizes its workspace once; no call allocates after that. Not thread-safe.
class ModelFilter {
 public:
  /// @throws std::invalid_argument for max_ar_order outside 1..kMaxArOrder
  ModelFilter(std::size_t max_samples, ModelChoice choice, std::size_t max_ar_order);

  /// Filters a series in place.
  /// @param series zero-mean, finite; @pre series.size() <= max_samples
  [[nodiscard]] ModelFigures filter(std::span<double> series, const FilterNoise& noise) noexcept;

  /// Of the last series. @pre the choice is kIdentified
  [[nodiscard]] const Identification& identification() const noexcept { return identification_; }

 private:
  [[nodiscard]] ModelFigures filter_ar(std::span<double> series, const FilterNoise& noise) noexcept;
  [[nodiscard]] ModelFigures filter_identified(std::span<double> series, const FilterNoise& noise) noexcept;

  std::optional<ArFitter> ar_fitter_;
  std::optional<Identifier> identifier_;
  Identification identification_;
  ArKalman ar_kalman_;
  ArmaKalman arma_kalman_;
};

}  // namespace gyrod::core
