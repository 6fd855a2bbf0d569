/// Elementary functions made of + - * / alone, so that they give the same bits on every machine with IEEE 754
/// doubles; those of the C library may differ in the last place from one version or CPU to the next. For the
/// simulator only: std's are faster. Pure, allocate nothing.
#pragma once

namespace gyrod::core {

/// Natural logarithm, relative error below 1e-15 away from 1 (absolute near it).
/// @pre x finite, normal and above 0
[[nodiscard]] double portable_log(double x) noexcept;

struct SineCosine {
  double sine = 0.0;
  double cosine = 1.0;
};

/// Sine and cosine of `turns` full turns (2 pi turns radian), error below 1e-14.
/// @pre |turns| <= 1/2
[[nodiscard]] SineCosine portable_sine_cosine(double turns) noexcept;

}  // namespace gyrod::core
