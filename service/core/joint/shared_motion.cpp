#include "core/joint/shared_motion.hpp"

#include <algorithm>
#include <cassert>

#include "core/signal/moments.hpp"

namespace gyrod::core {
namespace {

/// A band is regressed in so many parts: what couples the axes changes with frequency.
constexpr std::size_t kParts = 2;
/// Complex values of a spectrum that are independent: so many, and the bins as far as the tapers tell them apart. Found on white noise.
/// Source: docs/decisions/0007, "What axes share is no noise".
constexpr double kLeastValues = 1.4;

}  // namespace

SharedMotion::SharedMotion(std::size_t max_samples, const JointOptions& options)
    : options_(options),
      max_samples_(max_samples),
      tapers_(max_samples, options.tapers, options.recency),
      knocks_(max_samples),
      centred_(max_samples) {
  for (auto& transforms : transforms_) transforms.resize(options.tapers * tapers_.bins());
}

void SharedMotion::set_sample_rate(double sample_rate_hz) noexcept {
  tapers_.set_recency(JointScale(sample_rate_hz, max_samples_).recency(options_.recency));
}

void SharedMotion::compare(const std::array<std::span<const double>, kSensorAxes>& axes) noexcept {
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    assert(axes[axis].size() == axes[0].size() && axes[axis].size() <= max_samples_);
    const double offset = mean(axes[axis]);
    centred_.resize(axes[axis].size());
    std::ranges::transform(axes[axis], centred_.begin(), [offset](double value) { return value - offset; });
    knocks_.apply(centred_, options_);
    tapers_.prewhitened_transforms(centred_, transforms_[axis]);
  }
  const double values = tapers_.equivalent_samples() / static_cast<double>(tapers_.transform_samples());
  for (std::size_t band = 0; band < kNoiseBands; ++band) compare(band, values);
}

/// @param values independent complex ones in a bin
void SharedMotion::compare(std::size_t band, double values) noexcept {
  const std::size_t bins = tapers_.bins();
  std::array<double, kSensorAxes> all{};
  std::array<double, kSensorAxes> own{};
  for (std::size_t part = kParts * band; part < kParts * (band + 1); ++part) {
    const std::size_t begin = part * (bins - 1) / (kParts * kNoiseBands) + 1;
    const std::size_t end = (part + 1) * (bins - 1) / (kParts * kNoiseBands) + 1;
    CrossPower power;
    for (std::size_t taper = 0; taper < options_.tapers; ++taper) {
      for (std::size_t bin = taper * bins + begin; bin < taper * bins + end; ++bin) {
        const std::complex<double> x = transforms_[0][bin];
        const std::complex<double> y = transforms_[1][bin];
        const std::complex<double> z = transforms_[2][bin];
        power.own[0] += std::norm(x);
        power.own[1] += std::norm(y);
        power.own[2] += std::norm(z);
        power.shared[0] += y.real() * z.real() + y.imag() * z.imag();
        power.shared[1] += z.real() * x.real() + z.imag() * x.imag();
        power.shared[2] += x.real() * y.real() + x.imag() * y.imag();
      }
    }
    const double independent = 2.0 * (kLeastValues + values * static_cast<double>(end - begin));
    for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
      all[axis] += power.own[axis];
      own[axis] += power.own[axis] * power.unexplained(axis, independent);
    }
  }
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    const double share = own[axis] / all[axis];
    own_[axis][band] = all[axis] > 0.0 && std::isfinite(share) ? share : 1.0;
  }
}

}  // namespace gyrod::core
