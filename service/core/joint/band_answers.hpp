/// What a bank answers within a signal band.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/joint/joint_model.hpp"
#include "core/joint/signal_band.hpp"

namespace gyrod::core {

/// With f the low-pass that stands for the band (SignalBand), what is asked for is not the signal s but d[t] = sum_j f[j] s[t+j]. A member's answer is
///   E[d[t-L] | z[..t]] = sum_j f[j] E[s[t-L+j] | z[..t]],
/// but for what the oldest samples gain with more than kMaxLag samples of look-ahead.
/// Of that the samples up to kMaxLag before the newest, smoothed as far as they can be, and those to come, predicted, are
///   sum_(i <= kMaxLag) (f[L-i] (mean + C' A x[t-i-1]) + row.innovations[i] nu[t-i]) + row.states x[t] + mean sum_(n >= 1) f[L+n],
///   row.innovations[i] = sum_(k = i .. kMaxLag) f[L-k] g_(k-i),   row.states = sum_(n >= 1) f[L+n] C' A^n;
/// samples before are what the bank answered with a look-ahead of kMaxLag when it was time, the same for all members; before there were any, the first of
/// them, of which the variance does not know.
/// About 30 KB; allocates nothing after construction. Not thread-safe. Internal to core/joint.
class BandAnswers {
 public:
  /// What a member's part is made with.
  struct Row {
    std::array<double, kMaxLag + 1> innovations{};
    std::array<double, kMaxStates> states{};
  };
  static constexpr std::size_t kOftenAsked = 3;

  /// @param lags that are asked for with every sample, each at most kMaxLag
  explicit BandAnswers(const std::array<std::size_t, kOftenAsked>& lags) noexcept : lags_(lags) {}

  /// Takes over the band of a model and makes the rows of its members.
  void use(const BankModel& model) noexcept;
  [[nodiscard]] const SignalBand& band() const noexcept { return band_; }

  /// Row of a member of the last model for a lag that is asked for often; null for others, for which it can be made.
  [[nodiscard]] const Row* known_row(std::size_t member, std::size_t lag) const noexcept;
  [[nodiscard]] Row make_row(const MemberModel& member, std::size_t lag) const noexcept;

  /// Takes the signal's estimate of the sample that is kMaxLag before the newest, mean and all; to be called for every one from the first on.
  void feed(double estimate) noexcept;
  /// The part of the samples before that one. @pre feed() was called for the newest sample
  [[nodiscard]] double settled_part(std::size_t lag) const noexcept;
  /// Sum of f over all others: what the members' mean counts. @pre lag <= kMaxLag
  [[nodiscard]] double share_of_members(std::size_t lag) const noexcept { return shares_[lag]; }
  /// Begins anew, as of the first sample.
  void forget() noexcept { settled_count_ = 0; }

 private:
  static constexpr std::size_t kRing = SignalBand::kMaxReach + 1;

  [[nodiscard]] std::span<const double> settled_taps(std::size_t lag) const noexcept;

  SignalBand band_;
  std::array<double, kMaxLag + 1> shares_{};
  std::array<std::size_t, kOftenAsked> lags_;
  std::array<std::array<Row, kOftenAsked>, kMembers> rows_{};
  std::uint64_t settled_count_ = 0;
  std::array<double, 2 * kRing> settled_{};  ///< a ring, twice: the last kRing lie one behind the other
};

}  // namespace gyrod::core
