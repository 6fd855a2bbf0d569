#include "core/signal/portable_math.hpp"

#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace gyrod::core {
namespace {

constexpr int kSignificandBits = 52;
constexpr std::int64_t kExponentBias = 1023;
/// What is added to a double below 2^50 and taken off again leaves the nearest whole number, whatever the processor's way to round.
constexpr double kRound = 0x1.8p52;

double nearest(double x) noexcept { return (x + kRound) - kRound; }

/// 2^exponent. @pre a normal number
double power_of_two(std::int64_t exponent) noexcept {
  return std::bit_cast<double>((exponent + kExponentBias) << kSignificandBits);
}

/// A normal number's exponent, and the number over 2^exponent, which is 1 to 2.
std::int64_t exponent_of(double x) noexcept {
  return (std::bit_cast<std::int64_t>(x) >> kSignificandBits) - kExponentBias;
}
double significand_of(double x) noexcept {
  constexpr std::int64_t kSignificand = (std::int64_t{1} << kSignificandBits) - 1;
  return std::bit_cast<double>((std::bit_cast<std::int64_t>(x) & kSignificand) |
                               (kExponentBias << kSignificandBits));
}

/// 1 / n!
constexpr std::array<double, 14> inverse_factorials() noexcept {
  std::array<double, 14> terms{1.0};
  double factorial = 1.0;
  for (std::size_t n = 1; n < terms.size(); ++n) terms[n] = 1.0 / (factorial *= static_cast<double>(n));
  return terms;
}

}  // namespace

// x = k ln 2 + r, |r| <= ln 2 / 2, and e^r by its Taylor series: the next term is below 5e-18. In pairs (Estrin), as sums that wait for one another
// take most of the time.
double portable_exp(double x) noexcept {
  constexpr double kLeast = -708.0;
  constexpr double kMost = 709.0;
  // A part of ln 2, with zeros at its end: a whole number below 2^11 times it is exact.
  constexpr double kLn2High = 0x1.62e42feep-1;  // NOLINT(modernize-use-std-numbers)
  constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
  static constexpr std::array<double, 14> kTerm = inverse_factorials();
  if (!(x >= kLeast)) return std::isnan(x) ? x : 0.0;
  if (x > kMost) return std::numeric_limits<double>::infinity();
  const double k = nearest(x * std::numbers::log2e);
  const double r = (x - k * kLn2High) - k * kLn2Low;
  const double r2 = r * r;
  const double r4 = r2 * r2;
  const auto pair = [r](std::size_t n) { return kTerm[n] + kTerm[n + 1] * r; };
  const double low = pair(0) + pair(2) * r2;
  const double middle = pair(4) + pair(6) * r2;
  const double high = (pair(8) + pair(10) * r2) + pair(12) * r4;
  return (low + (middle + high * r4) * r4) * power_of_two(static_cast<std::int64_t>(k));
}

// x = m 2^e with m in [1/sqrt 2, sqrt 2), and ln m = 2 artanh s = 2 (s + s^3/3 + s^5/5 + ...) with s =
// (m-1)/(m+1).
double portable_log(double x) noexcept {
  constexpr int kTerms = 12;           // |s| <= 0.172: the next one is below 1e-18
  constexpr double kSubnormal = 54.0;  // bits by which a subnormal number is made a normal one
  if (!(x > 0.0))
    return x == 0.0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(x)) return x;
  if (!std::isnormal(x)) return portable_log(x * 0x1p54) - kSubnormal * std::numbers::ln2;
  double m = significand_of(x);
  std::int64_t exponent = exponent_of(x);
  if (m >= std::numbers::sqrt2) {
    m *= 0.5;
    ++exponent;
  }
  const double s = (m - 1.0) / (m + 1.0);
  double sum = 0.0;
  for (int k = kTerms - 1; k >= 0; --k) sum = sum * (s * s) + 1.0 / (2.0 * k + 1.0);
  return 2.0 * s * sum + static_cast<double>(exponent) * std::numbers::ln2;
}

// A turn is a whole number of quarters, which exchange sine and cosine, and an eighth at the most. Of that, Taylor series in Horner form:
// x (1 - x^2/(2 3) (1 - x^2/(4 5) (1 - ...))), and the same from 1 for the cosine.
SineCosine portable_sine_cosine(double turns) noexcept {
  assert(std::abs(turns) < 0x1p50);
  constexpr int kTerms = 9;  // |x| <= pi / 4: the next one is below 2e-19
  const double quarters = nearest(4.0 * turns);
  const double x = 2.0 * std::numbers::pi * (turns - 0.25 * quarters);
  const double x2 = x * x;
  double sine = 1.0;
  double cosine = 1.0;
  for (int k = kTerms; k >= 1; --k) {
    sine = 1.0 - sine * (x2 * (1.0 / (2.0 * k * (2.0 * k + 1.0))));
    cosine = 1.0 - cosine * (x2 * (1.0 / (2.0 * k * (2.0 * k - 1.0))));
  }
  sine *= x;
  switch (static_cast<std::int64_t>(quarters) & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

void LogarithmOfProduct::multiply(double factor) noexcept {
  const double product = significand_ * factor;
  if (product > 0.0 && std::isnormal(product)) {
    exponent_ += exponent_of(product);
    significand_ = significand_of(product);
    return;
  }
  // Beyond a double's normal range, if it is a number at all.
  const int shift = factor < 1.0 ? 64 : -64;
  significand_ = std::isfinite(factor) ? significand_ * std::ldexp(factor, shift) : product;
  if (significand_ > 0.0 && std::isnormal(significand_)) {
    exponent_ += exponent_of(significand_) - shift;
    significand_ = significand_of(significand_);
  }
}

double LogarithmOfProduct::value() const noexcept {
  return portable_log(significand_) + static_cast<double>(exponent_) * std::numbers::ln2;
}

}  // namespace gyrod::core
