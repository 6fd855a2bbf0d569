#include "core/denoise/arma_fitter.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/signal/moments.hpp"
#include "core/signal/sums.hpp"

namespace gyrod::core {
namespace {

/// Rows that let the start fade; an MA root at 0.95 has faded to 0.08 then, and its square to 0.006.
constexpr std::size_t kFadingRows = 50;

/// Writes lag 1..count of a series into columns of the block, for rows from `row` on.
void put_lags(TallQr& qr, std::size_t column, std::span<const double> series, std::size_t count,
              std::size_t row, std::size_t n) noexcept {
  for (std::size_t lag = 1; lag <= count; ++lag)
    std::ranges::copy(series.subspan(row - lag, n), qr.column(column + lag - 1).begin());
}

/// z[k] minus what is coloured in it: z[k] - sum b_i y[k-i], at sample k >= q.
double whitened(double z, const double* y, std::span<const double> b) noexcept {
  for (std::size_t i = b.size(); i > 0; --i) z -= b[i - 1] * y[-static_cast<std::ptrdiff_t>(i)];
  return z;
}

}  // namespace

ArmaFitter::ArmaFitter(std::size_t max_samples, std::size_t max_p, std::size_t max_q)
    : limit_p_(max_p),
      limit_q_(max_q),
      long_autoregression_(max_samples),
      qr_(max_p + max_q + 1),
      series_(max_samples),
      w_(max_samples),
      u_(max_samples),
      v_(max_samples) {
  assert(max_p <= kMaxArOrder && max_q <= kMaxMaOrder);
}

ArStatus ArmaFitter::start(std::span<const double> x) noexcept {
  assert(x.size() <= series_.size());
  x_ = {series_.data(), x.size()};
  first_row_ = 0;
  max_p_ = max_q_ = 0;
  if (x.size() < kMinSamples) return ArStatus::kTooShort;
  if (!(variance(x) > 0.0)) return ArStatus::kConstant;
  const double centre = mean(x);
  std::ranges::transform(x, series_.begin(), [centre](double value) { return value - centre; });

  const std::size_t n = x.size();
  max_p_ = std::min(limit_p_, n / 8);
  max_q_ = std::min(limit_q_, n / 8);
  const std::size_t order = long_autoregression_.innovations(x_, std::span(w_).first(n));
  first_row_ = std::max({max_p_, order + max_q_, std::min(kFadingRows, n / 10)});

  qr_.start(max_p_ + max_q_ + 1);
  for (std::size_t row = first_row_; row < n; row += TallQr::kBlockRows) {
    const std::size_t count = std::min(TallQr::kBlockRows, n - row);
    put_lags(qr_, 0, x_, max_p_, row, count);
    put_lags(qr_, max_p_, w_, max_q_, row, count);
    std::ranges::copy(x_.subspan(row, count), qr_.column(max_p_ + max_q_).begin());
    qr_.absorb(count);
  }
  lags_ = qr_.factor();
  return ArStatus::kFitted;
}

LeastSquares ArmaFitter::regression(std::size_t p, std::size_t q) const noexcept {
  assert(p <= max_p_ && q <= max_q_);
  std::array<std::size_t, kMaxRegressionColumns> columns{};
  for (std::size_t i = 0; i < p; ++i) columns[i] = i;
  for (std::size_t i = 0; i < q; ++i) columns[p + i] = max_p_ + i;
  return least_squares(lags_, {columns.data(), p + q});
}

double ArmaFitter::regression_variance(std::size_t p, std::size_t q) const noexcept {
  const LeastSquares fit = regression(p, q);
  if (!fit.regular) return std::numeric_limits<double>::infinity();
  return fit.residual_sum / static_cast<double>(rows());
}

ArmaModel ArmaFitter::fit(std::size_t p, std::size_t q) noexcept {
  ArmaModel model;
  const LeastSquares start = regression(p, q);
  if (!start.regular) return model;
  model.status = ArStatus::kFitted;
  model.p = p;
  model.q = q;
  model.innovation_variance = start.residual_sum / static_cast<double>(rows());
  const double deviation = std::sqrt(model.innovation_variance);
  for (std::size_t i = 0; i < p; ++i) {
    model.a[i] = start.coefficients(static_cast<Eigen::Index>(i));
    model.a_error[i] = deviation * start.unit_errors(static_cast<Eigen::Index>(i));
  }
  for (std::size_t i = 0; i < q; ++i) model.b[i] = start.coefficients(static_cast<Eigen::Index>(p + i));
  if (q > 0) refine(model);
  if (model.status == ArStatus::kFitted && !roots_within(model.ar(), ArModel::kMaxRootRadius)) {
    pull_roots_within({model.a.data(), p}, ArModel::kMaxRootRadius);
    model.status = ArStatus::kDamped;
  }
  return model;
}

/// Gauss-Newton on the conditional sum of squares, each step shortened until the sum falls and the model stays invertible.
void ArmaFitter::refine(ArmaModel& model) noexcept {
  constexpr int kMaxSteps = 30;
  // BIC compares rows ln(sum); a step that changes that by less than this changes no decision, and no estimate by a visible part of
  // its standard error.
  constexpr double kSettled = 1e-5;
  if (!invertible_within(model.ma(), ArModel::kMaxRootRadius)) {
    constexpr double kRestart = 0.95;  // well inside: the sum of squares is flat at the circle
    std::array<double, kMaxMaOrder> opposite{};
    std::ranges::transform(model.b, opposite.begin(), [](double value) { return -value; });
    pull_roots_within({opposite.data(), model.q}, kRestart);
    std::ranges::transform(opposite, model.b.begin(), [](double value) { return -value; });
  }
  double sum = filter(model);
  LeastSquares last;
  for (int iteration = 0; iteration < kMaxSteps; ++iteration) {
    last = step(model);
    const double before = sum;
    if (!last.regular || !advance(model, last, sum)) break;
    if (static_cast<double>(rows()) * std::log(before / sum) < kSettled) break;
  }
  if (!std::isfinite(sum) || last.coefficients.size() == 0) {
    model = ArmaModel{};
    return;
  }
  model.innovation_variance = sum / static_cast<double>(rows());
  const double deviation = std::sqrt(model.innovation_variance);
  for (std::size_t i = 0; i < model.p; ++i)
    model.a_error[i] = deviation * last.unit_errors(static_cast<Eigen::Index>(i));
  for (std::size_t i = 0; i < model.q; ++i)
    model.b_error[i] = deviation * last.unit_errors(static_cast<Eigen::Index>(model.p + i));
}

/// Runs the model over the series: innovations w and the two series that their derivatives are lags of,
///   w[k] = x[k] - sum a_i x[k-i] - sum b_i w[k-i],   u[k] = x[k] - sum b_i u[k-i],   v[k] = w[k] - sum b_i v[k-i].
/// @return the sum of w^2 over rows()
double ArmaFitter::filter(const ArmaModel& model) noexcept {
  const std::size_t settled = std::max(model.p, model.q);
  const auto a = model.ar();
  const auto b = model.ma();
  for (std::size_t k = 0; k < settled; ++k) w_[k] = u_[k] = v_[k] = 0.0;
  for (std::size_t k = settled; k < x_.size(); ++k) {
    w_[k] = whitened(whitened(x_[k], x_.data() + k, a), w_.data() + k, b);
    u_[k] = whitened(x_[k], u_.data() + k, b);
    v_[k] = whitened(w_[k], v_.data() + k, b);
  }
  return sum_of(std::span<const double>(w_).subspan(first_row_, rows()), [](auto w) { return w * w; });
}

/// The Gauss-Newton step: regression of w on minus its derivatives.
LeastSquares ArmaFitter::step(const ArmaModel& model) noexcept {
  const std::size_t parameters = model.p + model.q;
  qr_.start(parameters + 1);
  for (std::size_t row = first_row_; row < x_.size(); row += TallQr::kBlockRows) {
    const std::size_t count = std::min(TallQr::kBlockRows, x_.size() - row);
    put_lags(qr_, 0, u_, model.p, row, count);
    put_lags(qr_, model.p, v_, model.q, row, count);
    std::ranges::copy(std::span(w_).subspan(row, count), qr_.column(parameters).begin());
    qr_.absorb(count);
  }
  std::array<std::size_t, kMaxRegressionColumns> columns{};
  for (std::size_t i = 0; i < parameters; ++i) columns[i] = i;
  return least_squares(qr_.factor(), {columns.data(), parameters});
}

/// Goes the step, or a half, a quarter, ... of it. @return false, with model and sum unchanged, where none is better
bool ArmaFitter::advance(ArmaModel& model, const LeastSquares& step, double& sum) noexcept {
  constexpr int kMaxHalvings = 8;
  for (int halving = 0; halving <= kMaxHalvings; ++halving) {
    const double length = std::ldexp(1.0, -halving);
    ArmaModel trial = model;
    for (std::size_t i = 0; i < model.p; ++i)
      trial.a[i] += length * step.coefficients(static_cast<Eigen::Index>(i));
    for (std::size_t i = 0; i < model.q; ++i)
      trial.b[i] += length * step.coefficients(static_cast<Eigen::Index>(model.p + i));
    if (!invertible_within(trial.ma(), ArModel::kMaxRootRadius)) continue;
    const double reached = filter(trial);
    if (reached < sum) {
      model = trial;
      sum = reached;
      return true;
    }
  }
  return false;
}

std::span<const double> ArmaFitter::residuals(const ArmaModel& model) noexcept {
  (void)filter(model);
  return std::span<const double>(w_).subspan(first_row_, rows());
}

}  // namespace gyrod::core
