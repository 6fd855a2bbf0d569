/// Which model a series follows: AR, MA or ARMA, of which order, on what evidence. [Yang2019] step 5.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "core/denoise/arma_model.hpp"
#include "core/denoise/correlation_evidence.hpp"
#include "core/denoise/whiteness.hpp"

namespace gyrod::core {

struct IdentificationOptions {
  /// Largest order of AR(p). 1..kMaxArOrder. Source: the paper's orders are 4 and 6 (Table 4).
  std::size_t max_ar_order = 6;
  /// Largest order of MA(q). 0..kMaxMaOrder; 0 leaves AR alone.
  std::size_t max_ma_order = 6;
  /// Largest p and q of ARMA(p, q). 0..kMaxMaOrder; 0 leaves ARMA out.
  std::size_t max_mixed_order = 4;
};

/// The best model of one family, [Yang2019] eq. (5).
struct FamilyBest {
  bool tried = false;
  std::size_t p = 0;
  std::size_t q = 0;
  /// N ln(innovation_variance) + (p + q) ln N over the same rows for all.
  double bic = 0.0;
};

struct Identification {
  CorrelationEvidence evidence;
  /// What Table 2 makes of the evidence.
  ModelFamily by_correlations = ModelFamily::kNone;
  /// What BIC takes, over all families and orders; its family() is the decision.
  ArmaModel model;
  FamilyBest best_ar;
  FamilyBest best_ma;
  FamilyBest best_arma;
  /// Of the model's residuals.
  Whiteness residuals;
};

/// Identifies one series at a time. Sizes its workspace once; identify() allocates nothing and is a pure function of its input. Not
/// thread-safe.
///
/// The decision is BIC's over all candidates. ACF and PACF say why, but do not overrule it: where both tail off slowly, or N is small,
/// no band tells AR(3) from ARMA(2,1), and BIC does (docs/method.md has both rates). Candidates are ranked by Hannan-Rissanen
/// regressions; the best of each family are then fitted by conditional least squares over the same rows.
class Identifier {
 public:
  /// @param max_samples longest series
  /// @throws std::invalid_argument for an option outside its range
  explicit Identifier(std::size_t max_samples, const IdentificationOptions& options = {});
  ~Identifier();
  Identifier(Identifier&&) noexcept;
  Identifier& operator=(Identifier&&) noexcept;

  /// @param x finite, any mean (it is removed), any unit
  /// A constant or too short series has no model: family kNone, its status says why.
  /// @pre x.size() <= max_samples
  [[nodiscard]] Identification identify(std::span<const double> x) noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::core
