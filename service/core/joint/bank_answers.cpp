// What the bank makes of its members' answers.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "core/joint/kalman_bank.hpp"

namespace gyrod::core {
namespace {

/// Residuals whose square is more than this many times the noise's variance are compared with those beside them.
constexpr double kMuch = 4.0;
/// A sample that has more weight than this in its own estimate is hardly smoothed: what is wrong with it cannot be told from what lies beside it.
constexpr double kMostOwn = 0.25;

}  // namespace

/// Of x[t - lag], t the newest sample, without the slow correction; from kMaxLag samples after it at the most.
BankEstimate KalmanBank::combine(std::size_t lag) const noexcept {
  assert(lag <= kMaxLag || !limited());
  if (!fitted_ || !limited() || count_ <= kMaxLag) return combine_signal(lag);
  BankEstimate answer = mixture(lag, [&](std::size_t member) { return band_estimate(member, lag); });
  answer.rate += model_.mean * band_->share_of_members(lag) + band_->settled_part(lag);
  return answer;
}

/// The same at all frequencies, whatever the band.
BankEstimate KalmanBank::combine_signal(std::size_t lag) const noexcept {
  if (!fitted_) return start_.estimate(lag);
  return mixture(lag, [&](std::size_t member) { return signal_estimate(member, lag); });
}

/// @param answer of a member
template <class Answer>
BankEstimate KalmanBank::mixture(std::size_t lag, const Answer& answer) const noexcept {
  std::array<double, kMembers> estimates{};
  BankEstimate mixture;
  // Differences to it are weighed: where all agree, that is the answer to the last bit.
  std::optional<double> first;
  for (std::size_t i = 0; i < kMembers; ++i) {
    if (weight_at(i, lag) == 0.0) continue;
    estimates[i] = answer(i);
    if (!first) first = estimates[i];
    mixture.rate += weight_at(i, lag) * (estimates[i] - *first);
  }
  mixture.rate += first.value_or(0.0);
  for (std::size_t i = 0; i < kMembers; ++i) {
    if (weight_at(i, lag) == 0.0) continue;
    const double apart = estimates[i] - mixture.rate;
    mixture.variance +=
        weight_at(i, lag) * (error_variance_[i][std::min(lag, kMaxLag)] * unit_ + apart * apart);
  }
  mixture.variance = std::min(mixture.variance, std::numeric_limits<double>::max());
  return mixture;
}

double KalmanBank::signal_estimate(std::size_t index, std::size_t lag) const noexcept {
  const Member& member = members_[index];
  const auto& g = model_.members[index].smoothing;
  const std::uint64_t then = count_ - 1 - lag;
  double estimate = model_.mean + member.prediction[then % kRing];
  for (std::size_t k = 0; k <= std::min(lag, kMaxLag); ++k)
    estimate += g[k] * member.innovation[(then + k) % kRing];
  return estimate;
}

/// Hands on what is known by now of the sample kMaxLag ago, which will not be known better.
void KalmanBank::feed_band() noexcept {
  if (band_ && count_ > kMaxLag) band_->feed(combine_signal(kMaxLag).rate);
}

/// A member's part of the low-passed signal, without the mean.
double KalmanBank::band_estimate(std::size_t index, std::size_t lag) const noexcept {
  const BandAnswers::Row* const known = band_->known_row(index, lag);
  return known != nullptr ? band_part(index, lag, *known)
                          : band_part(index, lag, band_->make_row(model_.members[index], lag));
}

double KalmanBank::band_part(std::size_t index, std::size_t lag, const BandAnswers::Row& row) const noexcept {
  const Member& member = members_[index];
  double sum = 0.0;
  for (std::size_t age = 0; age <= kMaxLag; ++age) {
    const std::uint64_t then = count_ - 1 - age;
    const double tap = band_->band().tap(static_cast<std::ptrdiff_t>(lag) - static_cast<std::ptrdiff_t>(age));
    sum += tap * member.prediction[then % kRing] + row.innovations[age] * member.innovation[then % kRing];
  }
  for (std::size_t i = 0; i < model_.members[index].states; ++i) sum += row.states[i] * member.x[i];
  return sum;
}

BankEstimate KalmanBank::held(std::size_t age) const noexcept {
  assert(age <= lag_ && age < count_);
  BankEstimate estimate = combine(age);
  const Correction& correction = lag_ > 0 ? denoised_correction_ : realtime_correction_;
  estimate.rate += correction.step;
  ResidualCheck check = correction.residual;
  const double sample = sample_at(count_ - 1 - age);
  estimate = check.apply(sample, estimate, model_.residual_variance * unit_,
                         beside(age, sample - estimate.rate, correction.step), options_);
  estimate.rate += correction.slow.paid() + (lag_ > 0 ? correction.gain.paid() : resized_);
  estimate.variance = widened(estimate.variance);
  return estimate;
}

void KalmanBank::correct(double sample, std::size_t lag, Correction& correction,
                         BankEstimate& answer) noexcept {
  correction.step *= options_.hand_over_memory;
  answer.rate += correction.step;
  const double noise = unwanted();
  const Trust trust = noise > 0.0 ? Trust{.now = answer.variance / noise,
                                          .expected = expected_variance(lag) / noise,
                                          .settled = expected_variance(kMaxLag) / noise,
                                          .motion = slow_motion_}
                                  : Trust{};
  answer = correction.residual.apply(sample, answer, model_.residual_variance * unit_,
                                     beside(lag, sample - answer.rate, correction.step), options_);
  std::array<double, kMaxLag> newer{};
  for (std::size_t k = 0; k < lag; ++k) newer[k] = residuals_[(count_ - lag + k) % kRing];
  if (lag == 0) residuals_[(count_ - 1) % kRing] = sample - answer.rate;
  answer.rate =
      correction.slow.apply(sample, answer.rate, trust, options_, model_.scale, std::span(newer).first(lag));
  if (lag > 0) answer.rate = correction.gain.apply(sample, answer.rate, noise, options_, model_.scale);
  answer.variance = widened(answer.variance);
}

/// Variance of what the samples have besides what is asked for.
double KalmanBank::unwanted() const noexcept {
  return (model_.noise_variance + model_.beyond_band_variance) * unit_;
}

/// The newest answer at once.
void KalmanBank::resize_at_once(BankEstimate& answer) noexcept {
  at_once_[(count_ - 1) % kRing] = answer.rate;
  answer.rate = later_gain_.apply(answer.rate, unwanted(), options_, model_.scale);
  resized_ = answer.rate - at_once_[(count_ - 1) % kRing];
}

/// What was answered at once, with what is answered now of the same sample. @return false where an answer has left the finite numbers
bool KalmanBank::compare_later(double denoised) noexcept {
  if (!std::isfinite(denoised)) return false;
  if (count_ <= later_lag_) return true;
  const std::uint64_t then = count_ - 1 - later_lag_;
  BankEstimate later{.rate = denoised};
  if (later_lag_ != lag_) {
    later = combine(later_lag_);
    correct(sample_at(then), later_lag_, later_correction_, later);
  }
  later_gain_.compare(later.rate, at_once_[then % kRing], options_, model_.scale);
  return std::isfinite(later.rate);
}

/// Largest square of what estimates take off the two samples before and after x[t - lag], if that is much. A sample that is wrong by d pulls
/// estimates beside it by h d / (1 - h) at the most, h the weight that it has in its own: of what is off to the other side that is left out.
double KalmanBank::beside(std::size_t lag, double residual, double step) const noexcept {
  constexpr std::size_t kReach = 2;
  const double variance = model_.residual_variance * unit_;
  if (!fitted_ || lag == 0 || !(residual * residual > kMuch * variance))
    return std::numeric_limits<double>::infinity();
  const double own = expected_variance(lag) / variance;
  if (!(own < kMostOwn)) return std::numeric_limits<double>::infinity();
  const double pull = own / (1.0 - own) * std::abs(residual);
  double largest = 0.0;
  const std::size_t newest = lag - std::min(lag, kReach);
  const std::size_t oldest = std::min(lag + kReach, static_cast<std::size_t>(count_ - 1));
  for (std::size_t other = newest; other <= oldest; ++other) {
    if (other == lag) continue;
    const double off = sample_at(count_ - 1 - other) - combine(other).rate - step;
    const bool same_side = (off > 0.0) == (residual > 0.0);
    largest = std::max(largest, same_side ? std::abs(off) : std::abs(off) - pull);
  }
  return largest * largest;
}

/// P_L of the members, as far as they agree.
double KalmanBank::expected_variance(std::size_t lag) const noexcept {
  if (!fitted_) return start_.expected_variance(std::min<std::size_t>(lag, count_ - 1));
  double sum = 0.0;
  for (std::size_t i = 0; i < kMembers; ++i) {
    if (members_[i].weight > 0.0) sum += members_[i].weight * error_variance_[i][lag];
  }
  return sum * unit_;
}

double KalmanBank::widened(double variance) const noexcept {
  return std::min(variance * options_.variance_factor, std::numeric_limits<double>::max());
}

}  // namespace gyrod::core
