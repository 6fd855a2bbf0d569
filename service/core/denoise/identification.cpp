#include "core/denoise/identification.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/denoise/arma_fitter.hpp"
#include "core/signal/moments.hpp"
#include "core/signal/sums.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kMaxCandidates = kMaxMaOrder + kMaxMaOrder * kMaxMaOrder;
constexpr std::size_t kMostLags = kMaxArOrder + kMaxMaOrder + kWhitenessFreedom;
using Acf = std::array<double, kMostLags + 1>;

/// MA or ARMA orders, ranked by the regression's BIC.
struct Candidate {
  std::size_t p = 0;
  std::size_t q = 0;
  double bic = 0.0;
};

/// rho_0 .. rho_lags of a zero-mean series, by sums: for so few lags quicker than a Fourier transform.
void few_lags(std::span<const double> x, std::size_t lags, Acf& acf) noexcept {
  const auto lag_sum = [x](std::size_t lag) {
    return sum_of(x.first(x.size() - lag), x.subspan(lag), [](auto a, auto b) { return a * b; });
  };
  const double energy = lag_sum(0);
  acf.fill(0.0);
  acf[0] = 1.0;
  for (std::size_t lag = 1; lag <= lags && energy > 0.0; ++lag) acf[lag] = lag_sum(lag) / energy;
}

void require_at_most(const char* name, std::size_t value, std::size_t least, std::size_t most) {
  if (value >= least && value <= most) return;
  throw std::invalid_argument("identification: " + std::string(name) + " is " + std::to_string(value) +
                              ", expected " + std::to_string(least) + " to " + std::to_string(most));
}

const IdentificationOptions& checked(const IdentificationOptions& options) {
  require_at_most("max_ar_order", options.max_ar_order, 1, kMaxArOrder);
  require_at_most("max_ma_order", options.max_ma_order, 0, kMaxMaOrder);
  require_at_most("max_mixed_order", options.max_mixed_order, 0, kMaxMaOrder);
  return options;
}

}  // namespace

class Identifier::Impl {
 public:
  Impl(std::size_t max_samples, const IdentificationOptions& options)
      : options_(checked(options)),
        fitter_(max_samples, std::max(options.max_ar_order, options.max_mixed_order),
                std::max(options.max_ma_order, options.max_mixed_order)),
        centred_(max_samples) {}

  Identification identify(std::span<const double> x) noexcept {
    Identification found;
    found.model.status = fitter_.start(x);
    if (found.model.status != ArStatus::kFitted) return found;
    look_at_correlations(x, found);

    found.model = fitter_.fit(0, 0);
    best_bic_ = bic(found.model);
    try_ar(found);
    try_others(x.size(), found);
    test_residuals(found);
    return found;
  }

 private:
  /// [Yang2019] eq. (5), for p + q parameters.
  [[nodiscard]] double bic(double variance, std::size_t parameters) const noexcept {
    const auto rows = static_cast<double>(fitter_.rows());
    return rows * std::log(std::max(variance, std::numeric_limits<double>::min())) +
           static_cast<double>(parameters) * std::log(rows);
  }
  [[nodiscard]] double bic(const ArmaModel& model) const noexcept {
    return bic(model.innovation_variance, model.p + model.q);
  }

  void look_at_correlations(std::span<const double> x, Identification& found) noexcept {
    const double centre = mean(x);
    const std::span<double> centred{centred_.data(), x.size()};
    std::ranges::transform(x, centred.begin(), [centre](double value) { return value - centre; });
    few_lags(centred, std::min(kEvidenceLags, x.size() - 1), acf_);
    found.evidence = correlation_evidence(std::span(acf_).first(kEvidenceLags + 1), x.size());
    found.by_correlations = family_by_correlations(found.evidence);
  }

  /// Takes the model where it is the best of its family, and of all.
  void consider(const ArmaModel& model, FamilyBest& best, Identification& found) noexcept {
    if (model.family() == ModelFamily::kNone) return;
    const double value = bic(model);
    if (!best.tried || value < best.bic) best = {true, model.p, model.q, value};
    if (value >= best_bic_) return;
    best_bic_ = value;
    found.model = model;
  }

  void try_ar(Identification& found) noexcept {
    for (std::size_t p = 1; p <= std::min(options_.max_ar_order, fitter_.max_p()); ++p)
      consider(fitter_.fit(p, 0), found.best_ar, found);
  }

  /// MA and ARMA, the best of the regressions' ranking only: a fit costs time in proportion to the record. The longer it is, the
  /// further apart are the candidates and the better is the ranking.
  void try_others(std::size_t samples, Identification& found) noexcept {
    constexpr std::size_t kSamplesInAll = 200'000;
    constexpr std::size_t kLeastFits = 2;
    const std::size_t most = std::max(kLeastFits, kSamplesInAll / samples);
    std::size_t left_ma = most;
    std::size_t left_arma = most;
    for (const Candidate& candidate : ranked()) {
      const bool mixed = candidate.p > 0;
      std::size_t& left = mixed ? left_arma : left_ma;
      if (left == 0) continue;
      --left;
      consider(fitter_.fit(candidate.p, candidate.q), mixed ? found.best_arma : found.best_ma, found);
    }
  }

  [[nodiscard]] std::span<const Candidate> ranked() noexcept {
    std::size_t count = 0;
    const auto add = [&](std::size_t p, std::size_t q) {
      candidates_[count++] = {p, q, bic(fitter_.regression_variance(p, q), p + q)};
    };
    for (std::size_t q = 1; q <= std::min(options_.max_ma_order, fitter_.max_q()); ++q) add(0, q);
    for (std::size_t p = 1; p <= std::min(options_.max_mixed_order, fitter_.max_p()); ++p) {
      for (std::size_t q = 1; q <= std::min(options_.max_mixed_order, fitter_.max_q()); ++q) add(p, q);
    }
    const auto all = std::span(candidates_).first(count);
    std::ranges::sort(all, {}, &Candidate::bic);
    return all;
  }

  void test_residuals(Identification& found) noexcept {
    const std::size_t parameters = found.model.p + found.model.q;
    const auto residuals = fitter_.residuals(found.model);
    const std::size_t lags = whiteness_lags(residuals.size(), parameters);
    few_lags(residuals, lags, acf_);
    found.residuals = test_whiteness(std::span(acf_).first(lags + 1), residuals.size(), parameters);
  }

  IdentificationOptions options_;
  ArmaFitter fitter_;
  std::vector<double> centred_;
  Acf acf_{};
  std::array<Candidate, kMaxCandidates> candidates_{};
  double best_bic_ = 0.0;
};

Identifier::Identifier(std::size_t max_samples, const IdentificationOptions& options)
    : impl_(std::make_unique<Impl>(max_samples, options)) {}
Identifier::~Identifier() = default;
Identifier::Identifier(Identifier&&) noexcept = default;
Identifier& Identifier::operator=(Identifier&&) noexcept = default;

Identification Identifier::identify(std::span<const double> x) noexcept { return impl_->identify(x); }

}  // namespace gyrod::core
