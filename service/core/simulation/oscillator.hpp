/// A sine wave sample by sample, for as long as one likes.
#pragma once

namespace gyrod::core {

/// Turns a unit phasor by a fixed angle per sample and pulls its length back to 1, so that nothing builds up.
class Oscillator {
 public:
  /// Silent until it is given a frequency.
  Oscillator() = default;
  /// @param turns_per_sample frequency over sample rate, 0..1/2
  /// @param phase_turns -1/2..1/2
  Oscillator(double turns_per_sample, double phase_turns) noexcept;

  /// Sine of the phase, in [-1, 1]; then one sample on.
  [[nodiscard]] double next() noexcept;

 private:
  double step_sine_ = 0.0;
  double step_cosine_ = 1.0;
  double sine_ = 0.0;
  double cosine_ = 1.0;
};

}  // namespace gyrod::core
