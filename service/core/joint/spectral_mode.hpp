/// The modes of a window: stationary processes whose sum is the signal.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/joint/joint_options.hpp"

namespace gyrod::core {

/// x[t] = a_1 x[t-1] + a_2 x[t-2] + a_3 x[t-3] + w[t],   w ~ N(0, drive), with the spectrum drive / |a(w)|^2.
struct SpectralMode {
  std::array<double, kModeOrder> a{};
  double drive = 0.0;  ///< unit^2
  double variance =
      0.0;  ///< of what it was made of, unit^2: what its spectrum holds in all; 0 where that is not known
  bool slow = false;  ///< stands for all that is slower than T_slow
  /// Stands for a narrow tone: its drive says how fast it changes, which no member doubts.
  bool tone = false;
  /// How much of its variance is motion, 0..1; the rest is a line of the noise.
  double share = 1.0;
};

/// Up to kMaxModes of them; a plain value.
class ModeSet {
 public:
  [[nodiscard]] std::span<SpectralMode> modes() noexcept { return {modes_.data(), count_}; }
  [[nodiscard]] std::span<const SpectralMode> modes() const noexcept { return {modes_.data(), count_}; }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] bool full() const noexcept { return count_ == kMaxModes; }
  void clear() noexcept { count_ = 0; }
  /// @pre !full()
  void add(const SpectralMode& mode) noexcept { modes_[count_++] = mode; }
  /// @pre index < size()
  void remove(std::size_t index) noexcept {
    for (std::size_t i = index + 1; i < count_; ++i) modes_[i - 1] = modes_[i];
    --count_;
  }

 private:
  std::array<SpectralMode, kMaxModes> modes_{};
  std::size_t count_ = 0;
};

}  // namespace gyrod::core
