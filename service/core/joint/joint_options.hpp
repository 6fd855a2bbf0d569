/// The numbers of the two-speed estimator, and its limits.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/emd/emd.hpp"

namespace gyrod::core {

/// Order of a mode's AR model: an oscillation and one more pole.
inline constexpr std::size_t kModeOrder = 3;
/// Modes at the most, the slow one among them; what is faster than T_slow and beyond that number joins the slow mode.
inline constexpr std::size_t kMaxModes = 10;
/// Largest lag that a filter answers for, samples.
inline constexpr std::size_t kMaxLag = 32;

/// Sample rate and window that the numbers below were chosen at.
inline constexpr double kDesignRateHz = 120.0;
inline constexpr std::size_t kDesignWindowSamples = 1024;

/// What is known of the lines that sensors have in their noise, and how they are followed (core/joint/line_tracker.hpp).
/// Source: tests/benchmark/joint_study.cpp with noise=1z, 2z and 4z; docs/decisions/0007.
struct LineOptions {
  /// Half of a line's width at half of its height, in parts of its frequency, is what the calibration says, between these: what a long record adds to it
  /// is how far the line has wandered, and no line stays in its place. Ranges above 0..0.1.
  double least_half_width = 0.003;
  double half_width = 0.0125;
  /// What a window adds to that, in bins of its own length. Range 0..100.
  double resolution = 1.5;
  /// How far a line wanders in a window's time, in parts of its frequency. Range 0..0.1.
  double drift = 0.007;
  /// Of what has been learned, the part that a window's time takes away: a road or an engine that was taken for the line is forgotten. Range 0..1.
  double leak = 0.05;
  /// Modes so near may be the rest of the line, in half widths of what it is taken for. Range 0..100.
  double reach = 2.0;
};

/// As of the design's rate and window; JointScale tells what becomes of them elsewhere.
/// Source, where nothing else is said: tests/benchmark/joint_study.cpp; docs/decisions/0006 gives what other values cost.
struct JointOptions {
  EmdOptions emd;
  /// IMFs whose energy is below this part of white noise's in the same IMF are left out at the start. Range 0..10.
  double least_excess = 0.8;
  /// IMFs with longer mean periods than this join the slow mode, samples. Range 8..1e6.
  double slow_period_samples = 128.0;
  /// Samples from one window to the next: how much of a window is new. Range 1..65536.
  std::size_t hop_samples = 32;
  /// Recency-warped sine tapers that are averaged. Range 1..8.
  std::size_t tapers = 2;
  /// How strongly the tapers look at the newest samples; 0 looks at all alike. Range 0..20.
  double recency = 2.5;
  /// The same of the pruned set, which answers where the window is all alike, and then knows slow motion better from all of it. Range 0..20.
  double pruned_recency = 0.5;
  /// Iterations of the EM fit: of the full set of modes, and of the pruned set before and after pruning. The first pruned_iterations of the full
  /// set count for both. What is slow and strong needs most (docs/decisions/0006, "Where the fit ends"). Range 1..100.
  int full_iterations = 40;
  int pruned_iterations = 10;
  int final_iterations = 20;
  /// What every iteration takes off a mode's drive, the slow mode's excepted, in parts of it: a mode that is hardly more than noise fades,
  /// one that stands out keeps nearly all. It is the prior density drive^-k with k = shrinkage N / 2. Range 0..0.5.
  double shrinkage = 0.0055;
  /// Bandwidth below which a mode other than the slow one is not narrowed by the fit, cycles per sample. Range 0..0.1.
  double bandwidth_cycles = 0.0007;
  /// How far a narrow tone must stand out to get a mode of its own: white noise shows such a one in 0.5 % of windows, and the fit finds
  /// how much there is of it. Range 1..1e12.
  double tone_prominence = 12.0;
  /// Radius of the poles that this mode starts with: much less than a window can tell, so that the fit finds the width. Range 0..1.
  double tone_pole = 0.999;
  /// Bands in which the modes explain too little after their first iterations get a mode each, so many at the most. IMFs are an octave wide, and hold
  /// the tones of an engine or what resonates with much else. Range 0..9.
  int resonances = 3;
  /// Twice the log-likelihood that a better level of the band alone would buy, at least: white noise shows as much in one of eight windows. Range 1..1e12.
  double resonance_gain = 15.0;
  /// Iterations of all modes after each of them. Range 0..100.
  int resonance_iterations = 5;
  /// A mode is kept by pruning where it buys at least this much of twice the log-likelihood. Range 0..1e4.
  double prune_gain = 20.0;
  /// The lasting member's modes are fitted to the mean periodogram of the windows so far, in which a window counts for this many of its lengths. Range
  /// 0.1..100.
  double lasting_windows = 1.0;
  /// Iterations of its EM fit with every window, before bands that are explained too little get modes and after pruning. Range 1..100.
  int lasting_iterations = 10;
  int lasting_final_iterations = 5;
  /// As resonance_gain and prune_gain: a mean of several windows shows as much by chance more seldom. Range 1..1e12; 0..1e4.
  double lasting_resonance_gain = 5.0;
  double lasting_prune_gain = 2.0;
  /// Roots of every mode are pulled in by this factor, so that the filter forgets. Range 0.9..1.
  double pole_factor = 0.99995;
  /// The agile members' poles: nearly constant rate, nearly constant acceleration. Range 0..1.
  double level_pole = 0.9999;
  double slope_pole = 0.97;
  /// Variance of what drives an agile member's extra block, in parts of the full member's innovation variance. Range 0..10.
  double agile_drive = 0.01;
  /// The rough and the still member: the full set with all modes but the slow one driven by this many times the variance. Range 1..1000; 0.001..1.
  double rough_drive = 4.0;
  double still_drive = 0.1;
  /// Logarithm of the prior weight of an agile member, of the rough, of the still and of the lasting one. Range -100..0.
  double agile_log_prior = -1.0;
  double rough_log_prior = -0.5;
  double still_log_prior = 0.0;
  double lasting_log_prior = -0.5;
  /// Where pruning leaves nothing but the slow mode, the full set and the rough member weigh e^(g/2) of that a priori, g what twice the log-likelihood of
  /// the full set is beyond that of the pruned one and this: what the window's noise alone buys. Range 0..1e4.
  double full_evidence = 20.0;
  /// At least so much. Range 0..1.
  double least_full_prior = 0.25;
  /// Probability that another member than before answers best from the next sample on. Range 0..1.
  double switching_rate = 0.002;
  /// Likelihoods are raised to this power: the innovations of a member that only nearly fits are not independent of one another, and say
  /// less than they seem to. Range 0..1.
  double likelihood_power = 0.5;
  /// Most that one sample takes off the logarithm of a member's weight, beside the best one's. In a shock all members are far off, and the
  /// one whose prediction the motion happens to cross would answer for all that was. Range 0..1e12.
  double most_evidence = 2.0;
  /// Answers with look-ahead are weighed by hindsight, too (KalmanBank): the same as switching_rate of these weights. Range 0..1.
  double hindsight_rate = 0.002;
  /// What the bank's variance is multiplied by. It knows how well the best member does, and not that every member is a little wrong: its error
  /// squared is 1.13 to 1.21 times its variance, in the geometric mean of 18 rows, with six stretches of noise. Range 1..10.
  double variance_factor = 1.17;
  /// Samples that a new model is run over before it answers. Range 0..kMaxHandOver.
  std::size_t hand_over_samples = 256;
  /// What is left, from sample to sample, of the step that a new model would make in the answers. Range 0..1.
  double hand_over_memory = 0.8;
  /// Rate of the slow correction, per sample: it takes what the models miss of slow motion. Range 0..1.
  double correction_rate = 0.006;
  /// What is left of that rate where the samples show nothing slow but noise, in parts of it. Range 0..1.
  double still_correction = 0.15;
  /// Samples: of the mean that slow motion is told from, and of what is learned about it. Range 1..1e9.
  double motion_mean = 1024.0;
  double motion_memory = 600.0;
  /// The square of slow motion, in parts of what white noise makes of it: nothing moves up to motion_low in the mean, something does from motion_high on,
  /// or from motion_sure times as much at once. What is given back where the estimate has trusted the samples for long, below, is given in full from
  /// motion_steady on. Range 0..50, the second and the third above the first; 1..1e6.
  double motion_low = 2.5;
  double motion_high = 6.5;
  double motion_steady = 4.0;
  double motion_sure = 9.0;
  /// The same where the estimate trusts the samples: at least this much of the estimate's variance over the noise's. Range 0..1.
  double correction_share = 0.04;
  /// The same where the estimate has trusted the samples for long, as on a road that shakes: this much of the cube of the least ratio of
  /// late, up to most_steady_correction. Motion as small as the noise is weighed against it and shrinks; here it can be given back at little
  /// cost. Range 0..1e4; 0..1.
  double steady_correction = 30.0;
  double most_steady_correction = 0.05;
  /// The same of answers with look-ahead, which may be given back more: this much of the ratio's fourth power, and up to which rate. Range 0..1e6;
  /// 0..1.
  double late_steady_correction = 700.0;
  double most_late_steady_correction = 0.035;
  /// What answers with look-ahead miss shows in newer samples, too: the residual k samples later counts by residual_weight
  /// (1 - residual_decay rate)^k. In part, as it is that of an estimate without look-ahead, which misses more; and the less, the faster the
  /// correction is anyway. Range 0..1; 1..1e9.
  double residual_weight = 0.5;
  double residual_decay = 3.0;
  /// Samples in which a least ratio that is over is forgotten. Range 1..1e9.
  double steady_memory = 2048.0;
  /// What answers with look-ahead lack of slow motion in size shows in what they leave of the samples, and is added, up to this part of them.
  /// Range 0..0.5.
  double most_gain = 0.3;
  /// The noise of the samples counts this much of its variance against it, where slow motion is small. Range 0..1e6.
  double gain_ridge = 0.015;
  /// What is added is bounded to this many standard deviations of slow motion. Range 0..1e6.
  double gain_clip = 3.0;
  /// Samples at the design's rate, at any other the same seconds: of the low-passes that make motion slow (24: below some 0.5 Hz), of the one of what is
  /// added (3: with it, a swing of 1 Hz, too), of the mean that is left as it is, and of what is learned. Range 1..1e9.
  double gain_band = 24.0;
  double gain_follow = 3.0;
  double gain_mean = 512.0;
  double gain_memory = 4096.0;
  /// Answers at once are compared with later ones in the same band, and made larger by this part of slow motion at the most, or smaller by that
  /// (LaterGain). Range 0..1; 0..1.
  double most_later_gain = 0.2;
  double most_later_loss = 0.05;
  /// Likewise: of the low-pass of what is added, and of what is learned. Range 1..1e9.
  double later_follow = 8.0;
  double later_memory = 2048.0;
  /// What an estimate takes off the samples is noise, up to this many times its variance in one sample, and this many in the mean of late; what
  /// is more goes back. Range 1..1e12.
  double residual_limit = 25.0;
  double residual_mean_limit = 2.0;
  /// A sample whose residual's square is more than this many times that of all about it is wrong by itself. Range 1..1e12.
  double lone_limit = 9.0;
  /// Samples of that mean: enough for it to stay below 2 in all but a thousandth of the samples by chance (a standard deviation of 0.25), few
  /// enough for a knock. Range 1..1e9.
  double residual_memory = 16.0;
  /// A window's samples are a knock, and left out of its fit, where their squared second differences, smoothed, are above knock_tail times
  /// the median and reach knock_ratio times it, and where knocks are at most knock_share of the window. Range 1..1e12; 1..1e12; 0..1.
  double knock_ratio = 25.0;
  double knock_tail = 5.0;
  double knock_share = 0.25;
  LineOptions line;
};

/// Which options hold for a sample rate and a window. Those that mean a time keep it at rates above the design's, those that a short window
/// is too poor for follow its length in seconds. At lower rates and longer windows they stay what they are, but for a duration().
/// A plain value.
class JointScale {
 public:
  JointScale() = default;
  /// @param sample_rate_hz taken in quarters of an octave, so that an estimated rate does not make every model a little different; 0 or
  /// less while unknown: the design's
  JointScale(double sample_rate_hz, std::size_t window_samples) noexcept;

