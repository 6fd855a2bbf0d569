/// Learns a sensor's own noise while it stands still, sample by sample.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/noise/noise_fit.hpp"
#include "core/noise/noise_model.hpp"
#include "core/noise/rest_detector.hpp"

namespace gyrod::core {

/// What is kept across restarts. Plain numbers; an axis that never changed has a model that is not usable.
struct StandstillState {
  double sample_rate_hz = 0.0;
  double rest_seconds = 0.0;  ///< that the models were learned from, all told
  double segments = 0.0;  ///< that the models weigh, at most what ten minutes hold; of the axis with the most
  std::array<NoiseModel, 3> models{};
  Triple bias{};              ///< mean rate at rest
  double bias_seconds = 0.0;  ///< at rest with this bias, ten minutes at most
  friend bool operator==(const StandstillState&, const StandstillState&) = default;
};

/// Adds to RestDetector a memory, so that what only looks like rest is found out:
///   level:  a window whose variance on some axis exceeds 1.5 times the learned one is not at rest (a smooth road, a smooth engine).
///           One below 1 / 1.5 shows that what was learned was not rest either: the lower level wins, learning begins anew. Half an hour
///           at the higher level with no rest at the lower one in between makes the higher one true: sensors age;
///           A window in which an axis is stuck that was alive tells neither;
///   bias:   a window whose mean is more than 1 deg/s off the learned bias on some axis is a slow constant turn, unless such
///           windows, all alike, outlast what the bias was learned from (ten minutes of it at most).
/// An axis that has never changed has no say. While nothing is learned the first rest is believed. A constant turn leaves the noise as it is; only the bias is then wrong, until
/// outvoted.
///
/// Spectra of the segments at rest are averaged, with the weight of the last ten minutes of rest; older ones fade. From five
/// segments and ten seconds on fit_noise_and_lines() makes models of them, again whenever a tenth has been added. A line that two axes share is not
/// learned: a weak engine's, that passes for rest.
/// A function of samples and sample rate alone. About 100 kB; nothing allocates after construction. One thread at a time.
class StandstillLearner {
 public:
  /// @pre sample_rate_hz > 0
  explicit StandstillLearner(double sample_rate_hz);

  /// One sample, finite. Costs 0.1 us, three or six transforms every 256 samples, and 0.3 ms once a block when it learns.
  /// @param measured false where it lies on the line between its neighbours: RestDetector::bridge()
  /// @param rate rad/s
  /// @param accelerometer specific force, m/s^2, finite, or nullptr. Where this changes from one sample to the next it is a gap
  /// @return whether it ended a block, so that at_rest() and detector() are new
  bool step(const Triple& rate, const Triple* accelerometer = nullptr, bool measured = true) noexcept;

  /// A gap in the samples. What is learned stays.
  void interrupt() noexcept;

  /// The sample rate turns out to be another, e.g. found from stamps after the channel was opened: begins anew with it, and forgets
  /// what was learned. Allocates nothing. @pre sample_rate_hz > 0
  void retime(double sample_rate_hz) noexcept;

  /// Whether the last eight blocks were at rest; known at the end of each block (RestDetector: one second, 100 samples at least, and up to four times that).
  [[nodiscard]] bool at_rest() const noexcept { return at_rest_; }
  /// Rises with every change of models().
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  /// As measured, without kNoiseMargin. Not usable (is_usable()) before enough was learned, and for an axis that never changes.
  [[nodiscard]] const std::array<NoiseModel, 3>& models() const noexcept { return state_.models; }
  /// Of rest that was learned from.
  [[nodiscard]] double rest_seconds() const noexcept { return state_.rest_seconds; }
  /// Mean rate at rest, rad/s; 0 before the first rest.
  [[nodiscard]] const Triple& bias() const noexcept { return state_.bias; }

  [[nodiscard]] const StandstillState& state() const noexcept { return state_; }
  /// Takes up where a state was left.
  /// @return false, and nothing is changed, where the state is of a sample rate more than 2 % off, holds no usable model or is
  /// not finite
  bool restore(const StandstillState& state) noexcept;

  [[nodiscard]] const RestDetector& detector() const noexcept { return detector_; }

 private:
  void end_block() noexcept;
  [[nodiscard]] bool believes() noexcept;
  [[nodiscard]] bool believes_level() noexcept;
  [[nodiscard]] bool believes_bias() noexcept;
  void vote_for_other_bias() noexcept;
  void learn() noexcept;
  void learn_bias() noexcept;
  void fit() noexcept;
  [[nodiscard]] bool same_bias(const Triple& bias) const noexcept;
  void forget() noexcept;

  double block_seconds_ = 0.0;
  double segment_seconds_ = 0.0;
  double least_segments_ = 0.0;
  double most_segments_ = 0.0;
  RestDetector detector_;
  bool at_rest_ = false;
  std::uint64_t revision_ = 0;
  StandstillState state_;
  AxisSpectra spectra_;
  Triple since_fit_{};              ///< segments of these
  Triple level_{};                  ///< variances that the windows are compared with
  std::array<bool, 3> has_bias_{};  ///< the axis has changed at rest: its mean is no stuck value
  double louder_seconds_ = 0.0;
  Triple other_bias_{};
  double other_seconds_ = 0.0;
};

}  // namespace gyrod::core
