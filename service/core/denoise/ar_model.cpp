#include "core/denoise/ar_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/signal/moments.hpp"
#include "core/signal/sums.hpp"

namespace gyrod::core {
namespace {

void scale_roots(std::span<double> a, double factor) noexcept {
  double power = 1.0;
  for (double& coefficient : a) coefficient *= power *= factor;
}

/// The largest factor in (0, 1) that brings every root within the radius; bisection to one part in 2^30.
double damping_factor(std::span<const double> a, double radius) noexcept {
  double inside = 0.0;
  double outside = 1.0;
  for (int step = 0; step < 30; ++step) {
    const double middle = 0.5 * (inside + outside);
    std::array<double, kMaxArOrder> scaled{};
    std::copy(a.begin(), a.end(), scaled.begin());
    scale_roots({scaled.data(), a.size()}, middle);
    (roots_within({scaled.data(), a.size()}, radius) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

bool roots_within(std::span<const double> a, double radius) noexcept {
  assert(a.size() <= kMaxArOrder && radius > 0.0);
  std::array<double, kMaxArOrder> now{};
  std::copy(a.begin(), a.end(), now.begin());
  scale_roots({now.data(), a.size()}, 1.0 / radius);
  for (std::size_t order = a.size(); order > 0; --order) {
    const double reflection = now[order - 1];
    if (!(std::abs(reflection) < 1.0)) return false;
    const std::array<double, kMaxArOrder> old = now;
    for (std::size_t i = 0; i + 1 < order; ++i) {
      now[i] = (old[i] + reflection * old[order - 2 - i]) / (1.0 - reflection * reflection);
    }
  }
  return true;
}

void pull_roots_within(std::span<double> a, double radius) noexcept {
  scale_roots(a, damping_factor(a, radius));
}

ArFitter::ArFitter(std::size_t max_samples, std::size_t max_order)
    : max_samples_(std::max(max_samples, kMinSamples)), max_order_(max_order) {
  if (max_order < 1 || max_order > kMaxArOrder) {
    throw std::invalid_argument("AR order limit is " + std::to_string(max_order) + ", expected 1.." +
                                std::to_string(kMaxArOrder));
  }
  columns_.resize((max_order_ + 1) * max_samples_);
}

ArModel ArFitter::fit(std::span<const double> x) noexcept {
  assert(x.size() <= max_samples_);
  ArModel model;
  if (x.size() < kMinSamples) return model;
  model.status = ArStatus::kConstant;
  if (!(variance(x) > 0.0)) return model;

  const std::size_t largest = std::min(max_order_, x.size() / 4);
  fill_regression(x, largest);
  const Factorisation qr = factorise(x.size() - largest, largest);
  if (qr.rank == 0) return model;

  model.order = best_order(qr);
  back_substitute(qr, model);
  model.innovation_variance = residual_sum(qr, model.order) / static_cast<double>(qr.rows);
  model.status = ArStatus::kFitted;
  if (!roots_within(model.coefficients(), ArModel::kMaxRootRadius)) {
    pull_roots_within({model.a.data(), model.order}, ArModel::kMaxRootRadius);
    model.status = ArStatus::kDamped;
  }
  return model;
}

void ArFitter::fill_regression(std::span<const double> x, std::size_t order) noexcept {
  for (std::size_t lag = 1; lag <= order + 1; ++lag) {
    // The last column is y itself, which is lag 0.
    const std::size_t shift = lag <= order ? lag : 0;
    std::copy(x.begin() + static_cast<std::ptrdiff_t>(order - shift),
              x.end() - static_cast<std::ptrdiff_t>(shift),
              columns_.begin() + static_cast<std::ptrdiff_t>((lag - 1) * max_samples_));
  }
}

ArFitter::Factorisation ArFitter::factorise(std::size_t rows, std::size_t order) noexcept {
  Factorisation qr{rows, 0, 0.0};
  const auto column = [&](std::size_t index, std::size_t from) {
    return std::span<double>{columns_}.subspan(index * max_samples_ + from, rows - from);
  };
  // A column that adds less than rounding to the ones before it carries no information, and neither do later
  // lags.
  const double negligible = static_cast<double>(rows) * std::numeric_limits<double>::epsilon() *
                            std::sqrt(dot(column(0, 0), column(0, 0)));
  for (std::size_t pivot = 0; pivot < order; ++pivot) {
    const std::span<double> v = column(pivot, pivot);
    const double norm = std::sqrt(dot(v, v));
    if (!(norm > negligible)) break;
    const double diagonal = v[0] > 0.0 ? -norm : norm;
    v[0] -= diagonal;
    const double half_square = -diagonal * v[0];  // v'v / 2 of the Householder vector v
    for (std::size_t other = pivot + 1; other <= order; ++other) {
      const std::span<double> target = column(other, pivot);
      const double factor = dot(v, target) / half_square;
      for (std::size_t n = 0; n < v.size(); ++n) target[n] -= factor * v[n];
    }
    v[0] = diagonal;  // R overwrites the vector's head, the only entry that is read again
    qr.rank = pivot + 1;
  }
  if (qr.rank < order) {  // y moves beside the independent columns
    std::copy_n(column(order, 0).begin(), rows, column(qr.rank, 0).begin());
  }
  const std::span<double> tail = column(qr.rank, qr.rank);
  qr.residual_sum = dot(tail, tail);
  return qr;
}

double ArFitter::residual_sum(const Factorisation& qr, std::size_t order) const noexcept {
  const double* y = columns_.data() + qr.rank * max_samples_;
  double sum = qr.residual_sum;
  for (std::size_t i = qr.rank; i > order; --i) sum += y[i - 1] * y[i - 1];
  return sum;
}

std::size_t ArFitter::best_order(const Factorisation& qr) const noexcept {
  const double rows = static_cast<double>(qr.rows);
  std::size_t best = 1;
  double best_bic = std::numeric_limits<double>::infinity();
  for (std::size_t order = 1; order <= qr.rank; ++order) {
    const double sigma2 = std::max(residual_sum(qr, order) / rows, std::numeric_limits<double>::min());
    const double bic = rows * std::log(sigma2) + static_cast<double>(order) * std::log(rows);
    if (bic < best_bic) {
      best = order;
      best_bic = bic;
    }
  }
  return best;
}

void ArFitter::back_substitute(const Factorisation& qr, ArModel& model) const noexcept {
  const double* y = columns_.data() + qr.rank * max_samples_;
  for (std::size_t row = model.order; row-- > 0;) {
    double value = y[row];
    for (std::size_t i = row + 1; i < model.order; ++i)
      value -= columns_[i * max_samples_ + row] * model.a[i];
    model.a[row] = value / columns_[row * max_samples_ + row];
  }
}

}  // namespace gyrod::core
