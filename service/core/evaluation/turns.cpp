#include "core/evaluation/turns.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/evaluation/statistics.hpp"

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

double peak_error(std::span<const double> estimate, std::span<const double> truth,
                  SampleRange range) noexcept {
  double peak = 0.0;
  for (std::size_t t = range.begin; t < std::min(range.end, truth.size()); ++t) {
    const double error = std::abs(estimate[t] - truth[t]);
    if (error > peak) peak = error;
  }
  return peak;
}

/// What the turn changes in each of the runs, and in their mean.
struct Responses {
  std::vector<std::vector<double>> runs;
  std::vector<double> mean;
};

/// Standard error of the mean's time, in samples, at which it crosses a level: that of its height there, over its slope.
std::optional<double> crossing_error(const Responses& responses, double crossing) {
  const auto t = static_cast<std::size_t>(std::ceil(crossing));
  if (t < 1) return std::nullopt;
  std::vector<double> heights;
  for (const auto& run : responses.runs) heights.push_back(run[t]);
  const auto height = batch_mean(heights, 1);
  if (!height) return std::nullopt;
  const double slope = responses.mean[t] - responses.mean[t - 1];
  if (!(slope > 0.0)) return std::nullopt;
  return height->standard_error / slope;
}

void measure(const Responses& responses, std::span<const double> truth, const TurnProfile& profile,
             const TurnOptions& options, TurnResponse& response) {
  const std::span<const double> mean = responses.mean;
  const std::size_t start = samples_in(options.straight_s, options);
  const std::size_t look = start - std::min(start, samples_in(kBefore_s, options));
  const auto half = crossing(mean, look, 0.5 * profile.rate_dps);
  const auto true_half = crossing(truth, look, 0.5 * profile.rate_dps);
  if (half && true_half) {
    response.half_delay_s = (*half - *true_half) / options.rate_hz;
    const auto error = crossing_error(responses, *half);
    if (error) response.half_delay_error_s = *error / options.rate_hz;
  }
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
  std::vector<double> truth(start + samples_in(options.after_s, options), 0.0);
  for (std::size_t t = start; t < truth.size(); ++t) {
    const double since_s = static_cast<double>(t - start) / options.rate_hz;
    truth[t] =
        profile.rise_s > 0.0 ? profile.rate_dps * std::min(1.0, since_s / profile.rise_s) : profile.rate_dps;
  }
  return truth;
}

TurnTrials::TurnTrials(Method method, std::span<const double> noise_dps, const TurnOptions& options)
    : method_(std::move(method)), noise_dps_(noise_dps.begin(), noise_dps.end()), options_(options) {
  assert(options.repeats >= 1);
  for (std::size_t repeat = 0; repeat < options.repeats; ++repeat) {
    straights_.push_back(method_.run(noise(repeat)).estimate);
  }
}

/// The stretch of the noise for one of the repeats, from its start, wrapped round at its end.
std::vector<double> TurnTrials::noise(std::size_t repeat) const {
  std::vector<double> stretch(samples_in(options_.straight_s, options_) +
                              samples_in(options_.after_s, options_));
  const std::size_t start = repeat * noise_dps_.size() / options_.repeats;
  for (std::size_t t = 0; t < stretch.size() && !noise_dps_.empty(); ++t) {
    stretch[t] = noise_dps_[(start + t) % noise_dps_.size()];
  }
  return stretch;
}

TurnResponse TurnTrials::take(const TurnProfile& profile) const {
  const std::vector<double> truth = turn_truth(profile, options_);
  const std::size_t start = samples_in(options_.straight_s, options_);
  const SampleRange judged{start - std::min(start, samples_in(0.5, options_)),
                           start + samples_in(profile.rise_s + 2.0, options_)};
  const auto repeats = static_cast<double>(options_.repeats);
  Responses responses{{}, std::vector<double>(truth.size(), 0.0)};
  TurnResponse response;
  for (std::size_t repeat = 0; repeat < options_.repeats; ++repeat) {
    std::vector<double> noisy = noise(repeat);
    for (std::size_t t = 0; t < noisy.size(); ++t) noisy[t] += truth[t];
    std::vector<double> change = method_.run(noisy).estimate;
    response.peak_error_dps += peak_error(change, truth, judged) / repeats;
    for (std::size_t t = 0; t < change.size(); ++t) {
      change[t] -= straights_[repeat][t];
      responses.mean[t] += change[t] / repeats;
    }
    responses.runs.push_back(std::move(change));
  }
  measure(responses, truth, profile, options_, response);
  return response;
}

}  // namespace gyrod::core
