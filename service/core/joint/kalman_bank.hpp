/// The fast loop of the two-speed estimator: a bank of steady-state Kalman filters.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/joint/band_answers.hpp"
#include "core/joint/bank_estimate.hpp"
#include "core/joint/gain_correction.hpp"
#include "core/joint/joint_model.hpp"
#include "core/joint/joint_options.hpp"
#include "core/joint/later_gain.hpp"
#include "core/joint/residual_check.hpp"
#include "core/joint/slow_correction.hpp"
#include "core/joint/slow_motion.hpp"
#include "core/joint/start_levels.hpp"

namespace gyrod::core {

/// What is known of x after a sample z[t].
struct BankEstimates {
  BankEstimate realtime;  ///< x[t] given z[..t]
  BankEstimate denoised;  ///< x[t-lag] given z[..t]; before sample number `lag` as realtime
};

/// Whether models may have a limit of the signal band: a bank then has room for that.
enum class SignalBandLimit : bool { kNone, kPossible };

/// Every member, per sample:
///   x <- A x,   s = C' x,   nu = (z - mean) - H' x,   x <- x + K nu,   w <- ((1 - a) w + a p) N(nu; 0, S)^power / sum,
/// with a the switching rate, p the prior weights (of the full set and the rough member as JointModel::full_prior has it), and the exponential in
/// N^power at least e^-most_evidence of the largest: Bayes' rule where now one member fits and now another, so that evidence adds up for as long as nothing speaks against it. The estimate at lag L is
///   e_L = mean + s[t-L] + sum_{k=0..L} g_k nu[t-L+k],
/// exact in the steady state; the bank's is e = sum w e_L with variance P = sum w (P_L + (e_L - e)^2), published times
/// variance_factor. With look-ahead w (v / u)^b / sum take the place of w: v are weights by the same rule, of how well a member answers for
/// z[t-lag] from all samples but that one, and u is what w was then (bank_hindsight.cpp). What is left of the step that the last new model made (a
/// fifth less with every sample) is taken back, so that a new model begins where the last one was. What the noise cannot have been goes back
/// (residual_check.hpp), and a slow correction (slow_correction.hpp) makes of that the answer; what it owes stays owed. What the answer
/// lacks in size is added (gain_correction.hpp); answers at once learn that from later ones, of kLeastLater samples' look-ahead or lag
/// (later_gain.hpp).
/// Within a signal band the answer is the low-passed signal (band_answers.hpp), from kMaxLag + 1 samples on.
/// Before the first model, local levels answer (start_levels.hpp).
/// A member that leaves the finite numbers is out until the next model; where none is left, all starts anew, and the sample answers
/// for itself. As after reset(), answers with look-ahead are then of the newest sample until there have been `lag` more.
/// Allocates nothing after construction; finite for finite input. Not thread-safe.
/// Source: docs/joint.md; fixed lag by innovations: Anderson, Moore 1979, "Optimal filtering", section 7.3; weights: Herbster, Warmuth
/// 1998, "Tracking the best expert" (fixed share).
class KalmanBank {
 public:
  /// @param lag 0..kMaxLag
  /// @param band @pre where it is kNone, models have no limit
  KalmanBank(const JointOptions& options, std::size_t lag, SignalBandLimit band = SignalBandLimit::kNone);

  /// Takes over a model (copied) from the next sample on: its members run over the last hand_over_samples first, and inherit the
  /// weights. A model that is not usable is ignored.
  void use(const BankModel& model) noexcept;
  /// Variance of the sensor's noise, unit^2, as known before there is a model; 0 (at first): it is guessed. Used until the first model, and
  /// again after reset().
  void expect_noise(double variance) noexcept { start_.expect_noise(variance); }
  /// Most that a guess before the first model may be, unit^2, until reset(). For what the sensor's other axes tell.
  void bound_start(double variance) noexcept { start_.bound_guess(variance); }
  /// Takes z[t].
  BankEstimates step(double sample) noexcept;
  /// x[t-age] given all up to z[t], 0 <= age <= lag. @pre more than age samples since the start, reset() or one that started anew
  [[nodiscard]] BankEstimate held(std::size_t age) const noexcept;
  /// Mean of nu^2 / S over about the last kFitMemory samples, at high rates the same seconds (JointScale): 1 where the model explains what comes
  /// in.
  [[nodiscard]] double normalised_innovation() const noexcept { return normalised_innovation_; }
  /// Forgets everything but what is expected of the noise.
  void reset() noexcept;

  static constexpr double kFitMemory = 256.0;
  /// Least look-ahead of the answers that those at once are compared with, samples: where the bank answers with less, it makes them besides.
  static constexpr std::size_t kLeastLater = 16;

 private:
  /// Ring of what a member made of the last samples; a power of two beyond kMaxLag.
  static constexpr std::size_t kRing = 64;
  static_assert(kRing > kMaxLag && (kRing & (kRing - 1)) == 0);

