#include "core/joint/start_levels.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

/// Uncertainty before the first sample, in parts of var v: as good as none is known, and far from what rounding loses.
constexpr double kUnknown = 1e9;
/// Part of the weights that is shared out anew with every sample.
constexpr double kShared = 0.005;
/// Of the likelihoods, as the bank's members have it: motion is not quite what any of the levels says.
constexpr double kPower = 0.5;
/// Most that one sample says against a level, in squared deviations: e^-300 is a number.
constexpr double kMostAgainst = 600.0;

/// Variance of white noise's differences of order 1 to 4, in parts of its own: (2 n)! / (n!)^2.
constexpr std::array<double, 4> kOfDifferences = {2.0, 6.0, 20.0, 70.0};

}  // namespace

void StartLevels::reset() noexcept {
  levels_ = {};
  count_ = 0;
  variance_ = known_variance_;
  differences_ = {};
  guesses_ = 0.0;
  guess_ = 0.0;
  most_ = std::numeric_limits<double>::infinity();
}

void StartLevels::step(double sample) noexcept {
  if (known_variance_ > 0.0) {
    variance_ = known_variance_;
  } else {
    guess_variance(sample);
    variance_ = std::min(guess_, most_);
  }
  const std::size_t now = count_ % kHeld;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    Level& level = levels_[i];
    if (count_ == 0) level = {.x = sample, .variance = kUnknown, .weight = kEven};
    const double X = level.variance + (count_ == 0 ? 0.0 : kRatios[i]);
    level.prediction[now] = level.x;
    level.innovation[now] = sample - level.x;
    level.uncertainty[now] = X;
    level.variance = X / (X + 1.0);
    level.x += level.variance * level.innovation[now];
  }
  ++count_;
  weigh();
}

/// Differences of the highest order that there are samples for, the fourth at most.
void StartLevels::guess_variance(double sample) noexcept {
  const std::size_t order = std::min<std::uint64_t>(count_, differences_.size());
  double difference = sample;
  for (std::size_t k = 0; k < order; ++k) {
    const double next = difference - differences_[k];
    differences_[k] = difference;
    difference = next;
  }
  if (order < differences_.size()) {
    differences_[order] = difference;
    guesses_ = 0.0;
  }
  const double guess = order == 0 ? 0.0 : difference * difference / kOfDifferences[order - 1];
  if (!std::isfinite(guess)) return;
  guesses_ += 1.0;
  guess_ += (guess - guess_) / guesses_;
}

/// Bayes' rule after some of the weight has been shared out.
void StartLevels::weigh() noexcept {
  const std::size_t now = (count_ - 1) % kHeld;
  std::array<double, kRatios.size()> against{};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const double S = levels_[i].uncertainty[now] + 1.0;
    const double nu = levels_[i].innovation[now];
    const double surprise = variance_ > 0.0 ? nu * nu / (S * variance_) : 0.0;
    against[i] = (std::isfinite(surprise) ? surprise : std::numeric_limits<double>::max()) + portable_log(S);
    least = std::min(least, against[i]);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    Level& level = levels_[i];
    const double before = std::lerp(level.weight, kEven, kShared);
    level.weight = before * portable_exp(-0.5 * kPower * std::min(against[i] - least, kMostAgainst));
    sum += level.weight;
  }
  for (Level& level : levels_) level.weight /= sum;
}

/// With C = X[j] (1 - K[j]) ... (1 - K[i-1]), the covariance of x[j] with the prediction of z[i], each innovation adds C / S[i] of itself, and takes
/// C^2 / S[i] from the variance.
StartLevels::Smoothed StartLevels::smoothed(const Level& level, std::size_t lag) const noexcept {
  const std::uint64_t then = count_ - 1 - lag;
  Smoothed estimate{level.prediction[then % kHeld], level.uncertainty[then % kHeld]};
  double covariance = level.uncertainty[then % kHeld];
  for (std::uint64_t time = then; time < count_; ++time) {
    const double S = level.uncertainty[time % kHeld] + 1.0;
    estimate.rate += covariance / S * level.innovation[time % kHeld];
    estimate.variance -= covariance / S * covariance;
    covariance /= S;
  }
  return estimate;
}

BankEstimate StartLevels::estimate(std::size_t lag) const noexcept {
  assert(lag <= kMaxLag && lag < count_);
  std::array<Smoothed, kRatios.size()> all{};
  BankEstimate mixture;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    all[i] = smoothed(levels_[i], lag);
    mixture.rate += levels_[i].weight * (all[i].rate - all[0].rate);
  }
  mixture.rate += all[0].rate;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const double apart = all[i].rate - mixture.rate;
    mixture.variance += levels_[i].weight * (all[i].variance * variance_ + apart * apart);
  }
  mixture.variance = std::min(mixture.variance, std::numeric_limits<double>::max());
  return mixture;
}

double StartLevels::expected_variance(std::size_t lag) const noexcept {
  double sum = 0.0;
  for (const Level& level : levels_) sum += level.weight * smoothed(level, lag).variance;
  return sum * variance_;
}

}  // namespace gyrod::core
