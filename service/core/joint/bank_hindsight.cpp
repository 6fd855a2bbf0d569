// How the bank weighs its members for answers with look-ahead.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/joint/kalman_bank.hpp"
#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

/// 1 - leverage where a sample is hardly smoothed: its estimate takes in all of it, and says nothing of the others.
constexpr double kLeastRest = 1e-3;

}  // namespace

/// Innovations tell how well a member predicts; what it makes of samples before and after is another question, and where motion is slow beside
/// the noise the answers differ. So each is asked for z[t-lag] from all samples up to z[t] but that one. With h the leverage of the sample and d what its
/// estimate leaves of it, white noise of variance r makes that
///   z - E[z | all others] = d / (1 - h),   of variance r / (1 - h).
/// Source: leave-one-out residuals of linear smoothers, Craven, Wahba 1979, "Smoothing noisy data with spline functions".
void KalmanBank::look_back() noexcept {
  std::array<double, kMembers> score{};
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kMembers; ++i) {
    if (!model_.members[i].usable) continue;
    score[i] = hindsight_of(i);
    best = std::max(best, score[i]);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < kMembers; ++i) {
    if (!model_.members[i].usable) continue;
    Member& member = members_[i];
    const double before = std::lerp(member.hindsight, prior_[i] / prior_sum_, hindsight_rate_);
    const double behind = options_.likelihood_power * (best - score[i]);
    member.hindsight = before * portable_exp(-std::min(behind, options_.most_evidence));
    sum += member.hindsight;
  }
  for (Member& member : members_) member.hindsight /= sum;
  mix();
}

/// Logarithm of a member's density of z[t-lag] given all other samples, up to a constant that all members share.
double KalmanBank::hindsight_of(std::size_t index) const noexcept {
  const MemberModel& model = model_.members[index];
  const Member& member = members_[index];
  const std::uint64_t then = count_ - 1 - lag_;
  double left = sample_at(then) - model_.mean - member.whole[then % kRing];
  for (std::size_t k = 0; k <= lag_; ++k)
    left -= model.whole_smoothing[k] * member.innovation[(then + k) % kRing];
  const double variance = model.white_variance * unit_ * member.rest;
  const double surprise = variance > 0.0 ? std::min(left * left / variance, kMostSurprise) : 0.0;
  return 0.5 * (member.log_rest - surprise);
}

/// A model has come.
void KalmanBank::expect_hindsight(std::size_t index) noexcept {
  members_[index].rest = std::max(1.0 - model_.members[index].leverage(lag_), kLeastRest);
  members_[index].log_rest = portable_log(members_[index].rest);
}

/// Weights in answers with look-ahead, w (v / u)^b with u what w was at the time that v is of: hindsight takes the place of half of what the
/// innovations had said by then, or less; what they have said since counts in full, so that a turn is believed as soon. A bank that answers at once looks
/// at nothing in hindsight: v is u.
void KalmanBank::mix() noexcept {
  const std::uint64_t time = count_ - 1 - lag_;
  double sum = 0.0;
  for (Member& member : members_) {
    const double then = count_ > lag_ ? member.weights[time % kRing] : 0.0;
    double ratio = lag_ > 0 && then > 0.0 ? member.hindsight / then : 1.0;
    for (int root = 0; root < hindsight_roots_; ++root) ratio = std::sqrt(ratio);
    member.late = member.weight * ratio;
    sum += member.late;
  }
  for (Member& member : members_) member.late = sum > 0.0 ? member.late / sum : member.weight;
}

/// b = 1/2 from kSeenWell samples of look-ahead on, and half of that for every halving below: what hindsight tells beyond the innovations comes
/// with the samples after the one that is asked for.
int KalmanBank::roots_at(std::size_t lag) noexcept {
  constexpr std::size_t kSeenWell = 16;
  int roots = 1;
  for (std::size_t seen = std::max<std::size_t>(lag, 1); seen < kSeenWell; seen *= 2) ++roots;
  return roots;
}

}  // namespace gyrod::core
