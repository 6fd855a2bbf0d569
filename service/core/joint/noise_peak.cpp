#include "core/joint/noise_peak.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace gyrod::core {
namespace {

constexpr double kStandsOut = 2.5;
/// In parts of the bins.
constexpr std::size_t kSlowShare = 20;
/// What is this close to the peak is not what it stands out of, in parts of its frequency.
constexpr double kNear = 0.25;
/// Where the line is over. Chosen by joint_study: at 0.25 and 0.35 noise of z axes on x and y is 0.7 % worse and better, and on z better and worse.
constexpr double kFoot = 0.3;
/// Of a line's power, what modes at its place may be of it.
constexpr double kMostRest = 0.25;

/// [first, end) bins around a peak.
struct Band {
  std::size_t first;
  std::size_t end;
};

Band around(std::size_t peak, double reach) noexcept {
  const auto bins = static_cast<std::size_t>(std::lround(reach * static_cast<double>(peak)));
  return {peak - bins, std::min(peak + bins + 1, kNoiseBins)};
}

NoiseSpectrum spectrum_of(const NoiseModel& noise) noexcept {
  NoiseSpectrum spectrum{};
  for (std::size_t k = 0; k < kNoiseBins; ++k) {
    spectrum[k] = noise_spectrum(noise, 2.0 * std::numbers::pi * static_cast<double>(k) / kNoiseSegment);
  }
  return spectrum;
}

/// The peak's bin, or 0.
std::size_t peak_of(const NoiseSpectrum& spectrum) noexcept {
  const auto first = spectrum.begin() + kNoiseBins / kSlowShare;
  const auto highest = std::max_element(first, spectrum.end());
  const auto peak = static_cast<std::size_t>(highest - spectrum.begin());
  const Band near = around(peak, kNear);
  double elsewhere = 0.0;
  double count = 0.0;
  for (std::size_t k = kNoiseBins / kSlowShare; k < kNoiseBins; ++k) {
    if (k >= near.first && k < near.end) continue;
    elsewhere += spectrum[k];
    ++count;
  }
  return count > 0.0 && *highest * count > kStandsOut * elsewhere ? peak : 0;
}

/// Takes the line out of the spectrum.
NoiseSpectrum take_line(NoiseSpectrum& spectrum, std::size_t peak) noexcept {
  NoiseSpectrum line{};
  const auto [first, end] = around(peak, kFoot);
  const double left = spectrum[first];
  const double right = spectrum[end - 1];
  for (std::size_t k = first; k < end; ++k) {
    const double along = static_cast<double>(k - first) / static_cast<double>(end - 1 - first);
    const double rest = std::min(spectrum[k], std::lerp(left, right, along));
    line[k] = spectrum[k] - rest;
    spectrum[k] = rest;
  }
  return line;
}

double mean_of(const NoiseSpectrum& spectrum) noexcept {
  double sum = 0.0;
  for (std::size_t k = 1; k + 1 < kNoiseBins; ++k) sum += 2.0 * spectrum[k];
  return (spectrum.front() + sum + spectrum.back()) / static_cast<double>(kNoiseSegment);
}

}  // namespace

std::optional<NoisePeak> find_noise_peak(const NoiseModel& noise) noexcept {
  if (!is_usable(noise) || noise.colour_order == 0) return std::nullopt;
  NoiseSpectrum spectrum = spectrum_of(noise);
  const std::size_t peak = peak_of(spectrum);
  if (peak == 0) return std::nullopt;
  NoisePeak result{.cycles = static_cast<double>(peak) / static_cast<double>(kNoiseSegment)};
  result.line = take_line(spectrum, peak);
  result.power = mean_of(result.line);
  const auto rest = fit_noise(spectrum, noise.white_variance);
  if (!rest || !(result.power > 0.0)) return std::nullopt;
  result.rest = *rest;
  return result;
}

void share_with_line(double line_power, std::span<ModeNearLine> modes) noexcept {
  // Innovation over variance, the spectral flatness: 0 for a line, 1 for white noise.
  std::ranges::sort(modes, {}, [](const ModeNearLine& near) { return near.mode->drive / near.power; });
  double left = kMostRest * line_power;
  for (const auto& [mode, power] : modes) {
    const double line = power > left ? left * std::max(2.0 - power / left, 0.0) : power;
    mode->share = 1.0 - line / power;
    left -= line;
  }
}

}  // namespace gyrod::core
