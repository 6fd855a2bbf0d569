/// Recency-warped sine tapers: spectra of a window that look at its newest part most.
#pragma once

#include <bit>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "core/signal/real_transform.hpp"

namespace gyrod::core {

/// For a window of n samples, u = (i + 1/2) / n, and phi(u) = (e^(kappa u) - 1) / (e^kappa - 1),
///   t_k(i) = sin(pi k phi(u)) sqrt(phi'(u)),   k = 1..K,   scaled to sum_i t_k(i)^2 = 1.
/// They stay orthogonal, as sine tapers are; the end of the window counts most.
/// Sizes its workspace once; no call allocates after that. Not thread-safe.
/// Source: Riedel, Sidorenko 1995 (sine tapers); the warp is our own (docs/joint.md).
class RecencyTapers {
 public:
  /// @param max_samples longest window, at least 8; spectra have the bins of the next power of two
  RecencyTapers(std::size_t max_samples, std::size_t tapers, double recency);

  /// From here on; see above. Another value than before costs the next call a table.
  void set_recency(double recency) noexcept;

  /// Length of the transform, a power of two.
  [[nodiscard]] std::size_t transform_samples() const noexcept { return transform_samples_; }
  /// Frequencies 2 pi k / transform_samples(), k = 0 .. transform_samples() / 2.
  [[nodiscard]] std::size_t bins() const noexcept { return bins(max_samples_); }
  /// bins() for windows of this length at the most.
  [[nodiscard]] static constexpr std::size_t bins(std::size_t max_samples) noexcept {
    return std::bit_ceil(max_samples) / 2 + 1;
  }

  /// Mean over the tapers of the periodogram |sum_i t_k(i) x_i e^-iwi|^2, unit^2 per sample: of white noise of variance s^2 it is
  /// s^2 on average.
  /// @pre 8 <= x.size() <= max_samples, power.size() == bins()
  void spectrum(std::span<const double> x, std::span<double> power) noexcept;

  /// The same without what leaks: where slow motion is tens of decibels above the noise, the tapers' steep end lays a false spectrum over some
  /// hertz. So what is tapered is y[n] = x[n] - c x[n-1], with c the first autocorrelation of the tapered samples, and the periodogram is
  /// divided by |1 - c e^-iw|^2 (prewhitening). 1 - c is at least the tapers' own rms frequency: what is slower than that they do not resolve, and the
  /// division would blow up what the differences leave of it.
  /// @pre as above
  void prewhitened_spectrum(std::span<const double> x, std::span<double> power) noexcept;

  /// Before the mean of prewhitened_spectrum() is taken: sum_i t_k(i) y_i e^-iwi / (1 - c e^-iw), taper by taper.
  /// @pre as above, transforms.size() == tapers * bins()
  void prewhitened_transforms(std::span<const double> x, std::span<std::complex<double>> transforms) noexcept;

  /// As many samples, all weighed alike, tell a mean power as well as these tapers do. @pre a call above, of such windows
  [[nodiscard]] double equivalent_samples() const noexcept { return equivalent_samples_; }

  /// Autocovariances of spectrum() without the wrap-around: r_l = mean over tapers of sum_i t(i) x_i t(i+l) x_(i+l), l = 0..r.size()-1.
  /// @pre as above, r.size() <= x.size()
  void autocovariance(std::span<const double> x, std::span<double> r) noexcept;

 private:
  void prepare(std::size_t samples) noexcept;
  [[nodiscard]] std::span<const double> taper(std::size_t k) const noexcept;
  [[nodiscard]] double prewhiten(std::span<const double> x) noexcept;
  void transform(std::span<const double> x, std::size_t k, std::span<std::complex<double>> out) noexcept;
  [[nodiscard]] std::span<double> tapered(std::span<const double> x, std::size_t k) noexcept;

  std::size_t max_samples_;
  std::size_t transform_samples_;
  std::size_t tapers_;
  double recency_;
  std::size_t samples_ = 0;    ///< that the tapers stand for
  std::vector<double> table_;  ///< tapers_ rows of max_samples_
  std::vector<double> work_;
  std::vector<double> whitened_;
  double equivalent_samples_ = 0.0;
  double bandwidth_ = 0.0;          ///< rms of the tapers' own frequencies, rad a sample
  std::vector<double> half_sines_;  ///< sin^2(w / 2)
  RealTransform transform_;
  std::vector<std::complex<double>> transformed_;
};

}  // namespace gyrod::core
