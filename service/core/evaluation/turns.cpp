#include "core/evaluation/turns.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gyrod::core {
namespace {

constexpr double kBefore_s = 1.0;
constexpr double kAfter_s = 3.0;

std::size_t samples_in(double seconds, const TurnOptions& options) noexcept {
  return static_cast<std::size_t>(std::llround(seconds * options.rate_hz));
}

/// Time, in samples, at which x first reaches a level from below, by the straight line between two samples.
std::optional<double> crossing(std::span<const double> x, std::size_t from, double level) noexcept {
  for (std::size_t t = from + 1; t < x.size(); ++t) {
    if (!(x[t] >= level) || !std::isfinite(x[t - 1])) continue;
    if (x[t - 1] >= level) return static_cast<double>(t - 1);
    return static_cast<double>(t - 1) + (level - x[t - 1]) / (x[t] - x[t - 1]);
  }
  return std::nullopt;
}

/// The stretch of the noise for one of the repeats, from its start, wrapped round at its end.
std::vector<double> noisy_turn(std::span<const double> truth, std::span<const double> noise,
                               std::size_t repeat, std::size_t repeats) {
  std::vector<double> noisy(truth.begin(), truth.end());
  if (noise.empty()) return noisy;
  const std::size_t start = repeat * noise.size() / repeats;
  for (std::size_t t = 0; t < noisy.size(); ++t) noisy[t] += noise[(start + t) % noise.size()];
  return noisy;
}

double peak_error(std::span<const double> estimate, std::span<const double> truth,
                  SampleRange range) noexcept {
  double peak = 0.0;
  for (std::size_t t = range.begin; t < std::min(range.end, truth.size()); ++t) {
    const double error = std::abs(estimate[t] - truth[t]);
    if (error > peak) peak = error;
  }
  return peak;
}

void measure(std::span<const double> mean, std::span<const double> truth, const TurnProfile& profile,
             const TurnOptions& options, TurnResponse& response) {
  const std::size_t start = samples_in(options.straight_s, options);
  const std::size_t look = start - std::min(start, samples_in(kBefore_s, options));
  const auto half = crossing(mean, look, 0.5 * profile.rate_dps);
  const auto true_half = crossing(truth, look, 0.5 * profile.rate_dps);
  if (half && true_half) response.half_delay_s = (*half - *true_half) / options.rate_hz;
  const auto most = crossing(mean, look, 0.95 * profile.rate_dps);
  if (most) response.time_95_s = (*most - static_cast<double>(start)) / options.rate_hz;
  for (std::size_t t = start; t < mean.size(); ++t) {
    if (mean[t] / profile.rate_dps - 1.0 > response.overshoot)
      response.overshoot = mean[t] / profile.rate_dps - 1.0;
  }
  const std::size_t end = std::min(mean.size(), start + samples_in(kAfter_s, options));
  response.trace_start_s = -static_cast<double>(start - look) / options.rate_hz;
  for (std::size_t t = look; t < end; ++t) {
    response.trace_dps.push_back(mean[t]);
    response.trace_truth_dps.push_back(truth[t]);
  }
}

}  // namespace

std::vector<double> turn_truth(const TurnProfile& profile, const TurnOptions& options) {
  const std::size_t start = samples_in(options.straight_s, options);
  std::vector<double> truth(start + samples_in(profile.rise_s + options.hold_s, options), 0.0);
  for (std::size_t t = start; t < truth.size(); ++t) {
    const double since_s = static_cast<double>(t - start) / options.rate_hz;
    truth[t] =
        profile.rise_s > 0.0 ? profile.rate_dps * std::min(1.0, since_s / profile.rise_s) : profile.rate_dps;
  }
  return truth;
}

TurnResponse turn_response(const Method& method, const TurnProfile& profile,
                           std::span<const double> noise_dps, const TurnOptions& options) {
  assert(options.repeats >= 1);
  const std::vector<double> truth = turn_truth(profile, options);
  const std::size_t start = samples_in(options.straight_s, options);
  const SampleRange judged{start - std::min(start, samples_in(0.5, options)),
                           start + samples_in(profile.rise_s + 2.0, options)};
  const auto repeats = static_cast<double>(options.repeats);
  std::vector<double> mean(truth.size(), 0.0);
  TurnResponse response;
  for (std::size_t repeat = 0; repeat < options.repeats; ++repeat) {
    const Contender run = method.run(noisy_turn(truth, noise_dps, repeat, options.repeats));
    for (std::size_t t = 0; t < mean.size(); ++t) mean[t] += run.estimate[t] / repeats;
    response.peak_error_dps += peak_error(run.estimate, truth, judged) / repeats;
  }
  measure(mean, truth, profile, options, response);
  return response;
}

}  // namespace gyrod::core
