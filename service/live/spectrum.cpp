#include "live/spectrum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/signal/periodogram.hpp"
#include "live/trace.hpp"

namespace gyrod::live {
namespace {

/// The line that is taken away takes its part of these.
constexpr std::size_t kFirstBin = 3;

/// Sums of power over stretches.
class Welch {
 public:
  explicit Welch(std::size_t stretch) : periodogram_(stretch), values_(stretch), power_(periodogram_.bins()) {
    for (auto& sum : sums_) sum.assign(periodogram_.bins(), 0.0);
  }

  void add(std::span<const Point> stretch) {
    for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
      std::ranges::transform(stretch, values_.begin(), [axis](const Point& point) {
        return static_cast<double>(point.rate_radps[axis]);
      });
      periodogram_.transform(values_, power_);
      for (std::size_t k = 0; k < power_.size(); ++k) sums_[axis][k] += power_[k];
    }
    ++stretches_;
  }

  [[nodiscard]] std::size_t stretches() const noexcept { return stretches_; }

  [[nodiscard]] Spectrum spectrum(double sample_rate_hz) const {
    Spectrum made;
    const double step_hz = sample_rate_hz / static_cast<double>(periodogram_.samples());
    const double scale = 2.0 / (sample_rate_hz * static_cast<double>(stretches_));
    for (std::size_t k = kFirstBin; k < power_.size(); ++k) {
      made.frequency_hz.push_back(step_hz * static_cast<double>(k));
      for (std::size_t axis = 0; axis < stream::kAxes; ++axis)
        made.density[axis].push_back(std::sqrt(scale * sums_[axis][k]));
    }
    return made;
  }

 private:
  core::Periodogram periodogram_;
  std::vector<double> values_;
  std::vector<double> power_;
  std::array<std::vector<double>, stream::kAxes> sums_;
  std::size_t stretches_ = 0;
};

}  // namespace

std::optional<std::size_t> stretch_for(std::size_t samples) noexcept {
  constexpr std::size_t kStretches = 4;
  if (samples < 2 * kLeastStretch) return std::nullopt;
  return std::clamp(std::bit_floor(samples / kStretches), kLeastStretch, kMostStretch);
}

std::optional<Spectrum> spectrum_of(std::span<const Point> points, double sample_rate_hz,
                                    std::size_t stretch) {
  Welch welch(stretch);
  std::size_t samples = 0;
  std::size_t begin = 0;
  std::size_t covered = 0;  // points before this are counted
  const double longest_ns = kGapPeriods * 1e9 / sample_rate_hz;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool joins =
        i == begin || static_cast<double>(points[i].stamp_ns - points[i - 1].stamp_ns) <= longest_ns;
    if (!joins) begin = i;
    if (i + 1 - begin < stretch) continue;
    welch.add(points.subspan(begin, stretch));
    samples += i + 1 - std::max(begin, covered);
    covered = i + 1;
    begin += stretch / 2;
  }
  if (welch.stretches() == 0) return std::nullopt;
  Spectrum made = welch.spectrum(sample_rate_hz);
  made.samples = samples;
  return made;
}

}  // namespace gyrod::live
