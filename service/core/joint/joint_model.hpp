/// What the slow loop of the two-speed estimator hands to the fast one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/joint/joint_options.hpp"
#include "core/joint/lasting_spectrum.hpp"
#include "core/joint/line_tracker.hpp"
#include "core/joint/member_model.hpp"
#include "core/joint/noise_tracker.hpp"

namespace gyrod::core {

/// The members of the bank. Each answers for a kind of motion; how well it predicts decides its weight.
enum class MemberKind : std::uint8_t {
  kFull,     ///< all modes of the fit
  kPruned,   ///< the modes that pay
  kLevel,    ///< the pruned ones and a nearly constant rate: a turn begins
  kSlope,    ///< the pruned ones and a nearly constant acceleration: a turn winds up
  kRough,    ///< all modes, driven harder: a bump
  kStill,    ///< all modes, hardly driven: little moves but what is slow
  kLasting,  ///< the modes of the last windows together
};
inline constexpr std::size_t kMembers = 7;

/// What the fast loop takes of it. A plain value of about 24 KB: copied, never shared.
struct BankModel {
  double mean = 0.0;            ///< of the window, the members' zero, in the data's unit
  double noise_variance = 0.0;  ///< of the noise that the members see, in the data's unit squared
  /// Of white noise that is as strong as the noise is where it is slowest: what slow motion is compared with. A sensor's own low-pass leaves far
  /// less in all than that.
  double slow_noise_variance = 0.0;
  /// Limit of the signal band, cycles per sample; one half where there is none.
  double band_cycles = 0.5;
  /// Of what modes have that is not asked for where there is a signal band: beyond it, or a line's; 0 where none is set.
  double beyond_band_variance = 0.0;
  /// Of what a good estimate takes off the samples: the noise, and what is left out as no signal. Infinite where a signal band is set.
  double residual_variance = 0.0;
  std::array<MemberModel, kMembers> members{};
  /// Prior weight of the full set and of the rough member, in parts of what the options give them: below 1 where the window hardly speaks for more than
  /// its slow mode.
  double full_prior = 1.0;
  /// What becomes of the options at the window's sample rate and length.
  JointScale scale;
  /// What the windows so far say about the noise.
  NoiseTracker noise;
  /// And about where its lines are.
  LineTrackers lines{};
  /// Members that could not be made of the last window and keep what they had.
  std::size_t fallbacks = 0;

  [[nodiscard]] MemberModel& member(MemberKind kind) noexcept {
    return members[static_cast<std::size_t>(kind)];
  }
  [[nodiscard]] const MemberModel& member(MemberKind kind) const noexcept {
    return members[static_cast<std::size_t>(kind)];
  }
  /// False until a window has been fitted.
  [[nodiscard]] bool usable() const noexcept { return member(MemberKind::kFull).usable; }
};

/// And what the next window's fit goes on from.
struct JointModel : BankModel {
  LastingSpectrum lasting;
};

}  // namespace gyrod::core
