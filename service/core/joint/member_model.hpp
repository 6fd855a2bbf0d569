/// A member of the bank: the steady-state Kalman filter of a sum of autoregressive processes in white noise.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "core/joint/joint_options.hpp"
#include "core/noise/noise_model.hpp"

namespace gyrod::core {

/// Blocks of a member: modes, one that makes it agile, the noise's colour and its lines.
inline constexpr std::size_t kMaxBlocks = kMaxModes + 2 + kMaxNoiseLines;
/// State elements of a member.
inline constexpr std::size_t kMaxStates = kMaxModes * kModeOrder + 2 + kMaxNoiseColour + 2 * kMaxNoiseLines;

/// One process of the sum, x[t] = a_1 x[t-1] + ... + a_p x[t-p] + w[t], w ~ N(0, drive); its state is (x[t], ..., x[t-p+1]).
struct FilterBlock {
  std::size_t order = 0;
  std::array<double, kMaxNoiseColour> a{};
  double drive = 0.0;  ///< unit^2
  /// How much of it is estimated, 0..1, of its variance: the sum of two processes alike but for their drives, one of them signal, is known
  /// by its sum only, and this much of that is expected to be the signal. 0 for the noise's colour.
  double signal = 0.0;
  /// signal (1 - signal) times the block's variance, unit^2: what the sum does not tell of the signal in it. 0 where signal is 0 or 1.
  double apart = 0.0;
};

/// The blocks of a member; a plain value.
struct BlockSet {
  std::size_t count = 0;
  std::array<FilterBlock, kMaxBlocks> blocks{};

  [[nodiscard]] std::span<const FilterBlock> all() const noexcept { return {blocks.data(), count}; }
  /// @pre count < kMaxBlocks
  void add(const FilterBlock& block) noexcept { blocks[count++] = block; }
};

/// z[t] = H' x[t] + v, v ~ N(0, r), x = A x + w with A of companion blocks, H = 1 at each block's head, C = H times each block's signal. In
/// the steady state, with X the prediction's covariance, S = H' X H + r, F = A (I - K H'):
struct MemberModel {
  BlockSet blocks;
  std::size_t states = 0;
  std::array<double, kMaxStates> gain{};  ///< K = X H / S
  double innovation_variance = 0.0;       ///< S, unit^2
  double prediction_variance = 0.0;       ///< C' X C + apart, of the predicted signal's error, unit^2
  /// g_k = C' X (F')^k H / S: the signal k samples ago is better known by g_k times the newest innovation.
  std::array<double, kMaxLag + 1> smoothing{};
  /// The same of all that is not white, signal or not: H' X (F')^k H / S.
  std::array<double, kMaxLag + 1> whole_smoothing{};
  double white_variance = 0.0;  ///< r, unit^2
  /// Within a signal band (core/joint/band_design.hpp): what the states tell of samples beyond kMaxLag ahead, and the variance of the error with a
  /// look-ahead of 0 .. kMaxLag, unit^2. 0 where there is none.
  std::array<double, kMaxStates> ahead{};
  std::array<double, kMaxLag + 1> band_variance{};
  bool usable = false;

  /// Variance of the estimate's error at this lag, C' X C - S sum_{k <= lag} g_k^2, unit^2. @pre lag <= kMaxLag
  [[nodiscard]] double error_variance(std::size_t lag) const noexcept;
  /// How much of a sample's white noise its own estimate at this lag takes in: the variance of what is left unknown of H' x, in parts of r;
  /// 0..1; 1 where nothing is white. @pre lag <= kMaxLag
  [[nodiscard]] double leverage(std::size_t lag) const noexcept;
};

/// Makes members. Sizes its workspace once; design() allocates nothing. Not thread-safe.
class MemberDesigner {
 public:
  MemberDesigner();
  ~MemberDesigner();
  MemberDesigner(MemberDesigner&&) noexcept;
  MemberDesigner& operator=(MemberDesigner&&) noexcept;

  /// From here on members have what answers within this band ask for. @param cycles as SignalBand::set()
  void set_band(double cycles) noexcept;
  /// The limit as it was taken, cycles per sample.
  [[nodiscard]] double band_cycles() const noexcept;

  /// Solves for the steady state (core/joint/block_riccati.hpp); the same bits on every processor.
  /// @param noise_variance r > 0, unit^2
  /// @return false, with `member` untouched, where it does not settle, is not finite or does not meet its equation
  /// @pre the blocks' roots lie inside the unit circle, their orders add up to at most kMaxStates
  [[nodiscard]] bool design(const BlockSet& blocks, double noise_variance, MemberModel& member) noexcept;

 private:
  class Workspace;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace gyrod::core
