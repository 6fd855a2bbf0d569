#include "core/signal/autocorrelation.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <complex>
#include <vector>

#include "core/signal/moments.hpp"
#include "core/signal/real_transform.hpp"

namespace gyrod::core {

Autocorrelation::Autocorrelation(std::size_t max_samples)
    : padded_(std::bit_ceil(std::max<std::size_t>(2 * max_samples, 4))),
      transform_(padded_.size()),
      spectrum_(transform_.bins()) {}

/// Of the centred, zero-padded sequence, into the real parts of the spectrum.
void Autocorrelation::power_spectrum(std::span<const double> x) noexcept {
  const double centre = mean(x);
  for (std::size_t n = 0; n < x.size(); ++n) padded_[n] = x[n] - centre;
  std::fill(padded_.begin() + static_cast<std::ptrdiff_t>(x.size()), padded_.end(), 0.0);
  transform_.forward(padded_, spectrum_);
  for (std::complex<double>& bin : spectrum_) bin = std::norm(bin);
}

void Autocorrelation::acf(std::span<const double> x, std::span<double> acf) noexcept {
  assert(!x.empty() && acf.size() <= x.size());
  power_spectrum(x);
  transform_.inverse(spectrum_, padded_);
  const double energy = padded_[0];
  for (std::size_t lag = 0; lag < acf.size(); ++lag) acf[lag] = energy > 0.0 ? padded_[lag] / energy : 0.0;
  if (!acf.empty()) acf[0] = 1.0;
}

double Autocorrelation::acf_variance(std::span<const double> x) noexcept {
  assert(!x.empty());
  power_spectrum(x);
  double sum = 0.0;          // over all bins: length * r_0
  double sum_squares = 0.0;  // over all bins: length * sum of r_l^2 over lags -(N-1) .. N-1
  for (std::size_t bin = 0; bin < spectrum_.size(); ++bin) {
    const double power = spectrum_[bin].real();
    const double weight = bin == 0 || bin + 1 == spectrum_.size() ? 1.0 : 2.0;
    sum += weight * power;
    sum_squares += weight * power * power;
  }
  if (!(sum > 0.0)) return 0.0;
  const double all_lags = static_cast<double>(transform_.length()) * (sum_squares / sum / sum);
  const double count = static_cast<double>(x.size());
  const double mean_square = (all_lags + 1.0) / 2.0 / count;
  const double mean_rho = 0.5 / count;
  return std::max(mean_square - mean_rho * mean_rho, 0.0);
}

void partial_autocorrelation(std::span<const double> acf, std::span<double> pacf) noexcept {
  constexpr std::size_t kMaxLag = 256;
  assert(acf.size() > pacf.size() && pacf.size() <= kMaxLag);
  std::array<double, kMaxLag> phi{};
  std::array<double, kMaxLag> previous{};
  double error = 1.0;
  for (std::size_t order = 1; order <= pacf.size(); ++order) {
    double numerator = acf[order];
    for (std::size_t i = 1; i < order; ++i) numerator -= previous[i - 1] * acf[order - i];
    const double reflection = error > 0.0 ? std::clamp(numerator / error, -1.0, 1.0) : 0.0;
    for (std::size_t i = 1; i < order; ++i)
      phi[i - 1] = previous[i - 1] - reflection * previous[order - i - 1];
    phi[order - 1] = reflection;
    std::copy_n(phi.begin(), order, previous.begin());
    error *= 1.0 - reflection * reflection;
    pacf[order - 1] = reflection;
  }
}

}  // namespace gyrod::core
