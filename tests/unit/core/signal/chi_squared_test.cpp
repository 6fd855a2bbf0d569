// Quantiles against the closed form for two degrees of freedom and the printed tables.
#include "core/signal/chi_squared.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace gyrod {
namespace {

using core::chi_squared_probability;
using core::chi_squared_quantile;

// For 2 degrees of freedom P = 1 - exp(-x/2). Tolerance: the header's.
TEST(ChiSquared, OfTwoDegreesIsExponential) {
  for (const double p : {1e-6, 0.01, 0.15865, 0.5, 0.84135, 0.99, 1.0 - 1e-9}) {
    const double expected = -2.0 * std::log1p(-p);
    EXPECT_NEAR(chi_squared_quantile(p, 2.0), expected, 1e-8 * expected) << p;
    EXPECT_NEAR(chi_squared_probability(expected, 2.0), p, 1e-12);
  }
}

struct TableRow {
  double degrees;
  double at_01, at_025, at_05, at_95, at_975, at_99;
};

// Critical values of the NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.4: three decimals.
TEST(ChiSquared, MeetsThePrintedTable) {
  constexpr TableRow kTable[] = {{1, 0.000, 0.001, 0.004, 3.841, 5.024, 6.635},
                                 {5, 0.554, 0.831, 1.145, 11.070, 12.833, 15.086},
                                 {10, 2.558, 3.247, 3.940, 18.307, 20.483, 23.209},
                                 {30, 14.953, 16.791, 18.493, 43.773, 46.979, 50.892},
                                 {100, 70.065, 74.222, 77.929, 124.342, 129.561, 135.807}};
  for (const TableRow& row : kTable) {
    EXPECT_NEAR(chi_squared_quantile(0.01, row.degrees), row.at_01, 5.1e-4) << row.degrees;
    EXPECT_NEAR(chi_squared_quantile(0.025, row.degrees), row.at_025, 5.1e-4) << row.degrees;
    EXPECT_NEAR(chi_squared_quantile(0.05, row.degrees), row.at_05, 5.1e-4) << row.degrees;
    EXPECT_NEAR(chi_squared_quantile(0.95, row.degrees), row.at_95, 5.1e-4) << row.degrees;
    EXPECT_NEAR(chi_squared_quantile(0.975, row.degrees), row.at_975, 5.1e-4) << row.degrees;
    EXPECT_NEAR(chi_squared_quantile(0.99, row.degrees), row.at_99, 5.1e-4) << row.degrees;
  }
}

TEST(ChiSquared, QuantileInvertsTheProbability) {
  for (const double degrees : {1.0, 1.3, 2.7, 19.5, 333.3, 19'999.0, 20'001.0, 1e6}) {
    for (const double p : {1e-4, 0.025, 0.15865, 0.5, 0.84135, 0.975, 0.9999}) {
      EXPECT_NEAR(chi_squared_probability(chi_squared_quantile(p, degrees), degrees), p, 1e-9) << degrees;
    }
  }
}

// Where the series gives way to the cube root both hold: the header's 1e-6.
TEST(ChiSquared, HasNoStepWhereTheMethodChanges) {
  for (const double p : {1e-4, 0.025, 0.15865, 0.84135, 0.975, 0.9999}) {
    const double below = chi_squared_quantile(p, core::kNormalFromDegrees * (1.0 - 1e-12));
    const double above = chi_squared_quantile(p, core::kNormalFromDegrees);
    EXPECT_NEAR(above / below, 1.0, 1e-6) << p;
  }
}

// Upper percentage points of the chi-squared distribution as any table prints them, to three decimals, which moves the tail by less
// than 1e-4.
TEST(ChiSquaredTail, IsThatOfThePrintedTable) {
  EXPECT_NEAR(core::chi_squared_tail(3.841, 1.0), 0.05, 1e-4);
  EXPECT_NEAR(core::chi_squared_tail(6.635, 1.0), 0.01, 1e-4);
  EXPECT_NEAR(core::chi_squared_tail(18.307, 10.0), 0.05, 1e-4);
  EXPECT_NEAR(core::chi_squared_tail(31.410, 20.0), 0.05, 1e-4);
  EXPECT_NEAR(core::chi_squared_tail(37.566, 20.0), 0.01, 1e-4);
  EXPECT_NEAR(core::chi_squared_tail(43.773, 30.0), 0.05, 1e-4);
  EXPECT_EQ(core::chi_squared_tail(0.0, 5.0), 1.0);
}

// Two degrees of freedom: the tail is exp(-x / 2).
TEST(ChiSquaredTail, OfTwoDegreesIsTheExponential) {
  for (const double x : {0.1, 1.0, 5.0, 40.0})
    EXPECT_NEAR(core::chi_squared_tail(x, 2.0), std::exp(-0.5 * x), 1e-14) << x;
}

// On both sides of the border to Wilson and Hilferty's cube root. Tolerance: near the border both have exp(a ln(x/2) - x/2 - ln Gamma(a)),
// a = degrees / 2, whose terms of 1e5 are rounded to 1e-11.
TEST(ChiSquaredTail, AndProbabilityAddUpToOne) {
  for (const double degrees :
       {1.0, 20.0, 1000.0, 0.99 * core::kNormalFromDegrees, 1.01 * core::kNormalFromDegrees}) {
    for (const double share : {0.5, 0.99, 1.0, 1.01, 1.5}) {
      const double x = share * degrees;
      EXPECT_NEAR(core::chi_squared_tail(x, degrees) + core::chi_squared_probability(x, degrees), 1.0, 1e-10)
          << x;
    }
  }
}

}  // namespace
}  // namespace gyrod
