#include "stream/joint_method.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/joint/joint_fit.hpp"
#include "core/joint/kalman_bank.hpp"
#include "core/joint/quietest_axis.hpp"
#include "core/joint/shared_motion.hpp"

namespace gyrod::stream {
namespace {

/// Beyond these the innovations are not those of the model: 0.6 to 0.8 is what a level 20 % too high looks like.
constexpr double kLeastInnovation = 0.7;
constexpr double kLargestInnovation = 2.0;
/// And within these they are again, 128 samples later at the earliest. The mean takes about a second from one limit to the other where the model
/// holds, less after a knock; at one limit for both, its noise crossed that again and again. Source: docs/joint.md, "When the noise is not as
/// believed". Numbers of samples are those of the design's rate; at higher ones the seconds are the same (core::JointScale::memory()).
constexpr double kLeastFitting = 0.8;
constexpr double kLargestFitting = 1.6;
constexpr double kLeastSpell = 128.0;
/// Where nothing is believed of the noise, nothing is broken by noise that is weaker than a window's guess: up to half of its power.
constexpr double kLeastGuessed = 0.5;
constexpr double kLeastGuessedFitting = 0.6;
/// The noise tracker has to disagree, or to agree, for so many samples: windows that are short yet, after a start, tell the level to a factor only.
constexpr double kSteady = 512.0;

/// Rates further apart than this, in parts, are not two estimates of one: with stamps that come in bursts, estimates are off by a burst in 64 samples.
constexpr double kOtherRate = 0.25;

struct JointState final : Model {
  explicit JointState(std::size_t window_samples) { JointState::make_room(window_samples); }
  void make_room(std::size_t window_samples) override {
    joint.lasting.make_room(core::RecencyTapers::bins(window_samples));
  }
  void reset() noexcept override {
    static_cast<core::BankModel&>(joint) = {};
    joint.lasting.forget();
    sample_rate_hz = 0.0;
  }
  [[nodiscard]] double noise_variance() const noexcept override { return joint.noise_variance; }
  /// What was learned of the noise is by cycles per sample: it does not hold at another rate.
  void follow_rate(double rate_hz) noexcept {
    if (!(rate_hz > 0.0)) return;
    const bool other =
        sample_rate_hz > 0.0 && std::abs(rate_hz - sample_rate_hz) > kOtherRate * sample_rate_hz;
    if (other) {
      joint.noise = {};
      joint.lines = {};
      joint.lasting.forget();
      joint.noise_variance = 0.0;
    }
    if (other || sample_rate_hz == 0.0) sample_rate_hz = rate_hz;
  }
  core::JointModel joint;
  double sample_rate_hz = 0.0;  ///< that the windows so far had; 0 while unknown
};

class JointMethod final : public ModelMethod {
 public:
  JointMethod(std::size_t window_samples, const core::JointOptions& options, double max_signal_hz)
      : fit_(window_samples, options), shared_(window_samples, options), max_signal_hz_(max_signal_hz) {}

  [[nodiscard]] std::size_t min_samples() const noexcept override { return core::JointFit::kMinSamples; }

  void compare(const std::array<WindowInput, kAxes>& axes) noexcept override {
    shared_.set_sample_rate(axes[0].sample_rate_hz);
    shared_.compare({axes[0].samples, axes[1].samples, axes[2].samples});
  }

  void fit(const WindowInput& window, Model& model, core::WindowReport& report) noexcept override {
    prepare(window, model);
    fit_.fit(window.samples, known_noise(window), static_cast<JointState&>(model).joint, report);
  }

  void follow_noise(const WindowInput& window, Model& model) noexcept override {
    prepare(window, model);
    fit_.follow_noise(window.samples, known_noise(window), static_cast<JointState&>(model).joint);
  }

 private:
  static core::NoiseModel known_noise(const WindowInput& window) noexcept {
    return window.noise_source != NoiseSource::kNone ? window.noise : core::NoiseModel{};
  }

  void prepare(const WindowInput& window, Model& model) noexcept {
    const bool limited = max_signal_hz_ > 0.0 && window.sample_rate_hz > 0.0;
    static_cast<JointState&>(model).follow_rate(window.sample_rate_hz);
    fit_.set_sample_rate(window.sample_rate_hz);
    fit_.set_most_noise(window.others_noise > 0.0 ? core::kMostOfQuietest * window.others_noise
                                                  : std::numeric_limits<double>::infinity());
    fit_.set_own(shared_.own(window.axis));
    fit_.set_max_signal(limited ? max_signal_hz_ / window.sample_rate_hz : 1.0);
  }

  core::JointFit fit_;
  core::SharedMotion shared_;
  double max_signal_hz_;
};

class JointFilter final : public SampleFilter {
 public:
  JointFilter(const core::JointOptions& options, std::size_t lag_samples, core::SignalBandLimit band)
      : bank_(options, lag_samples, band) {}

  void expect_noise(const core::NoiseModel& noise) noexcept override {
    bank_.expect_noise(core::is_usable(noise) ? core::noise_variance(noise) : 0.0);
  }

  void bound_noise(double variance) noexcept override { bank_.bound_start(variance); }

