#include "core/joint/kalman_bank.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/joint/companion_blocks.hpp"
#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

/// Whether one of the members can answer.
bool has_member(const BankModel& model) noexcept {
  return std::ranges::any_of(model.members, &MemberModel::usable);
}

}  // namespace

KalmanBank::KalmanBank(const JointOptions& options, std::size_t lag, SignalBandLimit band)
    : options_(options),
      lag_(lag),
      later_lag_(std::max(lag, kLeastLater)),
      hindsight_roots_(roots_at(lag)),
      history_(std::max(options.hand_over_samples, kRing)),
      band_(band == SignalBandLimit::kPossible
                ? std::make_unique<BandAnswers>(std::array{std::size_t{0}, lag_, later_lag_})
                : nullptr) {
  assert(lag <= kMaxLag && options.hand_over_samples <= kMaxHandOver);
  reset();
}

void KalmanBank::reset() noexcept {
  count_ = 0;
  start_.reset();
  fitted_ = false;
  unit_ = 0.0;
  members_ = {};
  residuals_ = {};
  motion_ = {};
  slow_motion_ = SlowMotion::kUntold;
  realtime_correction_ = {};
  denoised_correction_ = {};
  later_correction_ = {};
  later_gain_ = {};
  at_once_ = {};
  resized_ = 0.0;
  normalised_innovation_ = 1.0;
  if (band_) band_->forget();
}

void KalmanBank::use(const BankModel& model) noexcept {
  if (!model.usable()) return;
  const bool answers = count_ > lag_;
  const double realtime = answers ? combine(0).rate : 0.0;
  const double denoised = answers ? combine(lag_).rate : 0.0;
  const bool compares = later_lag_ != lag_ && count_ > later_lag_;
  const double later = compares ? combine(later_lag_).rate : 0.0;
  model_ = model;
  if (band_) band_->use(model_);
  apply_options();
  unit_ = 1.0;
  if (!fitted_) {
    fitted_ = true;
    for (Member& member : members_) member.weight = member.hindsight = 0.0;
  }
  const std::uint64_t begin = count_ - std::min<std::uint64_t>(count_, options_.hand_over_samples);
  for (std::size_t i = 0; i < kMembers; ++i) {
    if (!model_.members[i].usable) continue;
    members_[i].x = {};
    expect_error(i);
    expect_hindsight(i);
    for (std::uint64_t time = begin; time < count_; ++time) predict_and_update(i, sample_at(time), time);
    if (count_ > begin && !std::isfinite(members_[i].innovation[(count_ - 1) % kRing])) {
      model_.members[i].usable = false;
    }
  }
  if (!has_member(model_)) return reset();
  settle_weights();
  if (!answers || options_.hand_over_memory == 0.0) return;
  realtime_correction_.step += realtime - combine(0).rate;
  denoised_correction_.step += denoised - combine(lag_).rate;
  if (compares) later_correction_.step += later - combine(later_lag_).rate;
}

void KalmanBank::expect_error(std::size_t index) noexcept {
  const MemberModel& member = model_.members[index];
  for (std::size_t lag = 0; lag <= kMaxLag; ++lag)
    error_variance_[index][lag] = limited() ? member.band_variance[lag] : member.error_variance(lag);
}

/// What the model makes of the options: its rate, its window, and what that spoke for.
void KalmanBank::apply_options() noexcept {
  const double full = model_.full_prior;
  const double agile = portable_exp(options_.agile_log_prior);
  prior_ = {full,
            1.0,
            agile,
            agile,
            full * portable_exp(options_.rough_log_prior),
            portable_exp(options_.still_log_prior),
            portable_exp(options_.lasting_log_prior)};
  switching_rate_ = model_.scale.switching_rate(options_.switching_rate);
  hindsight_rate_ = model_.scale.switching_rate(options_.hindsight_rate);
  fit_memory_ = model_.scale.memory(kFitMemory);
}

BankEstimates KalmanBank::step(double sample) noexcept {
  history_[count_ % history_.size()] = sample;
  if (!fitted_) {
    follow_start(sample);
  } else if (!follow(sample)) {
    return start_anew(sample);
  }
  feed_band();
  slow_motion_ = motion_.follow(sample, model_.slow_noise_variance * unit_, options_, model_.scale);
  BankEstimates answer;
  answer.realtime = combine(0);
  correct(sample, 0, realtime_correction_, answer.realtime);
  resize_at_once(answer.realtime);
  if (!std::isfinite(answer.realtime.rate)) return start_anew(sample);
  answer.denoised = answer.realtime;
  if (lag_ > 0 && count_ > lag_) {
    if (fitted_) look_back();
    answer.denoised = combine(lag_);
    correct(sample_at(count_ - 1 - lag_), lag_, denoised_correction_, answer.denoised);
  }
  return compare_later(answer.denoised.rate) ? answer : start_anew(sample);
}

