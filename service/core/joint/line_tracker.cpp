#include "core/joint/line_tracker.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/signal/levinson.hpp"
#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

/// In parts of its frequency; beyond that the places are not where the line is.
constexpr double kSameLine = 0.05;
/// How far a line is from where it is believed to be, in parts of its frequency: one standard deviation. That of imu1 z is off by 0.13 in the first hour
/// after power-up, and by 0.03 later.
constexpr double kWander = 0.07;
/// Of the first probabilities, what is the same everywhere.
constexpr double kAnywhere = 0.05;
/// A bin that holds more than so many times what stands there tells no more than that: it holds motion that the fit does not know, and no line of this
/// power explains it. Of noise alone one bin in 300 does (two tapers).
constexpr double kMostTold = 4.0;

/// Spectrum of a line of variance 1 at a distance from its middle, both in cycles per sample: a Cauchy density over half a cycle.
double line_density(double distance, double half_width) noexcept {
  return 0.5 * std::numbers::inv_pi * half_width / (distance * distance + half_width * half_width);
}

}  // namespace

bool NoiseLine::reaches(double centre_cycles, const LineOptions& options) const noexcept {
  return std::abs(centre_cycles - cycles) <
         std::min(options.reach * half_width, LineTracker::kReach * cycles);
}

void LineTracker::believe(const SpectralLine& line) noexcept {
  power_ = line.variance;
  half_width_ = line.half_width;
  if (power_ > 0.0 && !knows(line)) look_anew(line.cycles);
}

bool LineTracker::knows(const SpectralLine& line) const noexcept {
  return anchor_ > 0.0 && std::abs(line.cycles - anchor_) <= kSameLine * anchor_;
}

double LineTracker::cycles_at(std::size_t place) const noexcept {
  const double along = 2.0 * static_cast<double>(place) / static_cast<double>(kPlaces - 1) - 1.0;
  return anchor_ * (1.0 + kReach * along);
}

void LineTracker::look_anew(double cycles) noexcept {
  anchor_ = cycles;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const double away = (cycles_at(i) / cycles - 1.0) / kWander;
    prior_[i] = exists(i) ? portable_exp(-0.5 * away * away) : 0.0;
  }
  const double sum = std::accumulate(prior_.begin(), prior_.end(), 0.0);
  double places = 0.0;
  for (std::size_t i = 0; i < kPlaces; ++i) places += exists(i) ? 1.0 : 0.0;
  for (std::size_t i = 0; i < kPlaces; ++i)
    prior_[i] = exists(i) ? std::lerp(prior_[i] / sum, 1.0 / places, kAnywhere) : 0.0;
  weight_ = prior_;
}

/// The line's own.
double LineTracker::half_width(double cycles, const LineOptions& options) const noexcept {
  return std::min(std::max(half_width_, options.least_half_width * cycles), options.half_width * cycles);
}

LinePlace LineTracker::place() const noexcept {
  double mean = 0.0;
  for (std::size_t i = 0; i < kPlaces; ++i) mean += weight_[i] * cycles_at(i);
  double variance = 0.0;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const double apart = cycles_at(i) - mean;
    variance += weight_[i] * apart * apart;
  }
  return {mean, std::sqrt(variance)};
}

NoiseLine LineTracker::line(const LineOptions& options) const noexcept {
  if (power_ == 0.0) return {};
  const auto [cycles, deviation] = place();
  NoiseLine line{.cycles = cycles, .half_width = half_width(cycles, options) + deviation, .power = power_};
  const double r = portable_exp(-2.0 * std::numbers::pi * line.half_width);
  const std::array<double, 2> a = {2.0 * r * portable_sine_cosine(cycles).cosine, -r * r};
  std::ranges::copy(a, line.mode.a.begin());
  line.mode.drive = power_ / ar_variance_gain(a);
  return line;
}

void LineTracker::observe(const LineEvidence& window, const LineOptions& options) noexcept {
  assert(power_ > 0.0 && window.rest.size() == window.periodogram.size() &&
         window.explained.size() == window.periodogram.size());
  spread(window.share, options);
  const Places likelihood = log_likelihoods(window, options);
  const double most = std::ranges::max(likelihood);
  double sum = 0.0;
  for (std::size_t i = 0; i < kPlaces; ++i) {
    weight_[i] *= portable_exp(window.share * (likelihood[i] - most));
    sum += weight_[i];
  }
  if (!(sum > 0.0) || !std::isfinite(sum)) {
    weight_ = prior_;
    return;
  }
  for (double& weight : weight_) weight /= sum;
}

/// A walk among the places, and a way back to where they began.
void LineTracker::spread(double share, const LineOptions& options) noexcept {
  constexpr double kStep = 2.0 * kReach / static_cast<double>(kPlaces - 1);
  constexpr double kMostSpread = 0.25;  // a third would empty a place
  const double part = std::min(0.5 * options.drift * options.drift * share / (kStep * kStep), kMostSpread);
  Places next{};
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const double below = weight_[i > 0 ? i - 1 : i];
    const double above = weight_[i + 1 < kPlaces ? i + 1 : i];
    if (!exists(i)) continue;
    const double walked = weight_[i] + part * (below - 2.0 * weight_[i] + above);
    next[i] = std::lerp(walked, prior_[i], std::min(options.leak * share, 1.0));
  }
  weight_ = next;
}

LineTracker::Places LineTracker::log_likelihoods(const LineEvidence& window,
                                                 const LineOptions& options) const noexcept {
  const auto last = static_cast<double>(window.periodogram.size() - 1);
  const auto bin_of = [last](double cycles) {
    return static_cast<std::size_t>(std::lround(std::clamp(2.0 * cycles * last, 0.0, last)));
  };
  const std::size_t first = bin_of(cycles_at(0));
  const std::size_t end = bin_of(cycles_at(kPlaces - 1)) + 1;
  const double width = half_width(anchor_, options) + options.resolution * window.resolution;
  Places likelihood{};
  for (std::size_t i = 0; i < kPlaces; ++i) {
    const double middle = cycles_at(i);
    LogarithmOfProduct models;
    for (std::size_t k = first; k < end; ++k) {
      const double distance = 0.5 * static_cast<double>(k) / last - middle;
      const double line = window.power * line_density(distance, width);
      const double model = window.rest[k] + std::max(window.explained[k], line);
      models.multiply(model);
      likelihood[i] -= std::min(window.periodogram[k] / model, kMostTold);
    }
    likelihood[i] -= models.value();
  }
  return likelihood;
}

void believe(std::span<const SpectralLine> lines, LineTrackers& trackers) noexcept {
  assert(lines.size() <= trackers.size());
  const LineTrackers before = trackers;
  std::array<bool, kMaxNoiseLines> taken{};
  std::array<bool, kMaxNoiseLines> told{};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = 0; j < before.size() && !told[i]; ++j) {
      if (taken[j] || !before[j].knows(lines[i])) continue;
      trackers[i] = before[j];
      taken[j] = told[i] = true;
    }
  }
  std::size_t left = 0;
  for (std::size_t i = 0; i < trackers.size(); ++i) {
    if (told[i]) continue;
    while (taken[left]) ++left;
    trackers[i] = before[left++];
  }
  for (std::size_t i = 0; i < lines.size(); ++i) trackers[i].believe(lines[i]);
}

}  // namespace gyrod::core
