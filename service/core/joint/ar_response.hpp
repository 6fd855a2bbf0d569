/// Spectra of autoregressive processes. Internal to core/joint.
#pragma once

#include <cstddef>
#include <span>

namespace gyrod::core {

/// |1 - a_1 e^-iw - ... - a_p e^-ipw|^2 of cos w and sin w, by Horner's rule in e^-iw.
[[nodiscard]] inline double ar_response(std::span<const double> a, double cosine, double sine) noexcept {
  double real = 0.0;
  double imaginary = 0.0;
  for (std::size_t i = a.size(); i > 0; --i) {
    const double sum = real - a[i - 1];
    real = sum * cosine + imaginary * sine;
    imaginary = imaginary * cosine - sum * sine;
  }
  real += 1.0;
  return real * real + imaginary * imaginary;
}

}  // namespace gyrod::core
