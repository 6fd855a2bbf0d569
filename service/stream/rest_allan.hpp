/// The Allan deviation of a sensor's samples at rest.
#pragma once

#include <array>

#include "core/allan/online_allan.hpp"
#include "stream/rest_evidence.hpp"
#include "stream/sample.hpp"

namespace gyrod::stream {

/// core::OnlineAllan of three axes that takes samples back: whether they were at rest is known at the end of their block, and that the
/// next one was, too, a block later. Those of a block count once both were. A function of the calls; 40 kB; nothing allocates.
class RestAllan {
 public:
  void step(const std::array<double, kAxes>& rate_radps) noexcept;
  /// The block at work has ended.
  void end_block(bool at_rest) noexcept;
  /// The next sample does not join the last one: what was not yet sure is taken back.
  void interrupt() noexcept;

  /// Of what is sure.
  [[nodiscard]] AllanCurves curves() const noexcept;
  /// Goes on from those of an earlier run.
  void restore(const AllanCurves& curves) noexcept;
  void clear() noexcept { restore({}); }

 private:
  using Axes = std::array<core::OnlineAllan, kAxes>;

  Axes now_{};    ///< with all samples
  Axes ended_{};  ///< as at the end of the last block at rest
  Axes sure_{};   ///< as at the end of the block before that
  bool at_rest_ = false;
};

}  // namespace gyrod::stream
