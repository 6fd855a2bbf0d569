/// The slow loop of the two-speed estimator: from a window to a bank of filters.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/denoise/screening.hpp"
#include "core/denoise/significance.hpp"
#include "core/denoise/window_report.hpp"
#include "core/emd/emd.hpp"
#include "core/joint/joint_model.hpp"
#include "core/joint/joint_options.hpp"
#include "core/joint/knock_bridge.hpp"
#include "core/joint/line_tracker.hpp"
#include "core/joint/recency_tapers.hpp"
#include "core/joint/tone.hpp"
#include "core/joint/whittle_fit.hpp"
#include "core/noise/noise_model.hpp"

namespace gyrod::core {

/// Bridges knocks (KnockBridge), takes the lines of the sensor's noise out (LineTracker) and the window minus its mean apart (EMD), starts a mode
/// from every IMF that holds more than noise, one from all that is slow and one from a narrow tone, fits their spectra beside the noise's
/// (WhittleFit), and makes the members of the bank (MemberDesigner).
/// Sizes its workspace once. fit() allocates nothing where the model has room for its window (LastingSpectrum::make_room()), and is a pure function of
/// its input and of what `model` knows of the windows before: the noise, its lines, what lasts, and members that cannot be made and stay. One object
/// per worker; not thread-safe.
/// Source: docs/joint.md, "Slow loop".
class JointFit {
 public:
  /// Shortest window that is fitted.
  static constexpr std::size_t kMinSamples = 64;

  /// @param max_samples longest window, at least kMinSamples
  /// @pre options within their ranges
  /// @throws std::invalid_argument for more IMFs than a report holds
  explicit JointFit(std::size_t max_samples, const JointOptions& options = {});

  /// From here on motion above this frequency, cycles per sample, counts as noise: it is part of what the filter expects, and not of what it
  /// answers (BandAnswers). One half or more (as at the start): all is signal.
  void set_max_signal(double cycles) noexcept { designer_.set_band(cycles); }

  /// From here on windows are sampled at this rate, Hz; 0 (as at the start) while unknown. Options become what JointScale makes of them.
  void set_sample_rate(double sample_rate_hz) noexcept;

  /// From here on noise that is not known is taken for no more than this, a variance in the data's unit; infinite at the start. For what
  /// the sensor's other axes tell.
  void set_most_noise(double variance) noexcept { most_noise_ = variance; }

  /// From here on so much of each band no other axis of the sensor shares (SharedMotion); all of it at the start.
  void set_own(const BandPower& own) noexcept { own_ = own; }

  /// @param window uniformly sampled, finite, any unit
  /// @param noise  the channel's noise; where it is not usable, or of its colour nothing is believed, what NoiseTracker makes of the bands is taken. Of one
  ///               that is not usable the lines are taken
  /// @param model  receives the members; untouched, but for `fallbacks` (0), where the window does not vary
  /// @param report receives mean, noise floor and the IMFs' figures
  /// @pre kMinSamples <= window.size() <= max_samples
  void fit(std::span<const double> window, const NoiseModel& noise, JointModel& model,
           WindowReport& report) noexcept;

  /// Takes of a window what fit() would of the noise, and makes no members: all of `model` that fits of other axes ask for.
  void follow_noise(std::span<const double> window, const NoiseModel& noise, JointModel& model) noexcept;

 private:
  [[nodiscard]] bool look_at(std::span<const double> window, const NoiseModel& noise, JointModel& model,
                             WindowReport& report) noexcept;
  void judge_noise(const NoiseModel& believed, JointModel& model, WindowReport& report) noexcept;
  [[nodiscard]] Tone find_motion_tone() noexcept;
  void decompose(WindowReport& report) noexcept;
  void describe(std::span<const double> imf, WindowReport& report) const noexcept;
  void start_mode(std::span<const double> imf, const ImfFigures& figures) noexcept;
  void start_tone(const Tone& tone) noexcept;
  [[nodiscard]] SpectralMode oscillation(double cycles, double power, double pole) const noexcept;
  void find_resonances(ModeSet& modes, double least_gain) noexcept;
  void fit_modes(LastingSpectrum& lasting) noexcept;
  void name_slow_mode(ModeSet& modes) noexcept;
  void fit_lasting(LastingSpectrum& lasting) noexcept;
  [[nodiscard]] double prior_of_full() noexcept;
  void design(JointModel& model) noexcept;
  bool make(const BlockSet& blocks, MemberKind kind, JointModel& model) noexcept;
  [[nodiscard]] BlockSet blocks_of(const ModeSet& modes, double times_drive) noexcept;
  [[nodiscard]] double left_out() noexcept;
  [[nodiscard]] double beyond_band() noexcept;
  /// How much of a window is new since the last one.
  [[nodiscard]] double new_share() const noexcept {
    return static_cast<double>(options_.hop_samples) / static_cast<double>(max_samples_);
  }
  [[nodiscard]] double seen_noise() const noexcept {
    return unit_ * (noise_variance(noise_) + lines_power());
  }
  [[nodiscard]] std::span<const NoiseLine> lines() const noexcept { return {lines_.data(), line_count_}; }
  void scale_lines(double factor) noexcept;
  [[nodiscard]] double lines_power() const noexcept;
  void take_lines(LineTrackers& trackers, std::span<const SpectralLine> believed) noexcept;
  void follow_lines(LineTrackers& trackers, std::size_t samples) noexcept;
  void share_out(ModeSet& modes) noexcept;
  [[nodiscard]] BlockSet with_agile(const FilterBlock& agile) noexcept;

  JointOptions options_;
  JointScale scale_;
  std::size_t max_samples_;
  Emd emd_;
  RecencyTapers tapers_;
  RecencyTapers pruned_tapers_;
  WhittleFit whittle_;
  MemberDesigner designer_;
  KnockBridge knocks_;
  SignificanceTest significance_;  ///< for reports: nothing here decides by it
  bool line_holds_;                ///< its tables are of this EMD
  std::vector<double> centred_;
  std::vector<double> imf_;
  std::vector<double> slow_;
  std::vector<double> periodogram_;
  std::vector<double> pruned_periodogram_;  ///< by pruned_tapers_
  std::vector<double> whitened_;
  NoiseModel noise_;  ///< of this window but for its lines, in parts of unit_
  std::size_t line_count_ = 0;
  std::array<NoiseLine, kMaxNoiseLines> lines_{};  ///< of this window, in parts of unit_
  double unit_ = 1.0;                              ///< variance of the noise
  double most_noise_ = std::numeric_limits<double>::infinity();
  BandPower own_ = kAllOwn;
  ModeSet full_;
  ModeSet pruned_;
  ModeSet lasting_;
};

}  // namespace gyrod::core
