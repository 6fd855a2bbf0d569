#include "files/rate_unit.hpp"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

namespace gyrod::files {
namespace {

constexpr RateUnit kAll[] = {RateUnit::kRadps, RateUnit::kMradps, RateUnit::kDps, RateUnit::kMdps,
                             RateUnit::kDph};

TEST(RateUnit, EverySpellingNamesItsUnit) {
  for (const RateUnit unit : kAll) EXPECT_EQ(rate_unit_of(spelling_of(unit)), unit);
  for (const char* text : {"dps", "degps", "deg_s", "deg/s"})
    EXPECT_EQ(rate_unit_of(text), RateUnit::kDps) << text;
  for (const char* text : {"radps", "rad_s", "rad/s"})
    EXPECT_EQ(rate_unit_of(text), RateUnit::kRadps) << text;
  for (const char* text : {"", "foo", "DPS", "rpm"}) EXPECT_EQ(rate_unit_of(text), std::nullopt) << text;
}

TEST(RateUnit, ConvertsByTheDefinitionOfTheUnit) {
  // A turn in a second is 2 pi rad/s; 4 ulp of 6.28 for the two roundings of a product of rounded factors.
  constexpr double kTurn = 6.283185307179586;
  EXPECT_DOUBLE_EQ(to_radps(kTurn, RateUnit::kRadps), kTurn);
  EXPECT_DOUBLE_EQ(to_radps(kTurn * 1000.0, RateUnit::kMradps), kTurn);
  EXPECT_DOUBLE_EQ(to_radps(360.0, RateUnit::kDps), kTurn);
  EXPECT_DOUBLE_EQ(to_radps(360'000.0, RateUnit::kMdps), kTurn);
  EXPECT_DOUBLE_EQ(to_radps(360.0 * 3600.0, RateUnit::kDph), kTurn);
}

TEST(RateUnit, ComesBackToTwoUnitsInTheLastPlace) {
  constexpr double kTwoUlp = 2.0 * 2.220446049250313e-16;
  for (const RateUnit unit : kAll) {
    for (int i = -1000; i <= 1000; ++i) {
      const double value = 0.05 * i;
      EXPECT_LE(std::abs(from_radps(to_radps(value, unit), unit) - value), kTwoUlp * std::abs(value));
    }
  }
}

TEST(RateUnit, RadiansPerSecondAreUntouched) {
  EXPECT_EQ(to_radps(0.1, RateUnit::kRadps), 0.1);
  EXPECT_EQ(from_radps(0.1, RateUnit::kRadps), 0.1);
}

}  // namespace
}  // namespace gyrod::files
