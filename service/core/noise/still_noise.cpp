#include "core/noise/still_noise.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "core/signal/periodogram.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kStep = kNoiseSegment / 2;
/// Segments of 512 samples of one noise differ by 6 % (white) to 10 % (coloured) in their variances, one standard deviation.
constexpr double kShock = 1.5;

std::size_t size_of(const AxisSamples& samples) {
  return std::max({samples[0].size(), samples[1].size(), samples[2].size()});
}

std::vector<AxisSamples> segments_of(std::span<const AxisSamples> stretches) {
  std::vector<AxisSamples> segments;
  for (const AxisSamples& stretch : stretches) {
    for (std::size_t first = 0; first + kNoiseSegment <= size_of(stretch); first += kStep) {
      AxisSamples& segment = segments.emplace_back();
      for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
        if (!stretch[axis].empty()) segment[axis] = stretch[axis].subspan(first, kNoiseSegment);
      }
    }
  }
  return segments;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Segments of an axis that are no shocks; none where it does not change.
std::vector<bool> calm_segments(const std::vector<AxisSamples>& segments, std::size_t axis,
                                Periodogram& periodogram) {
  std::vector<bool> calm(segments.size(), false);
  if (segments.empty() || segments.front()[axis].empty()) return calm;
  std::vector<double> variances;
  NoiseSpectrum power;
  for (const AxisSamples& segment : segments)
    variances.push_back(periodogram.transform(segment[axis], power));
  const double usual = median(variances);
  for (std::size_t s = 0; s < segments.size(); ++s) calm[s] = usual > 0.0 && variances[s] <= kShock * usual;
  return calm;
}

AxisSpectra calm_spectra(const std::vector<AxisSamples>& segments) {
  Periodogram periodogram(kNoiseSegment);
  std::array<std::vector<bool>, kSensorAxes> calm;
  for (std::size_t a = 0; a < kSensorAxes; ++a) calm[a] = calm_segments(segments, a, periodogram);
  AxisSpectra spectra;
  AxisTransforms transforms{};
  NoiseSpectrum power;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    std::array<bool, kSensorAxes> taken{};
    for (std::size_t a = 0; a < kSensorAxes; ++a) {
      taken[a] = calm[a][s];
      if (!taken[a]) continue;
      periodogram.transform(segments[s][a], power);
      std::ranges::copy(periodogram.spectrum(), transforms[a].begin());
    }
    AxisSums sums;
    sums.add(transforms);
    spectra.blend(sums, taken, std::numeric_limits<double>::infinity());
  }
  return spectra;
}

}  // namespace

std::optional<NoiseModel> still_noise(std::span<const double> still) {
  return still_noise(std::span(&still, 1));
}

std::optional<NoiseModel> still_noise(std::span<const std::span<const double>> stretches) {
  std::vector<AxisSamples> alone;
  for (const auto still : stretches) alone.push_back({still, {}, {}});
  return still_noise(alone)[0].model;
}

std::array<StillAxis, kSensorAxes> still_noise(std::span<const AxisSamples> stretches) {
  std::array<StillAxis, kSensorAxes> result;
  std::size_t samples = 0;
  for (const AxisSamples& stretch : stretches) samples += size_of(stretch);
  if (samples < kMinStillSamples) return result;
  const AxisSpectra spectra = calm_spectra(segments_of(stretches));
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    if (spectra.segments[axis] == 0.0) continue;
    const SpectrumParts parts = take_lines(spectra, axis);
    result[axis].model = fit_noise_and_lines(spectra, axis);
    result[axis].shared_count = parts.shared_count;
    result[axis].shared = parts.shared;
  }
  return result;
}

}  // namespace gyrod::core
