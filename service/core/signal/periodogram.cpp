#include "core/signal/periodogram.hpp"

#include <bit>
#include <cassert>
#include <cmath>

#include "core/signal/moments.hpp"
#include "core/signal/portable_math.hpp"

namespace gyrod::core {

Periodogram::Periodogram(std::size_t samples)
    : taper_(samples), tapered_(samples), transform_(samples), spectrum_(transform_.bins()) {
  assert(samples >= 8 && std::has_single_bit(samples));
  double squares = 0.0;
  for (std::size_t n = 0; n < samples; ++n) {
    const double turns = 0.5 * (static_cast<double>(n) + 0.5) / static_cast<double>(samples);
    const double s = portable_sine_cosine(turns).sine;
    taper_[n] = s * s;
    squares += taper_[n] * taper_[n];
  }
  for (double& weight : taper_) weight /= std::sqrt(squares);
}

double Periodogram::transform(std::span<const double> x, std::span<double> power) noexcept {
  assert(x.size() == samples() && power.size() == bins());
  const std::size_t size = samples();
  const double count = static_cast<double>(size);
  const double centre = mean(x);
  const double middle = 0.5 * (count - 1.0);
  double slope = 0.0;
  for (std::size_t n = 0; n < size; ++n) slope += (static_cast<double>(n) - middle) * (x[n] - centre);
  slope /= count * (count * count - 1.0) / 12.0;  // sum of (n - middle)^2
  double squares = 0.0;
  for (std::size_t n = 0; n < size; ++n) {
    const double rest = x[n] - centre - slope * (static_cast<double>(n) - middle);
    squares += rest * rest;
    tapered_[n] = taper_[n] * rest;
  }
  transform_.forward(tapered_, spectrum_);
  for (std::size_t k = 0; k < power.size(); ++k) power[k] = std::norm(spectrum_[k]);
  return squares / count;
}

}  // namespace gyrod::core
