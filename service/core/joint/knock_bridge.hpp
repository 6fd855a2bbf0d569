/// Takes knocks out of a window before it is fitted. Internal to core/joint.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/joint/joint_options.hpp"

namespace gyrod::core {

/// A knock of a hundred times the noise fills the spectrum of the window that holds it, and the fit would then expect that much of every
/// sample to come, for as long as the knock is in the window. With e the squared second differences of the window and m their means over 9
/// samples: a knock is a run of samples with m above knock_tail times its median that reaches knock_ratio times it, and is over before the
/// window is; what is not over may be a vibration that has begun. Straight lines take the place of knocks, unless they are more than
/// knock_share of the window: then shaking is what the window is about.
/// Sizes its workspace once; apply() allocates nothing. One object per worker; not thread-safe.
class KnockBridge {
 public:
  explicit KnockBridge(std::size_t max_samples);

  /// @param window finite, at most max_samples; knocks are bridged in place
  /// @return how many samples were bridged
  std::size_t apply(std::span<double> window, const JointOptions& options) noexcept;

 private:
  void measure(std::span<const double> window) noexcept;
  [[nodiscard]] std::size_t mark(double tail, double ratio) noexcept;
  void bridge(std::span<double> window) const noexcept;

  std::vector<double> roughness_;  ///< m
  std::vector<double> sorted_;
  std::vector<char> knocked_;
};

}  // namespace gyrod::core
