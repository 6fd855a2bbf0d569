#include "core/noise/noise_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/noise/spectrum_floor.hpp"

namespace gyrod::core {
namespace {

/// Lowest bin that is looked at: below 1/40 cycle per sample noise is slow, and not a line.
constexpr std::size_t kLowest = kNoiseSegment / 40 + 1;
constexpr std::size_t kSurroundings = 12;
constexpr double kAround = 0.2;
constexpr double kStandsAbove = 4.0;
/// By how much more where few segments scatter: of five, 4 % of white noise has a bin of 4, and less than a thousandth one of 6.
constexpr double kFewSegments = 20.0;
/// A line ends where what stands above the floor is less than this part of the floor.
constexpr double kFoot = 0.5;
/// Width, in bins, of a sine behind the segments' Hann taper: its power over its height.
constexpr double kTaperWidth = 1.5;
/// Bins to either side that it has something in.
constexpr std::size_t kTaperReach = 2;
/// A line is no narrower than this, in bins.
constexpr double kLeastHalfWidth = 0.05;

/// A filter needs a white part, also where lines hold nearly all.
constexpr double kLeastWhiteOfAll = 1e-4;
/// Coherence of a shared line, at least: both axes have it, as it is (1 - 1 / r)(1 - 1 / s) where it makes their floors r and s times as high.
constexpr double kSharedLine = 0.25;

NoiseSpectrum floor_of(const NoiseSpectrum& power) noexcept {
  NoiseSpectrum floor = power;
  for (std::size_t k = kFirstNoiseBin; k < kNoiseBins; ++k) {
    const auto reach = static_cast<std::size_t>(kAround * static_cast<double>(k));
    floor[k] = median_around(power, k, std::max(kSurroundings, reach));
  }
  return floor;
}

/// Of a line whose own half width is this, in bins: its power over its height. A line of Cauchy's shape has pi half widths; behind a taper that by itself makes
/// t of a sine it has w with w - t^2 / w = pi half widths. Source: Halder, Wagner 1966, Acta Crystallographica 20 (breadths of Voigt profiles).
double width_behind_taper(double half_width) noexcept {
  const double own = 0.5 * std::numbers::pi * half_width;
  return own + std::sqrt(own * own + kTaperWidth * kTaperWidth);
}

double half_width_before_taper(double width) noexcept {
  return std::max((width - kTaperWidth * kTaperWidth / width) * std::numbers::inv_pi, kLeastHalfWidth);
}

/// Bins first..last around the peak of a line.
struct Extent {
  std::size_t first;
  std::size_t last;
};

Extent extent_of(const NoiseSpectrum& power, const NoiseSpectrum& floor, std::size_t peak) noexcept {
  const auto most = std::max(kTaperReach, static_cast<std::size_t>(kLineSpread * static_cast<double>(peak)));
  const auto stands = [&](std::size_t k) { return power[k] > (1.0 + kFoot) * floor[k]; };
  Extent extent{peak, peak};
  while (extent.first > kFirstNoiseBin && peak - extent.first < most && stands(extent.first - 1))
    --extent.first;
  while (extent.last + 1 < kNoiseBins && extent.last - peak < most && stands(extent.last + 1)) ++extent.last;
  return extent;
}

/// What stands above the floor.
SpectralLine line_of(const NoiseSpectrum& power, const NoiseSpectrum& floor, std::size_t peak,
                     Extent extent) noexcept {
  double sum = 0.0;
  double moment = 0.0;
  for (std::size_t k = extent.first; k <= extent.last; ++k) {
    // The last bin stands for one sign of frequency, the others for both.
    const double above = (k + 1 == kNoiseBins ? 0.5 : 1.0) * (power[k] - floor[k]);
    sum += above;
    moment += above * static_cast<double>(k);
  }
  constexpr auto kSegment = static_cast<double>(kNoiseSegment);
  return {.cycles = moment / sum / kSegment,
          .half_width = half_width_before_taper(sum / (power[peak] - floor[peak])) / kSegment,
          .variance = 2.0 * sum / kSegment};
}

/// The bin that stands highest above the floor, by stands_above at least, and is no skirt of another; 0 where there is none.
std::size_t highest(const NoiseSpectrum& power, const NoiseSpectrum& floor, double stands_above) noexcept {
  std::size_t peak = 0;
  double most = stands_above;
  for (std::size_t k = kLowest; k + 1 < kNoiseBins; ++k) {
    if (!(power[k] > most * floor[k]) || power[k] < power[k - 1] || power[k] < power[k + 1]) continue;
    most = power[k] / floor[k];
    peak = k;
  }
  return peak;
}

void insert(SpectrumParts& parts, const SpectralLine& line) noexcept {
  std::size_t place = parts.line_count++;
  for (; place > 0 && parts.line[place - 1].cycles > line.cycles; --place)
    parts.line[place] = parts.line[place - 1];
  parts.line[place] = line;
}

/// @param is_shared of an Extent
template <class IsShared>
SpectrumParts take_apart(const NoiseSpectrum& power, double segments, IsShared is_shared) noexcept {
  SpectrumParts parts{.rest = power};
  const NoiseSpectrum floor = floor_of(power);
  const double stands_above = std::max(kStandsAbove, 0.5 * kStandsAbove + kFewSegments / segments);
  while (parts.line_count < kMaxNoiseLines && parts.shared_count < kMaxSharedLines) {
    const std::size_t peak = highest(parts.rest, floor, stands_above);
    if (peak == 0) break;
    const Extent extent = extent_of(parts.rest, floor, peak);
    const SpectralLine line = line_of(parts.rest, floor, peak, extent);
    std::copy_n(floor.begin() + static_cast<std::ptrdiff_t>(extent.first), extent.last - extent.first + 1,
                parts.rest.begin() + static_cast<std::ptrdiff_t>(extent.first));
    if (is_shared(extent))
      parts.shared[parts.shared_count++] = line;
    else
      insert(parts, line);
  }
  return parts;
}

/// @param power what was taken apart
std::optional<NoiseModel> fit_parts(const SpectrumParts& parts, const NoiseSpectrum& power) noexcept {
  auto model = fit_noise(parts.rest);
  if (!model) return fit_noise(power);
  model->line_count = parts.line_count;
  model->line = parts.line;
  model->white_variance = std::max(model->white_variance, kLeastWhiteOfAll * noise_variance(*model));
  return is_usable(*model) ? model : std::nullopt;
}

}  // namespace

SpectrumParts take_lines(const NoiseSpectrum& power, double segments) noexcept {
  return take_apart(power, segments, [](const Extent&) { return false; });
}

SpectrumParts take_lines(const AxisSpectra& axes, std::size_t axis) noexcept {
  return take_apart(axes.power[axis], axes.segments[axis], [&](const Extent& extent) {
    return axes.shared_apart(axis, extent.first, extent.last) >= kSharedLine;
  });
}

std::optional<NoiseModel> fit_noise_and_lines(const NoiseSpectrum& power, double segments) noexcept {
  return fit_parts(take_lines(power, segments), power);
}

std::optional<NoiseModel> fit_noise_and_lines(const AxisSpectra& axes, std::size_t axis) noexcept {
  return fit_parts(take_lines(axes, axis), axes.power[axis]);
}

void add_lines(const NoiseModel& model, NoiseSpectrum& power) noexcept {
  constexpr auto kSegment = static_cast<double>(kNoiseSegment);
  for (const SpectralLine& line : model.lines()) {
    const double middle = line.cycles * kSegment;
    const double width = width_behind_taper(line.half_width * kSegment);
    const double height = 0.5 * kSegment * line.variance / width;
    for (std::size_t k = 0; k < kNoiseBins; ++k) {
      const double away = static_cast<double>(k) - middle;
      const double left = std::max(away - 0.5, -0.5 * width);
      const double right = std::min(away + 0.5, 0.5 * width);
      power[k] += height * std::max(right - left, 0.0);
    }
  }
}

}  // namespace gyrod::core
