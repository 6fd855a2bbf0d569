/// Watches whether a channel's noise is what it is believed to be, and corrects it within bounds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/joint/noise_shape.hpp"
#include "core/noise/noise_model.hpp"

namespace gyrod::core {

/// What is believed of a channel's noise.
enum class NoiseBelief : std::uint8_t {
  kNothing,  ///< a unit only
  kLevel,    ///< how strong it is, as a data sheet says; of its colour nothing
  kColour,   ///< both: it was measured at rest
};

/// @return kNothing for a model that is not usable, kLevel for white noise
[[nodiscard]] NoiseBelief belief_in(const NoiseModel& noise) noexcept;

/// Per band of equal width between 0 and half the sample rate, the mean of I / R over the bins and over about the last three windows'
/// length: the observed power in parts of the noise's. Where there is nothing but noise, that is 1. A band far above is motion and
/// says nothing about the noise; the others tell level and colour.
/// A plain value; allocates nothing.
class NoiseTracker {
 public:
  /// Takes the periodogram of a window and the noise's spectrum at the same frequencies, in the same unit.
  /// @param believed the channel's noise in the data's unit; `noise` is its spectrum at variance 1, or 1 where nothing is believed. Where that has
  ///   changed, what is remembered is restated
  /// @param share how much of a window is new since the last one, 0..1: hop / window
  /// @param forgetting the same in parts of the design's window, in seconds (JointScale::forgetting()): by that the least is forgotten
  /// @param own how much of each band no other axis of the sensor shares (SharedMotion): what is shared is motion
  /// @param length of the window, in parts of the longest: those after a gap are short, and of noise restless
  void observe(std::span<const double> periodogram, std::span<const double> noise, const NoiseModel& believed,
               double share, double forgetting, const BandPower& own = kAllOwn, double length = 1.0) noexcept;

  /// Whether what was observed is a window in all: not only the beginning of one.
  [[nodiscard]] bool has_seen_a_window() const noexcept { return weight_ >= 1.0; }

  /// Power of the noise in parts of the believed one, and its tilt where no colour is believed (likely_shape()).
  /// Where one is, the level is the mean of the bands that do not hold motion, where that is below 1. Above 1 the smaller of
  /// mean^1.5 and (mean of the quietest three / 1.04)^3, and at least 1. Not above 1 where half of the bands hold motion: on a rough road every band holds
  /// some; nor where the quietest change from window to window by more than noise does; and, as motion comes and goes while noise stays, for more than
  /// 1.15 times the least that it has shown no band counts. That is forgotten by a hundredth in the design's 8.5 s. 1 and white before anything was observed.
  /// Where nothing is believed, bands are what no other axis shares of them; where a level alone is, of a level above 1 the part that no other axis
  /// shares of the quietest counts.
  /// A level that is believed wrong by a factor is followed all the way, from 1e-3 on: too high, as motion only adds; too low by more than 1.4, where
  /// no band is as quiet as believed and so many are alike, and change so little, that they hold noise and no motion, for long enough.
  [[nodiscard]] const NoiseShape& shape() const noexcept { return shape_; }
  [[nodiscard]] double level() const noexcept { return shape_.level; }

  /// True where the level is so far from 1 that the believed noise is wrong; and where all bands have become louder alike, for as long as that
  /// lasts: noise that has become stronger, or shaking at all frequencies, which is not believed to be noise before it has lasted for minutes.
  [[nodiscard]] bool disagrees() const noexcept;
  /// True where nothing is believed and the spectrum falls on to half the sample rate, as noise behind a sensor's own low-pass does: no band rises, of the
  /// upper four bands each has at most 0.75 of the one before, until there is a twentieth of the first, and the last has less than a fifth. The
  /// quietest band, by which noise is guessed, then says nothing of the others. Without a low-pass spectra end in a floor.
  [[nodiscard]] bool is_hidden() const noexcept;
  /// level(), or where all bands have become louder alike what these show, if that is more: what is to be told, not what is believed.
  /// 1 where nothing is believed: there level() is in the data's unit.
  [[nodiscard]] double shown_level() const noexcept {
    return belief_in(believed_) == NoiseBelief::kNothing ? 1.0 : std::max(level(), risen_level_);
  }
  [[nodiscard]] NoiseBelief belief() const noexcept { return belief_in(believed_); }

 private:
  [[nodiscard]] double level_alike(const BandPower& power) const noexcept;
  void find_far_level(const BandPower& power, double share) noexcept;
  [[nodiscard]] bool has_lasted(bool found, bool by_nearly_all, double level, double quietest,
                                double share) noexcept;
  [[nodiscard]] double near_level(const BandPower& bounded) const noexcept;
  void bound_by_own() noexcept;
  void watch_quietest(double growth) noexcept;
  [[nodiscard]] bool changes_like_noise() const noexcept;
  void restate(std::span<const double> noise, const NoiseModel& believed) noexcept;

  NoiseModel believed_;
  BandPower believed_power_{};  ///< of the bands, in the data's unit squared
  BandPower ratio_{};
  BandPower own_ratio_{};   ///< the same of what the axis shares with no other
  BandPower least_{};       ///< that ratio_ was of late
  BandPower own_least_{};   ///< that own_ratio_ was
  BandPower unrest_{};      ///< how much windows differ from one another, in parts of what noise does
  double quietest_ = 0.0;   ///< least level that the quietest bands have shown; 0 before they have told
  double weight_ = 0.0;     ///< of what was observed, in windows
  double far_level_ = 0.0;  ///< of noise far above what is believed; 0 where it is not
  double evidence_ = 0.0;   ///< for such a level, in windows' lengths
  double risen_level_ =
      0.0;  ///< what all bands show that are louder than believed, alike; 0 where they are not
  NoiseShape shape_;
};

}  // namespace gyrod::core
