#include "core/noise/still_noise.hpp"

#include <algorithm>
#include <vector>

#include "core/noise/noise_lines.hpp"
#include "core/signal/periodogram.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kStep = kNoiseSegment / 2;
/// Segments of 512 samples of one noise differ by 6 % (white) to 10 % (coloured) in their variances, one standard deviation.
constexpr double kShock = 1.5;

struct Segment {
  NoiseSpectrum power{};
  double variance = 0.0;
};

std::vector<Segment> segments_of(std::span<const std::span<const double>> stretches) {
  Periodogram periodogram(kNoiseSegment);
  std::vector<Segment> segments;
  for (const auto still : stretches) {
    for (std::size_t first = 0; first + kNoiseSegment <= still.size(); first += kStep) {
      Segment& segment = segments.emplace_back();
      segment.variance = periodogram.transform(still.subspan(first, kNoiseSegment), segment.power);
    }
  }
  return segments;
}

double median_variance(const std::vector<Segment>& segments) {
  std::vector<double> variances;
  variances.reserve(segments.size());
  for (const Segment& segment : segments) variances.push_back(segment.variance);
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::ranges::nth_element(variances, middle);
  return *middle;
}

}  // namespace

std::optional<NoiseModel> still_noise(std::span<const double> still) {
  return still_noise(std::span(&still, 1));
}

std::optional<NoiseModel> still_noise(std::span<const std::span<const double>> stretches) {
  std::size_t samples = 0;
  for (const auto still : stretches) samples += still.size();
  if (samples < kMinStillSamples) return std::nullopt;
  const std::vector<Segment> segments = segments_of(stretches);
  if (segments.empty()) return std::nullopt;
  const double median = median_variance(segments);
  if (!(median > 0.0)) return std::nullopt;
  NoiseSpectrum sum{};
  double taken = 0.0;
  for (const Segment& segment : segments) {
    if (segment.variance > kShock * median) continue;
    taken += 1.0;
    for (std::size_t k = 0; k < kNoiseBins; ++k) sum[k] += segment.power[k];
  }
  for (double& bin : sum) bin /= taken;
  return fit_noise_and_lines(sum, taken);
}

}  // namespace gyrod::core
