#include "core/joint/recency_tapers.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "core/signal/portable_math.hpp"
#include "core/signal/sums.hpp"

namespace gyrod::core {

RecencyTapers::RecencyTapers(std::size_t max_samples, std::size_t tapers, double recency)
    : max_samples_(max_samples),
      transform_samples_(std::bit_ceil(max_samples)),
      tapers_(tapers),
      recency_(recency),
      table_(tapers * max_samples),
      work_(transform_samples_),
      whitened_(max_samples),
      half_sines_(bins()),
      transform_(transform_samples_),
      transformed_(bins()) {
  assert(max_samples >= 8);
  for (std::size_t bin = 0; bin < half_sines_.size(); ++bin) {
    const double turns = 0.5 * static_cast<double>(bin) / static_cast<double>(transform_samples_);
    const double sine = portable_sine_cosine(turns).sine;
    half_sines_[bin] = sine * sine;
  }
}

void RecencyTapers::set_recency(double recency) noexcept {
  if (recency == recency_) return;
  recency_ = recency;
  samples_ = 0;
}

void RecencyTapers::spectrum(std::span<const double> x, std::span<double> power) noexcept {
  assert(power.size() == bins());
  prepare(x.size());
  std::ranges::fill(power, 0.0);
  for (std::size_t k = 0; k < tapers_; ++k) {
    transform(x, k, transformed_);
    for (std::size_t bin = 0; bin < power.size(); ++bin)
      power[bin] += std::norm(transformed_[bin]) / static_cast<double>(tapers_);
  }
}

/// Differences of x, in whitened_. @return c
double RecencyTapers::prewhiten(std::span<const double> x) noexcept {
  std::array<double, 2> r{};
  autocovariance(x, r);
  const double c = r[0] > 0.0 ? std::min(r[1] / r[0], 1.0 - bandwidth_) : 0.0;
  const std::span<double> y = std::span(whitened_).first(x.size());
  y[0] = (1.0 - c) * x[0];
  for (std::size_t i = 1; i < x.size(); ++i) y[i] = x[i] - c * x[i - 1];
  return c;
}

void RecencyTapers::prewhitened_spectrum(std::span<const double> x, std::span<double> power) noexcept {
  const double c = prewhiten(x);
  spectrum(std::span(whitened_).first(x.size()), power);
  for (std::size_t bin = 0; bin < power.size(); ++bin)
    power[bin] /= (1.0 - c) * (1.0 - c) + 4.0 * c * half_sines_[bin];
}

void RecencyTapers::prewhitened_transforms(std::span<const double> x,
                                           std::span<std::complex<double>> transforms) noexcept {
  assert(transforms.size() == tapers_ * bins());
  const double c = prewhiten(x);
  for (std::size_t k = 0; k < tapers_; ++k) {
    const auto made = transforms.subspan(k * bins(), bins());
    transform(std::span(whitened_).first(x.size()), k, made);
    for (std::size_t bin = 0; bin < made.size(); ++bin) {
      const double half = half_sines_[bin];
      made[bin] /= std::complex<double>(1.0 - c + 2.0 * c * half,
                                        2.0 * c * std::sqrt(std::max(half - half * half, 0.0)));
    }
  }
}

void RecencyTapers::autocovariance(std::span<const double> x, std::span<double> r) noexcept {
  assert(r.size() <= x.size());
  prepare(x.size());
  std::ranges::fill(r, 0.0);
  const auto product = [](auto a, auto b) { return a * b; };
  for (std::size_t k = 0; k < tapers_; ++k) {
    const std::span<const double> y = tapered(x, k);
    for (std::size_t lag = 0; lag < r.size(); ++lag) {
      r[lag] += sum_of(y.first(y.size() - lag), y.subspan(lag), product) / static_cast<double>(tapers_);
    }
  }
}

/// Makes the tapers for windows of this length, unless they are.
void RecencyTapers::prepare(std::size_t samples) noexcept {
  assert(samples >= 8 && samples <= max_samples_);
  if (samples == samples_) return;
  samples_ = samples;
  const double last = portable_exp(recency_);
  double slopes = 0.0;
  for (std::size_t k = 0; k < tapers_; ++k) {
    const std::span<double> row{table_.data() + k * max_samples_, samples};
    for (std::size_t i = 0; i < samples; ++i) {
      const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(samples);
      const double slope = portable_exp(recency_ * u);
      const double phi = recency_ > 0.0 ? (slope - 1.0) / (last - 1.0) : u;
      row[i] = portable_sine_cosine(0.5 * static_cast<double>(k + 1) * phi).sine * std::sqrt(slope);
    }
    const double norm = std::sqrt(sum_of(row, [](auto t) { return t * t; }));
    for (double& value : row) value /= norm;
    slopes += row[0] * row[0];
    for (std::size_t i = 1; i < samples; ++i) slopes += (row[i] - row[i - 1]) * (row[i] - row[i - 1]);
  }
  double squares = 0.0;
  for (std::size_t i = 0; i < samples; ++i) {
    double weight = 0.0;
    for (std::size_t k = 0; k < tapers_; ++k)
      weight += taper(k)[i] * taper(k)[i] / static_cast<double>(tapers_);
    squares += weight * weight;
  }
  equivalent_samples_ = 1.0 / squares;
  bandwidth_ = std::sqrt(slopes / static_cast<double>(tapers_));
}

std::span<const double> RecencyTapers::taper(std::size_t k) const noexcept {
  return {table_.data() + k * max_samples_, samples_};
}

void RecencyTapers::transform(std::span<const double> x, std::size_t k,
                              std::span<std::complex<double>> out) noexcept {
  const auto product = tapered(x, k);
  std::fill(work_.begin() + static_cast<std::ptrdiff_t>(product.size()), work_.end(), 0.0);
  transform_.forward(work_, out);
}

std::span<double> RecencyTapers::tapered(std::span<const double> x, std::size_t k) noexcept {
  const auto weights = taper(k);
  for (std::size_t i = 0; i < x.size(); ++i) work_[i] = weights[i] * x[i];
  return {work_.data(), x.size()};
}

}  // namespace gyrod::core
