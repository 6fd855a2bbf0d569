/// The low-pass that a signal band stands for.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace gyrod::core {

/// f[-reach] .. f[reach], symmetrical, of sum 1: sin(2 pi c j) / (pi j) in a Hamming window, reach = 8 / c, c the limit in cycles a sample. The gain
/// is 1 to 0.005 up to 0.9 c, a half at c and 0.005 at the most from 1.1 c on; less steep where 8 / c is beyond kMaxReach.
/// A plain value.
class SignalBand {
 public:
  static constexpr std::size_t kMaxReach = 511;

  /// @param cycles the limit, cycles per sample, taken in steps of 0.1 to 0.2 %, so that a sample rate that is estimated anew makes no other filter;
  /// one half or more, as at the start: there is none
  void set(double cycles) noexcept;

  [[nodiscard]] bool limits() const noexcept { return cycles_ < 0.5; }
  /// The limit as it was taken.
  [[nodiscard]] double cycles() const noexcept { return cycles_; }
  /// 0 without a limit.
  [[nodiscard]] std::size_t reach() const noexcept { return reach_; }
  /// f[offset]; 0 beyond the reach.
  [[nodiscard]] double tap(std::ptrdiff_t offset) const noexcept {
    const auto reach = static_cast<std::ptrdiff_t>(reach_);
    return offset < -reach || offset > reach ? 0.0 : taps_[static_cast<std::size_t>(offset + reach)];
  }
  /// f[-reach] .. f[reach].
  [[nodiscard]] std::span<const double> taps() const noexcept { return {taps_.data(), 2 * reach_ + 1}; }
  /// What it makes of a sine of so many cycles a sample: f[0] + 2 sum f[j] cos(2 pi cycles j).
  [[nodiscard]] double gain(double cycles) const noexcept;

 private:
  double cycles_ = 0.5;
  std::size_t reach_ = 0;
  std::array<double, 2 * kMaxReach + 1> taps_{1.0};
};

/// The low-pass over a whole record; NaN where it would reach beyond an end or a sample that is no number.
[[nodiscard]] std::vector<double> low_passed(std::span<const double> x, const SignalBand& band);

}  // namespace gyrod::core
