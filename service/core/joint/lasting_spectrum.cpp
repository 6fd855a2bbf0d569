#include "core/joint/lasting_spectrum.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gyrod::core {
namespace {

void scale(ModeSet& modes, double factor) noexcept {
  for (SpectralMode& mode : modes.modes()) {
    mode.drive *= factor;
    mode.variance *= factor;
    mode.share = 1.0;
  }
}

}  // namespace

void LastingSpectrum::observe(std::span<const double> periodogram, double unit, double amount, double share) {
  if (power_.size() != periodogram.size()) start_anew(periodogram.size());
  amount_ += amount;
  const double weight = std::min(1.0, amount * std::max(share, 1.0 / amount_));
  double sum = 0.0;
  for (std::size_t k = 0; k < power_.size(); ++k) {
    power_[k] += weight * (unit * periodogram[k] - power_[k]);
    sum += power_[k];
  }
  if (!std::isfinite(sum)) start_anew(periodogram.size());
}

void LastingSpectrum::start_anew(std::size_t bins) {
  forget();
  power_.assign(bins, 0.0);
}

void LastingSpectrum::mean(double unit, std::span<double> periodogram) const noexcept {
  assert(periodogram.size() == power_.size());
  std::ranges::transform(power_, periodogram.begin(), [unit](double power) { return power / unit; });
}

void LastingSpectrum::keep(const ModeSet& modes, double unit) noexcept {
  modes_ = modes;
  scale(modes_, unit);
  const bool finite = std::ranges::all_of(modes_.modes(), [](const SpectralMode& mode) {
    return std::isfinite(mode.drive) && std::isfinite(mode.variance) &&
           std::ranges::all_of(mode.a, [](double a) { return std::isfinite(a); });
  });
  if (!finite) modes_.clear();
}

ModeSet LastingSpectrum::modes(double unit) const noexcept {
  ModeSet modes = modes_;
  scale(modes, 1.0 / unit);
  return modes;
}

void LastingSpectrum::forget() noexcept {
  power_.clear();
  amount_ = 0.0;
  modes_.clear();
}

}  // namespace gyrod::core
