#include "files/number_text.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace gyrod::files {
namespace {

constexpr int kSeconds = 9;
constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();

TEST(ParseRate, TakesPlainSignedAndExponentNumbers) {
  EXPECT_EQ(parse_rate("-0.05"), -0.05);
  EXPECT_EQ(parse_rate("+1.5"), 1.5);
  EXPECT_EQ(parse_rate("1e-3"), 1e-3);
}

TEST(ParseRate, EmptyAndNanAndInfAreValues) {
  EXPECT_TRUE(std::isnan(parse_rate("").value()));
  EXPECT_TRUE(std::isnan(parse_rate("NaN").value()));
  EXPECT_EQ(parse_rate("-inf"), -std::numeric_limits<double>::infinity());
}

TEST(ParseRate, RefusesWhatIsNoNumber) {
  for (const char* text : {"abc", "1.5x", "1,5", "+-1", "0x10", "--1", "1e400", "-", "+"}) {
    EXPECT_EQ(parse_rate(text), std::nullopt) << text;
  }
}

TEST(ParseStamp, MovesThePointWithoutRounding) {
  // As a double this stamp would be off by up to 119 ns: half of the 2^-22 s between doubles of that size.
  EXPECT_EQ(parse_stamp_ns("1700000000.123456789", kSeconds), 1'700'000'000'123'456'789);
  EXPECT_EQ(parse_stamp_ns("0.010000", kSeconds), 10'000'000);
  EXPECT_EQ(parse_stamp_ns("12.5", 6), 12'500'000);
  EXPECT_EQ(parse_stamp_ns("12", 3), 12'000);
  EXPECT_EQ(parse_stamp_ns("9223372036854775807", 0), kLargest);
}

TEST(ParseStamp, TakesSignsExponentsAndBarePoints) {
  EXPECT_EQ(parse_stamp_ns("-0.5", kSeconds), -500'000'000);
  EXPECT_EQ(parse_stamp_ns("+.5", kSeconds), 500'000'000);
  EXPECT_EQ(parse_stamp_ns("5.", kSeconds), 5'000'000'000);
  EXPECT_EQ(parse_stamp_ns("1.5e9", 0), 1'500'000'000);
  EXPECT_EQ(parse_stamp_ns("15E-1", kSeconds), 1'500'000'000);
  EXPECT_EQ(parse_stamp_ns("0e300", kSeconds), 0);
}

TEST(ParseStamp, RoundsDigitsBelowANanosecondHalfAwayFromZero) {
  EXPECT_EQ(parse_stamp_ns("0.0000000014999", kSeconds), 1);
  EXPECT_EQ(parse_stamp_ns("0.0000000015", kSeconds), 2);
  EXPECT_EQ(parse_stamp_ns("-0.0000000015", kSeconds), -2);
  EXPECT_EQ(parse_stamp_ns("1e-300", kSeconds), 0);
}

TEST(ParseStamp, RefusesWhatIsNoTimeOrBeyond64Bits) {
  for (const char* text :
       {"", "-", "nan", "inf", ".", "1.2.3", "1e", "12:30", "9223372037", "1e300", "1e99999999999"}) {
    EXPECT_EQ(parse_stamp_ns(text, kSeconds), std::nullopt) << text;
  }
  EXPECT_EQ(parse_stamp_ns("9223372036854775808", 0), std::nullopt);
}

TEST(ParseSequence, TakesWholeNumbersOnly) {
  EXPECT_EQ(parse_sequence("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(parse_sequence("12.0"), 12U);
  for (const char* text : {"", "-1", "1.5", "18446744073709551616", "x", ".0", "nan"}) {
    EXPECT_EQ(parse_sequence(text), std::nullopt) << text;
  }
}

TEST(AppendNumber, WritesTheShortestTextThatReadsBack) {
  std::string text;
  append_number(text, 0.1);
  text += ' ';
  append_number(text, std::numeric_limits<std::int64_t>::min());
  text += ' ';
  append_number(text, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(text, "0.1 -9223372036854775808 nan");
}

TEST(AppendNumber, EveryDoubleReadsBackBitForBit) {
  std::mt19937_64 bits(1);  // uniform over bit patterns: all magnitudes, denormals among them
  for (int i = 0; i < 100'000; ++i) {
    const auto value = std::bit_cast<double>(bits());
    if (!std::isfinite(value)) continue;
    std::string text;
    append_number(text, value);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(parse_rate(text).value()), std::bit_cast<std::uint64_t>(value))
        << text;
  }
}

}  // namespace
}  // namespace gyrod::files