  /// rate * fewer / faster: the same seconds, and more often where windows are shorter and their models err more.
  [[nodiscard]] double switching_rate(double rate) const noexcept;
  /// drive / faster^2: an agile member's level has the same bandwidth in Hz (that of a random walk in white noise, sqrt(drive) a sample).
  [[nodiscard]] double agile_drive(double drive) const noexcept { return drive / (faster_ * faster_); }
  /// recency / shorter: tapers fall off within the same seconds as the design's.
  [[nodiscard]] double recency(double recency) const noexcept { return recency / shorter_; }
  /// shrinkage * shorter, at most 0.1: the less a window tells, the more the prior does.
  [[nodiscard]] double shrinkage(double shrinkage) const noexcept;

  /// share / shorter: what is forgotten in a window's length at the design's rate and window takes the same seconds here.
  [[nodiscard]] double forgetting(double share) const noexcept { return share / shorter_; }
  /// samples * faster: the same seconds.
  [[nodiscard]] double memory(double samples) const noexcept { return samples * faster_; }
  /// The same seconds at lower rates, too; at least one sample.
  [[nodiscard]] double duration(double samples) const noexcept { return std::max(samples * rate_, 1.0); }
  /// rate / faster: of what is owed the same part in the same seconds.
  [[nodiscard]] double pace(double rate) const noexcept { return rate / faster_; }
  /// rate * fewer / faster, at most 0.1: the same seconds; and it makes up for the window's mean, which wanders faster in a shorter window.
  [[nodiscard]] double correction_rate(double rate) const noexcept;

  friend bool operator==(const JointScale&, const JointScale&) = default;

 private:
  double rate_ = 1.0;     ///< sample rate in parts of the design's
  double faster_ = 1.0;   ///< the same, at least 1
  double shorter_ = 1.0;  ///< the design's window in parts of this one, in seconds, at least 1
  double fewer_ = 1.0;    ///< the same in samples
};

/// Largest hand_over_samples.
inline constexpr std::size_t kMaxHandOver = 1024;

}  // namespace gyrod::core