/// The members take the sample. @return false where none is left that can answer
bool KalmanBank::follow(double sample) noexcept {
  double fit = 0.0;
  double weights = 0.0;
  bool lost = false;
  std::array<double, kMembers> surprise{};
  for (std::size_t i = 0; i < kMembers; ++i) {
    const MemberModel& member = model_.members[i];
    if (!member.usable) continue;
    predict_and_update(i, sample, count_);
    const double nu = members_[i].innovation[count_ % kRing];
    const double S = member.innovation_variance * unit_;
    surprise[i] = S > 0.0 ? std::min(nu * nu / S, kMostSurprise) : 0.0;
    if (!std::isfinite(surprise[i])) {
      model_.members[i].usable = false;
      lost = true;
      continue;
    }
    fit += members_[i].weight * std::min(surprise[i], kMostToMean);
    weights += members_[i].weight;
  }
  ++count_;
  if (!has_member(model_)) return false;
  if (lost) settle_weights();
  weigh(surprise);
  if (weights > 0.0) normalised_innovation_ += (fit / weights - normalised_innovation_) / fit_memory_;
  return true;
}

/// Variances are in parts of the noise's.
void KalmanBank::follow_start(double sample) noexcept {
  if (count_ == 0) {
    model_ = {};
    model_.noise_variance = 1.0;
    model_.slow_noise_variance = 1.0;
    model_.residual_variance = 1.0;
    apply_options();
  }
  start_.step(sample);
  unit_ = start_.noise_variance();
  ++count_;
}

/// No member is left within the finite numbers: the sample answers for itself, now and, until there have been `lag` more, with look-ahead.
BankEstimates KalmanBank::start_anew(double sample) noexcept {
  reset();
  const BankEstimate nothing_known{.rate = sample, .variance = std::numeric_limits<double>::max()};
  return {.realtime = nothing_known, .denoised = nothing_known};
}

void KalmanBank::predict_and_update(std::size_t index, double sample, std::uint64_t time) noexcept {
  const MemberModel& model = model_.members[index];
  Member& member = members_[index];
  double signal = 0.0;
  double sum = 0.0;
  double* x = member.x.data();
  for (const FilterBlock& block : model.blocks.all()) {
    // Nearly all are modes: with an order that the compiler knows.
    const double head =
        block.order == kModeOrder ? advance(block.a, x, kModeOrder) : advance(block.a, x, block.order);
    sum += head;
    signal += block.signal * head;
    x += block.order;
  }
  const double nu = sample - model_.mean - sum;
  for (std::size_t i = 0; i < model.states; ++i) member.x[i] += model.gain[i] * nu;
  member.innovation[time % kRing] = nu;
  member.prediction[time % kRing] = signal;
  member.whole[time % kRing] = sum;
}

/// Which members can answer may have changed: weights are what the others had, or, where they had none, the prior.
void KalmanBank::settle_weights() noexcept {
  prior_sum_ = 0.0;
  double sum = 0.0;
  double hindsight = 0.0;
  for (std::size_t i = 0; i < kMembers; ++i) {
    Member& member = members_[i];
    if (!model_.members[i].usable) {
      member.weight = member.hindsight = 0.0;
      continue;
    }
    const double S = model_.members[i].innovation_variance;
    member.density = S > 0.0 ? portable_exp(-0.5 * options_.likelihood_power * portable_log(S)) : 1.0;
    prior_sum_ += prior_[i];
    sum += member.weight;
    hindsight += member.hindsight;
  }
  for (std::size_t i = 0; i < kMembers; ++i) {
    if (!model_.members[i].usable) continue;
    Member& member = members_[i];
    const double prior = prior_[i] / prior_sum_;
    member.weight = sum > 0.0 ? member.weight / sum : prior;
    member.hindsight = hindsight > 0.0 ? member.hindsight / hindsight : prior;
  }
  mix();
}

/// @param surprise nu^2 / S of the members that are usable
void KalmanBank::weigh(const std::array<double, kMembers>& surprise) noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kMembers; ++i) {
    if (model_.members[i].usable) least = std::min(least, surprise[i]);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < kMembers; ++i) {
    if (!model_.members[i].usable) continue;
    Member& member = members_[i];
    const double before = std::lerp(member.weight, prior_[i] / prior_sum_, switching_rate_);
    const double behind = 0.5 * options_.likelihood_power * (surprise[i] - least);
    member.weight = before * member.density * portable_exp(-std::min(behind, options_.most_evidence));
    sum += member.weight;
  }
  for (Member& member : members_) {
    member.weight /= sum;
    member.weights[(count_ - 1) % kRing] = member.weight;
  }
  if (lag_ == 0) mix();
}

}  // namespace gyrod::core
