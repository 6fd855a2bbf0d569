/// What of a signal moves slowly. Internal to core/joint.
#pragma once

namespace gyrod::core {

/// A signal without its mean, behind two low-passes y <- y + (x - y) / T. Its mean is 0 at first, or the first x where begin() says so.
/// A plain value.
class SlowBand {
 public:
  void begin(double x) noexcept { mean_ = x; }
  /// @param mean samples of the mean, at least 1
  /// @param band samples of the low-passes, at least 1
  /// @return x without its mean
  double follow(double x, double mean, double band) noexcept {
    mean_ += (x - mean_) / mean;
    const double moved = x - mean_;
    once_ += (moved - once_) / band;
    slow_ += (once_ - slow_) / band;
    return moved;
  }
  /// What is left behind one low-pass.
  [[nodiscard]] double once() const noexcept { return once_; }
  /// What is left behind both.
  [[nodiscard]] double slow() const noexcept { return slow_; }

 private:
  double mean_ = 0.0;
  double once_ = 0.0;
  double slow_ = 0.0;
};

}  // namespace gyrod::core
