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

/// Bins that lie so many times as dense as the first of them do: straight lines between those.
void spread(std::span<double> power, std::size_t times) noexcept {
  // From the top: what is read lies at or below what is written.
  for (std::size_t k = power.size() - 1; k > 0; --k) {
    const std::size_t below = k / times;
    const double part = static_cast<double>(k % times) / static_cast<double>(times);
    power[k] = part > 0.0 ? std::lerp(power[below], power[below + 1], part) : power[below];
  }
}

/// The first bins become the means of those that lie so many times as dense, weighed by how near they are.
void gather(std::span<double> power, std::size_t times) noexcept {
  for (std::size_t centre = 0; centre < power.size(); centre += times) {
    double sum = power[centre];
    double weights = 1.0;
    for (std::size_t away = 1; away < times; ++away) {
      const double weight = static_cast<double>(times - away) / static_cast<double>(times);
      for (const std::size_t k : {centre - away, centre + away}) {
        if (k >= power.size()) continue;  // below the first, too: it wraps
        sum += weight * power[k];
        weights += weight;
      }
    }
    power[centre / times] = sum / weights;
  }
}

}  // namespace

void LastingSpectrum::observe(std::span<const double> periodogram, double unit, double amount, double share) {
  if (power_.size() != periodogram.size() && !restate(periodogram.size())) start_anew(periodogram.size());
  amount_ += amount;
  const double weight = std::min(1.0, amount * std::max(share, 1.0 / amount_));
  double sum = 0.0;
  for (std::size_t k = 0; k < power_.size(); ++k) {
    power_[k] += weight * (unit * periodogram[k] - power_[k]);
    sum += power_[k];
  }
  if (!std::isfinite(sum)) start_anew(periodogram.size());
}

/// Modes are by cycles per sample and stay. What shorter windows showed counts for less beside longer ones.
/// @return false where the factor is not whole, or there is nothing to restate
bool LastingSpectrum::restate(std::size_t bins) {
  if (power_.size() < 2 || bins < 2) return false;
  const std::size_t before = power_.size() - 1;
  const std::size_t now = bins - 1;
  if (now % before == 0) {
    power_.resize(bins);
    spread(power_, now / before);
    amount_ *= static_cast<double>(before * before) / static_cast<double>(now * now);
    return true;
  }
  if (before % now != 0) return false;
  gather(power_, before / now);
  power_.resize(bins);
  return true;
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
