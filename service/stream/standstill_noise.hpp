/// A channel's noise from a calibration, from what was learned earlier, and from what is learned while it runs.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>

#include "core/noise/hidden_noise_learner.hpp"
#include "core/noise/standstill_learner.hpp"
#include "stream/noise_learner.hpp"
#include "stream/rest_allan.hpp"

namespace gyrod::stream {

/// What a calibration says of one sensor.
struct CalibratedNoise {
  double sample_rate_hz = 0.0;                   ///< that the models hold for, above 0
  std::array<core::NoiseModel, kAxes> models{};  ///< (rad/s)^2, as measured, without core::kNoiseMargin
};

/// All that is kept of a sensor across restarts.
struct RememberedNoise : core::StandstillState {
  RememberedNoise() = default;
  /// Without curves.
  RememberedNoise(const core::StandstillState& state)  // NOLINT(google-explicit-constructor): it is one
      : core::StandstillState(state) {}
  RememberedNoise(const core::StandstillState& state, const AllanCurves& allan)
      : core::StandstillState(state), curves(allan) {}

  AllanCurves curves{};
};

/// What StandstillNoise begins with.
struct StandstillOptions {
  double sample_rate_hz = 0.0;  ///< configured; 0: found from the stamps
  /// In use instead of anything learned.
  std::optional<CalibratedNoise> calibrated = {};
  /// Whether what is learned is in use where nothing is calibrated. At rest it is learned in any case.
  bool use_learned = true;
  /// Whether that goes for what is learned in motion, too. Method `paper` asks for none of it.
  bool learns_in_motion = true;
  /// Of an earlier run.
  std::optional<RememberedNoise> remembered = {};
  /// Told of every change of the learned models, from the thread that pushes. Must not throw; may be empty.
  std::function<void(const RememberedNoise&)> on_learned = {};
};

/// The models as a channel uses them: core::kNoiseMargin as strong. An axis whose model is not usable, one that the calibrated recording
/// did not have or that never changed, is given the strongest of the others.
/// @return source kNone where no axis has a usable model
[[nodiscard]] ChannelNoise channel_noise(NoiseSource source,
                                         const std::array<core::NoiseModel, kAxes>& models) noexcept;

/// What is known before the first sample: the calibration, at the configured sample rate if there is one; else what is remembered, if
/// it may be used and is of the configured rate.
[[nodiscard]] ChannelNoise noise_beforehand(const StandstillOptions& options) noexcept;

/// core::StandstillLearner for a channel. The sample rate that it and the calibration are used at is the configured one. Without one
/// it is that of the calibration or of what is remembered, until the stamps have said otherwise (by more than 2 %, and always the same)
/// for kAgreeing samples in a row; then it is theirs: a calibration goes through core::at_rate(), and learning begins anew.
/// Bridged positions are gaps to the learner where they are more than 2 % of a block's samples: what is interpolated has less noise. Of an
/// accelerometer that fails for a few samples the last value holds; where it fails for longer, rest is judged without it until it has been back
/// for kForcesAgain samples. Beside the learner grows the Allan deviation of what is at rest (RestAllan), of measured samples only; it begins anew
/// where the learner does. While nothing else is known, noise behind a sensor's own low-pass, and lines of its axes, are learned in motion (core::HiddenNoiseLearner), are in use
/// with the source kImf1, and are not kept: what is learned at rest takes their place.
class StandstillNoise final : public NoiseLearner {
 public:
  static constexpr std::size_t kAgreeing = 256;
  /// Samples in a row for which the last specific force holds.
  static constexpr std::size_t kMostHeldForces = 16;
  /// Samples for which an accelerometer that failed must have held before it counts again: one that comes and goes, or is far slower than
  /// the gyro, would begin rest anew each time.
  static constexpr std::size_t kForcesAgain = 256;

  explicit StandstillNoise(StandstillOptions options);

  void step(const Sample& sample, bool measured, double sample_rate_hz) noexcept override;
  [[nodiscard]] std::optional<ChannelNoise> update() noexcept override;
  void reset_segment() noexcept override;
  [[nodiscard]] bool at_rest() const noexcept override { return learner_.at_rest(); }
  [[nodiscard]] const RestEvidence* evidence() const noexcept override {
    return fresh_ ? &evidence_ : nullptr;
  }

 private:
  [[nodiscard]] const core::Triple* force_at(const Sample& sample, bool measured) noexcept;
  void end_block() noexcept;
  void follow_rate(double sample_rate_hz) noexcept;
  void take_rate(double sample_rate_hz) noexcept;
  void listen_in_motion(const Sample& sample, bool measured) noexcept;
  [[nodiscard]] ChannelNoise known() const noexcept;

  StandstillOptions options_;
  double rate_hz_;  ///< in use; 0 while nothing is known of it
  double other_rate_hz_ = 0.0;
  std::size_t agreeing_ = 0;
  bool rate_changed_ = false;
  core::Triple force_mps2_{};               ///< the last good one
  std::size_t held_ = kMostHeldForces + 1;  ///< samples since then
  std::size_t doubted_ = 0;                 ///< samples until the accelerometer counts again
  core::StandstillLearner learner_;
  std::uint64_t revision_ = 0;                      ///< of the learner, that was told
  std::optional<core::HiddenNoiseLearner> hidden_;  ///< where nothing is calibrated
  std::uint64_t hidden_revision_ = 0;
  bool learned_at_rest_ = false;  ///< the learner has a model, as of the last update()
  bool listening_ = false;        ///< the last sample went to hidden_
  RestAllan allan_;
  double rest_seconds_ = 0.0;  ///< of the learner, at the last block
  RestEvidence evidence_;
  bool fresh_ = false;  ///< the last step has made it
};

}  // namespace gyrod::stream
