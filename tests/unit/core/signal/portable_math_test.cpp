// Elementary functions that are the same on every machine: beside the C library's, which round within a unit in the last place.
#include "core/signal/portable_math.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(PortableMath, ExponentialAgreesWithTheLibrary) {
  for (int n = -51678; n <= 51750; ++n) {
    const double x = 0.0137 * n;
    ASSERT_NEAR(portable_exp(x) / std::exp(x), 1.0, 1e-15) << x;
  }
  for (int n = 0; n < 600; ++n) {
    const double x = std::pow(3.1, -n);
    ASSERT_NEAR(portable_exp(x), std::exp(x), 4e-16) << x;
    ASSERT_NEAR(portable_exp(-x), std::exp(-x), 4e-16) << x;
  }
}

TEST(PortableMath, ExponentialOfAnything) {
  EXPECT_EQ(portable_exp(0.0), 1.0);
  EXPECT_EQ(portable_exp(-709.0), 0.0);
  EXPECT_EQ(portable_exp(-kInfinity), 0.0);
  EXPECT_EQ(portable_exp(710.0), kInfinity);
  EXPECT_EQ(portable_exp(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(portable_exp(std::numeric_limits<double>::quiet_NaN())));
}

TEST(PortableMath, LogarithmAgreesWithTheLibrary) {
  for (int n = -1388; n < 1300; ++n) {
    const double x = std::pow(1.7, n);
    EXPECT_NEAR(portable_log(x), std::log(x), 2e-15 * std::max(1.0, std::abs(std::log(x)))) << x;
  }
  EXPECT_EQ(portable_log(1.0), 0.0);
}

TEST(PortableMath, LogarithmOfAnything) {
  EXPECT_EQ(portable_log(0.0), -kInfinity);
  EXPECT_EQ(portable_log(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(portable_log(-1.0)));
  EXPECT_TRUE(std::isnan(portable_log(std::numeric_limits<double>::quiet_NaN())));
}

TEST(PortableMath, SineAndCosineAgreeWithTheLibrary) {
  for (int n = -5000; n <= 5000; ++n) {
    const double turns = 1e-4 * n;
    const SineCosine both = portable_sine_cosine(turns);
    // 2 pi turns is rounded, which moves the library's by as much.
    ASSERT_NEAR(both.sine, std::sin(2.0 * std::numbers::pi * turns), 1e-15) << turns;
    ASSERT_NEAR(both.cosine, std::cos(2.0 * std::numbers::pi * turns), 1e-15) << turns;
  }
}

TEST(PortableMath, WholeAndHalfTurnsAreExact) {
  for (const double turns : {-3.0, -1.0, 0.0, 2.0, 1e6}) {
    EXPECT_EQ(portable_sine_cosine(turns).cosine, 1.0) << turns;
    EXPECT_EQ(portable_sine_cosine(turns).sine, 0.0) << turns;
    EXPECT_EQ(portable_sine_cosine(turns + 0.25).sine, 1.0) << turns;
    EXPECT_EQ(portable_sine_cosine(turns + 0.5).cosine, -1.0) << turns;
    EXPECT_EQ(portable_sine_cosine(turns + 0.75).sine, -1.0) << turns;
  }
  // Many turns: only what is beyond whole ones counts, and 2^-30 is exact.
  EXPECT_EQ(portable_sine_cosine(1e6 + 0x1p-30).sine, portable_sine_cosine(0x1p-30).sine);
}

TEST(PortableMath, LogarithmOfAProductIsTheSumOfLogarithms) {
  LogarithmOfProduct product;
  double sum = 0.0;
  std::uint64_t state = 1;
  for (int n = 0; n < 2000; ++n) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    const double factor =
        std::ldexp(1.0 + static_cast<double>(state >> 12U) * 0x1p-52, static_cast<int>(state % 1900) - 950);
    product.multiply(factor);
    sum += std::log(factor);
  }
  EXPECT_NEAR(product.value(), sum, 1e-11 * std::abs(sum));
}

TEST(PortableMath, ProductsOfExtremesNeitherOverflowNorVanish) {
  for (const double factor : {1e-310, 5e-324, 1.7e308}) {
    LogarithmOfProduct product;
    for (int n = 0; n < 100; ++n) product.multiply(factor);
    EXPECT_NEAR(product.value() / (100.0 * std::log(factor)), 1.0, 1e-14) << factor;
  }
  LogarithmOfProduct nothing;
  EXPECT_EQ(nothing.value(), 0.0);
  nothing.multiply(0.0);
  EXPECT_EQ(nothing.value(), -kInfinity);
}

// GCC and Clang agree on this number, without optimisation, with all of it for the processor at hand, and with the C library told that there is
// no FMA, which changes its own functions.
TEST(PortableMath, BitsAreTheseOnEveryMachine) {
  std::uint64_t hash = 14695981039346656037U;
  const auto add = [&hash](double x) { hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 1099511628211U; };
  for (int n = -5000; n < 5000; ++n) {
    const double x = static_cast<double>(n) * 0x1.3c6ef372fe95p-3;
    add(portable_exp(x));
    add(portable_log(std::abs(x) + 0x1p-20));
    const SineCosine both = portable_sine_cosine(x);
    add(both.sine);
    add(both.cosine);
  }
  EXPECT_EQ(hash, 16756014072798892387U);
}

}  // namespace
}  // namespace gyrod::core
