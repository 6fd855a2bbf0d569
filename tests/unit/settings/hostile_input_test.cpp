// Files that nobody writes by hand: an error, never a crash or a hang.
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "settings/load.hpp"
#include "support/slow_build.hpp"

namespace gyrod::settings {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

constexpr std::size_t kMegabyte = 1'000'000;

std::string only_message(const std::string& text) {
  const Outcome outcome = read_settings(text, ".");
  EXPECT_THAT(outcome.issues, SizeIs(1));
  return outcome.issues.empty() ? "" : outcome.issues.front().message;
}

TEST(HostileInput, AnEmptyFileIsAnError) {
  EXPECT_EQ(only_message(""),
            "line 1, column 1: syntax error while parsing value - unexpected end of input; expected '[', "
            "'{', or a literal");
  EXPECT_THAT(only_message("\xEF\xBB\xBF"), HasSubstr("unexpected end of input"));
}

TEST(HostileInput, AnotherRootThanAnObjectIsAnError) {
  EXPECT_EQ(only_message("[1, 2]"), "the whole file is [1,2]; expected an object");
  EXPECT_EQ(only_message("null"), "the whole file is null; expected an object");
  EXPECT_EQ(only_message("\"text\""), "the whole file is \"text\"; expected an object");
}

TEST(HostileInput, DeepNestingIsAnErrorWhetherItIsClosedOrNot) {
  const std::string open(kMegabyte, '[');
  EXPECT_EQ(only_message(open), "nested deeper than 16 levels");
  EXPECT_EQ(only_message(open + std::string(kMegabyte, ']')), "nested deeper than 16 levels");
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += "{\"bus\":";
  EXPECT_EQ(only_message(objects), "nested deeper than 16 levels");
}

TEST(HostileInput, ANumberTooLargeForADoubleIsAnError) {
  EXPECT_EQ(only_message("{\"workers\":\n 1e999}"), "line 2, column 6: number overflow parsing '1e999'");
}

TEST(HostileInput, IntegersBeyondTheMachinesAreOutOfRangeAndNeverWrapAround) {
  for (const char* number : {"9223372036854775808", "18446744073709551615", "18446744073709551617",
                             "-9223372036854775809", "4294967297", "1e300", "-0.5", "1e-400"}) {
    const std::string message = only_message("{\"workers\": " + std::string(number) + "}");
    EXPECT_THAT(message, HasSubstr("; expected an integer from 0 to 256 (threads)")) << number;
  }
}

TEST(HostileInput, ALongValueIsShortened) {
  const std::string message = only_message("{\"log\": {\"level\": \"" + std::string(kMegabyte, 'x') + "\"}}");
  EXPECT_LT(message.size(), 300U);
  EXPECT_THAT(only_message("{\"" + std::string(kMegabyte, 'k') + "\": 1}"), SizeIs(::testing::Lt(400U)));
  EXPECT_THAT(only_message("{\"a\": \"" + std::string(kMegabyte, 'x')), SizeIs(::testing::Lt(400U)));
}

TEST(HostileInput, MessagesHoldPrintableCharactersOnly) {
  for (const std::string text : {"{\"\x1b[31m\": 1}", "{\"\\u001b[31m\\u0000\": 1}", "\xFF\xFE{",
                                 "{\"a\": \"\xC3\x28\"}", "{\"log\": {\"level\": \"\\u001b[31m\\u00e9\"}}"}) {
    for (const char c : only_message(text)) EXPECT_TRUE(c >= ' ' && c <= '~') << text;
  }
}

TEST(HostileInput, AMegabyteOfGarbageIsAnError) {
  std::mt19937 random(20'251'121);
  for (int round = 0; round < 20; ++round) {
    std::string text(kMegabyte, '\0');
    for (char& c : text) c = static_cast<char>(random());
    EXPECT_FALSE(read_settings(text, ".").issues.empty());
  }
}

TEST(HostileInput, AMegabyteOfUnknownKeysIsReportedKeyByKey) {
  std::string text = "{";
  std::size_t keys = 0;
  constexpr std::size_t kSize = gyrod::testing::kSlowBuild ? kMegabyte / 8 : kMegabyte;
  for (; text.size() < kSize; ++keys) text += "\"x" + std::to_string(keys) + "\":0,";
  text.back() = '}';
  EXPECT_THAT(read_settings(text, ".").issues, SizeIs(keys));
}

TEST(HostileInput, EveryTruncationAndEveryChangedByteOfAGoodFileIsGoodOrAnError) {
  const std::string good =
      R"({"bus": {"domain": 3, "topics": {"raw": "a"}}, "workers": 2, "stop": {"deadline_s": 1e0}})";
  ASSERT_TRUE(read_settings(good, ".").issues.empty());
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_FALSE(read_settings(good.substr(0, size), ".").issues.empty()) << size;
  }
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const char c : {'\0', '"', '{', '}', ',', '\\', '9', '\x80'}) {
      std::string changed = good;
      changed[i] = c;
      (void)read_settings(changed, ".");  // must return
    }
  }
}

}  // namespace
}  // namespace gyrod::settings
