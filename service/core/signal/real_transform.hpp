/// The discrete Fourier transform of real sequences.
#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <span>

namespace gyrod::core {

/// Eigen's FFT with roots of unity that are the same bits on every machine (portable_math.hpp). Makes its plans on construction; no call allocates
/// after that. Not thread-safe.
class RealTransform {
 public:
  /// @param length samples, a multiple of 4 and above 0
  explicit RealTransform(std::size_t length);
  ~RealTransform();
  RealTransform(RealTransform&&) noexcept;
  RealTransform& operator=(RealTransform&&) noexcept;

  [[nodiscard]] std::size_t length() const noexcept;
  /// Bins 0 .. length() / 2, the frequencies 2 pi k / length().
  [[nodiscard]] std::size_t bins() const noexcept { return length() / 2 + 1; }

  /// spectrum[k] = sum_n x[n] e^(-2 pi i k n / length).
  /// @pre x.size() == length(), spectrum.size() == bins()
  void forward(std::span<const double> x, std::span<std::complex<double>> spectrum) noexcept;
  /// Undoes forward().
  void inverse(std::span<const std::complex<double>> spectrum, std::span<double> x) noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::core
