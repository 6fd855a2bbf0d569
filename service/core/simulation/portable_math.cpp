#include "core/simulation/portable_math.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace gyrod::core {

// x = m 2^e with m in [1/sqrt 2, sqrt 2), and ln m = 2 artanh s = 2 (s + s^3/3 + s^5/5 + ...) with s =
// (m-1)/(m+1).
double portable_log(double x) noexcept {
  assert(std::isnormal(x) && x > 0.0);
  constexpr int kTerms = 12;  // |s| <= 0.172: the next one is below 1e-18
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // exact
  if (m < 1.0 / std::numbers::sqrt2) {
    m *= 2.0;
    --exponent;
  }
  const double s = (m - 1.0) / (m + 1.0);
  double sum = 0.0;
  for (int k = kTerms - 1; k >= 0; --k) sum = sum * s * s + 1.0 / (2.0 * k + 1.0);
  return 2.0 * s * sum + static_cast<double>(exponent) * std::numbers::ln2;
}

// Taylor series in Horner form: x (1 - x^2/(2 3) (1 - x^2/(4 5) (1 - ...))), and the same from 1 for the
// cosine.
SineCosine portable_sine_cosine(double turns) noexcept {
  assert(std::abs(turns) <= 0.5);
  constexpr int kTerms = 16;  // |x| <= pi: the next one is below 1e-18
  const double x = 2.0 * std::numbers::pi * turns;
  double sine = 1.0;
  double cosine = 1.0;
  for (int k = kTerms; k >= 1; --k) {
    sine = 1.0 - sine * x * x / (2.0 * k * (2.0 * k + 1.0));
    cosine = 1.0 - cosine * x * x / (2.0 * k * (2.0 * k - 1.0));
  }
  return {x * sine, cosine};
}

}  // namespace gyrod::core
