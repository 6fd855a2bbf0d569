/// Elementary functions made of + - * / and bits alone, so that one input gives one output on every machine with IEEE 754 doubles: those of the
/// C library differ in the last place from one version or processor to the next, and what an estimator makes of that is no longer in the last
/// place. All round to nearest, are pure and allocate nothing.
#pragma once

namespace gyrod::core {

/// e^x, relative error below 1e-15; 0 below -708, infinity above 709, NaN of NaN.
[[nodiscard]] double portable_exp(double x) noexcept;

/// Natural logarithm, relative error below 1e-15 away from 1 (absolute near it); -infinity of 0, NaN below it and of NaN.
[[nodiscard]] double portable_log(double x) noexcept;

struct SineCosine {
  double sine = 0.0;
  double cosine = 1.0;
};

/// Sine and cosine of `turns` full turns (2 pi turns radian), error below 1e-15.
/// @pre |turns| < 2^50
[[nodiscard]] SineCosine portable_sine_cosine(double turns) noexcept;

/// The logarithm of a product of many factors, for less than one logarithm each: significands are multiplied, exponents added up. Relative
/// error of the product: 1.2e-16 a factor.
class LogarithmOfProduct {
 public:
  void multiply(double factor) noexcept;
  /// As portable_log of the product, were its range unlimited.
  [[nodiscard]] double value() const noexcept;

 private:
  double significand_ = 1.0;  // 1 <= significand_ < 2, or what is no number
  long long exponent_ = 0;
};

}  // namespace gyrod::core
