#include "core/simulation/oscillator.hpp"

#include "core/signal/portable_math.hpp"

namespace gyrod::core {

Oscillator::Oscillator(double turns_per_sample, double phase_turns) noexcept {
  const SineCosine step = portable_sine_cosine(turns_per_sample);
  const SineCosine phase = portable_sine_cosine(phase_turns);
  step_sine_ = step.sine;
  step_cosine_ = step.cosine;
  sine_ = phase.sine;
  cosine_ = phase.cosine;
}

double Oscillator::next() noexcept {
  const double now = sine_;
  const double sine = sine_ * step_cosine_ + cosine_ * step_sine_;
  const double cosine = cosine_ * step_cosine_ - sine_ * step_sine_;
  // One Newton step towards 1 / length: the length is off by rounding only.
  const double correction = 1.5 - 0.5 * (sine * sine + cosine * cosine);
  sine_ = sine * correction;
  cosine_ = cosine * correction;
  return now;
}

}  // namespace gyrod::core