  struct Member {
    std::array<double, kMaxStates> x{};
    std::array<double, kRing> innovation{};
    std::array<double, kRing> prediction{};
    std::array<double, kRing> whole{};    ///< the same as prediction, of all that is not white, signal or not
    std::array<double, kRing> weights{};  ///< weight, by time
    double weight = 0.0;     ///< probability that it is the one that fits, given all samples so far
    double density = 0.0;    ///< of an innovation of 0, in parts that all members share
    double hindsight = 0.0;  ///< the same as weight by how well it answers for a sample that it is not shown
    double late = 0.0;       ///< weight in answers with look-ahead
    double rest = 1.0;       ///< 1 - leverage of a sample in its own estimate, at lag_
    double log_rest = 0.0;
  };

  /// What one of the outputs adds to the mixture's mean.
  struct Correction {
    double step = 0.0;  ///< what is left of the step from the last model's answer to the next one's
    ResidualCheck residual;
    SlowCorrection slow;
    GainCorrection gain;
  };

  void correct(double sample, std::size_t lag, Correction& correction, BankEstimate& answer) noexcept;
  [[nodiscard]] double unwanted() const noexcept;
  void resize_at_once(BankEstimate& answer) noexcept;
  [[nodiscard]] bool compare_later(double denoised) noexcept;
  [[nodiscard]] double beside(std::size_t lag, double residual, double step) const noexcept;
  [[nodiscard]] double expected_variance(std::size_t lag) const noexcept;
  [[nodiscard]] double widened(double variance) const noexcept;
  void apply_options() noexcept;
  [[nodiscard]] bool follow(double sample) noexcept;
  void follow_start(double sample) noexcept;
  [[nodiscard]] BankEstimates start_anew(double sample) noexcept;
  void predict_and_update(std::size_t index, double sample, std::uint64_t time) noexcept;
  void weigh(const std::array<double, kMembers>& surprise) noexcept;
  void look_back() noexcept;
  [[nodiscard]] double hindsight_of(std::size_t index) const noexcept;
  void expect_hindsight(std::size_t index) noexcept;
  void mix() noexcept;
  [[nodiscard]] static int roots_at(std::size_t lag) noexcept;
  void settle_weights() noexcept;
  [[nodiscard]] BankEstimate combine(std::size_t lag) const noexcept;
  [[nodiscard]] double weight_at(std::size_t index, std::size_t lag) const noexcept {
    return lag == 0 ? members_[index].weight : members_[index].late;
  }
  template <class Answer>
  [[nodiscard]] BankEstimate mixture(std::size_t lag, const Answer& answer) const noexcept;
  [[nodiscard]] BankEstimate combine_signal(std::size_t lag) const noexcept;
  void feed_band() noexcept;
  [[nodiscard]] double signal_estimate(std::size_t index, std::size_t lag) const noexcept;
  [[nodiscard]] double band_estimate(std::size_t index, std::size_t lag) const noexcept;
  [[nodiscard]] double band_part(std::size_t index, std::size_t lag,
                                 const BandAnswers::Row& row) const noexcept;
  [[nodiscard]] bool limited() const noexcept { return band_ && band_->band().limits(); }
  void expect_error(std::size_t index) noexcept;
  [[nodiscard]] double sample_at(std::uint64_t time) const noexcept {
    return history_[time % history_.size()];
  }

  JointOptions options_;
  std::size_t lag_;
  std::size_t later_lag_;  ///< of the answers that those at once are compared with
  BankModel model_;
  bool fitted_ = false;  ///< model_ came from a window
  StartLevels start_;    ///< until then
  double switching_rate_ = 0.0;
  double hindsight_rate_ = 0.0;
  int hindsight_roots_;
  double fit_memory_ = kFitMemory;  ///< samples
  double unit_ = 1.0;               ///< variances of the model in use are in parts of this
  std::uint64_t count_ = 0;         ///< samples taken
  std::vector<double> history_;
  std::unique_ptr<BandAnswers> band_;
  std::array<Member, kMembers> members_{};
  std::array<double, kMembers> prior_{};
  double prior_sum_ = 1.0;  ///< of the members that are usable
  /// P_L of every member at every lag.
  std::array<std::array<double, kMaxLag + 1>, kMembers> error_variance_{};
  std::array<double, kRing> residuals_{};  ///< of the estimates at lag 0, by time
  SlowMotion motion_;
  double slow_motion_ = SlowMotion::kUntold;  ///< what it said of the newest sample
  Correction realtime_correction_;
  Correction denoised_correction_;
  Correction later_correction_;  ///< of the answers at later_lag_, where that is not lag_
  LaterGain later_gain_;
  std::array<double, kRing> at_once_{};  ///< answers at once, before their size is changed, by time
  double resized_ = 0.0;                 ///< what the newest was given in size
  double normalised_innovation_ = 1.0;
};

}  // namespace gyrod::core