  void use(const Model& model) noexcept override {
    const core::JointModel& joint = static_cast<const JointState&>(model).joint;
    bank_.use(joint);
    noise_level_ = joint.noise.shown_level();
    noise_disagrees_ = joint.noise.disagrees();
    noise_is_hidden_ = joint.noise.is_hidden();
    if (!has_model_ && joint.noise.has_seen_a_window()) {
      fit_.wrong_noise = noise_disagrees_;
      fit_.hidden_noise = noise_is_hidden_;
    }
    has_model_ = true;
    guesses_ = joint.noise.belief() == core::NoiseBelief::kNothing;
    if (guesses_)
      forget_wrong_noise();
    else
      forget_hidden_noise();
    rescale(joint.scale);
    fit_.fallbacks += joint.fallbacks;
  }

  Estimates step(double sample) noexcept override {
    const core::BankEstimates answer = bank_.step(sample);
    judge();
    return {estimate(answer.realtime), estimate(answer.denoised)};
  }

  [[nodiscard]] Estimate held(std::size_t age) const noexcept override { return estimate(bank_.held(age)); }
  [[nodiscard]] ModelFit model_fit() const noexcept override { return fit_; }

  void reset() noexcept override {
    bank_.reset();
    fit_ = {};
    noise_level_ = 1.0;
    noise_disagrees_ = false;
    noise_is_hidden_ = false;
    has_model_ = false;
    guesses_ = false;
    unlikely_ = 0;
    forget_wrong_noise();
    forget_hidden_noise();
    rescale({});
  }

 private:
  /// Where nothing is believed any more, nothing of it is wrong.
  void forget_wrong_noise() noexcept {
    fit_.wrong_noise = false;
    otherwise_ = 0;
  }

  /// Where something is believed, nothing of it is guessed.
  void forget_hidden_noise() noexcept {
    fit_.hidden_noise = false;
    otherwise_hidden_ = 0;
  }

  /// Takes over what has been otherwise for long enough.
  void settle(bool& told, bool now, unsigned& otherwise) const noexcept {
    otherwise = now == told ? 0 : otherwise + 1;
    if (otherwise < steady_) return;
    told = now;
    otherwise = 0;
  }

  static Estimate estimate(const core::BankEstimate& answer) noexcept {
    return {answer.rate, answer.variance};
  }

  void rescale(const core::JointScale& scale) noexcept {
    least_spell_ = static_cast<unsigned>(std::lround(scale.memory(kLeastSpell)));
    steady_ = static_cast<unsigned>(std::lround(scale.memory(kSteady)));
  }

  void judge() noexcept {
    judge_noise();
    judge_innovation();
    const bool misfit = fit_.wrong_noise || fit_.hidden_noise || unlikely_ > 0;
    if (misfit && !fit_.misfit) ++fit_.misfits;
    fit_.misfit = misfit;
  }

  void judge_innovation() noexcept {
    const double mean = bank_.normalised_innovation();
    fit_.normalised_innovation = mean;
    const double least = guesses_ ? kLeastGuessed : kLeastInnovation;
    const double least_fitting = guesses_ ? kLeastGuessedFitting : kLeastFitting;
    const bool fits = unlikely_ == 0
                          ? mean >= least && mean <= kLargestInnovation
                          : unlikely_ >= least_spell_ && mean >= least_fitting && mean <= kLargestFitting;
    unlikely_ = fits ? 0 : std::min(unlikely_ + 1, least_spell_);
  }

  void judge_noise() noexcept {
    settle(fit_.wrong_noise, noise_disagrees_, otherwise_);
    settle(fit_.hidden_noise, noise_is_hidden_, otherwise_hidden_);
    fit_.noise_ratio = fit_.wrong_noise ? std::sqrt(noise_level_) : 1.0;
  }

  core::KalmanBank bank_;
  ModelFit fit_;
  double noise_level_ = 1.0;  ///< power, in parts of the believed one
  bool noise_disagrees_ = false;
  bool noise_is_hidden_ = false;
  bool guesses_ = false;    ///< nothing is believed of the noise
  bool has_model_ = false;  ///< since a reset, which what models remember of the noise outlasts
  unsigned least_spell_ = static_cast<unsigned>(kLeastSpell);  ///< samples
  unsigned steady_ = static_cast<unsigned>(kSteady);           ///< samples
  unsigned unlikely_ = 0;          ///< samples that the innovations have been so, least_spell_ at most
  unsigned otherwise_ = 0;         ///< samples in a row that it is not what fit_.wrong_noise says
  unsigned otherwise_hidden_ = 0;  ///< likewise of fit_.hidden_noise
};

}  // namespace

ModelMethodFactory joint_method(const core::JointOptions& options, double max_signal_hz) {
  return {.method =
              [options, max_signal_hz](std::size_t window_samples, std::size_t hop_samples) {
                core::JointOptions own = options;
                own.hop_samples = hop_samples;
                return std::make_unique<JointMethod>(window_samples, own, max_signal_hz);
              },
          .model = [](std::size_t window_samples) { return std::make_unique<JointState>(window_samples); },
          .filter =
              [options, max_signal_hz](std::size_t lag_samples) {
                return std::make_unique<JointFilter>(
                    options, lag_samples,
                    max_signal_hz > 0.0 ? core::SignalBandLimit::kPossible : core::SignalBandLimit::kNone);
              }};
}

}  // namespace gyrod::stream
