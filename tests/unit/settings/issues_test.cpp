// What is said about a wrong configuration, word for word.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "settings/load.hpp"

namespace gyrod::settings {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;

std::vector<std::string> messages(const std::string& text) {
  std::vector<std::string> lines;
  for (const SettingsIssue& issue : read_settings(text, ".").issues) lines.push_back(issue.message);
  return lines;
}

TEST(SettingsIssues, AnEmptyObjectAndCommentsAndAByteOrderMarkAreFine) {
  EXPECT_THAT(messages("{}"), IsEmpty());
  EXPECT_THAT(messages("// a\n{ /* b */ \"workers\": 1 // c\n}"), IsEmpty());
  EXPECT_THAT(messages("\xEF\xBB\xBF{}"), IsEmpty());
}

TEST(SettingsIssues, AValueOutOfRangeComesWithKeyValueRangeAndUnit) {
  const Outcome outcome = read_settings(R"({"denoise": {"hop_samples": 0}})", ".");
  ASSERT_EQ(outcome.issues.size(), 1U);
  EXPECT_EQ(outcome.issues[0].key, "denoise.hop_samples");
  EXPECT_EQ(outcome.issues[0].value, "0");
  EXPECT_EQ(outcome.issues[0].expected, "an integer from 1 to 32768 (samples)");
  EXPECT_EQ(outcome.issues[0].message,
            "denoise.hop_samples is 0; expected an integer from 1 to 32768 (samples)");
}

TEST(SettingsIssues, AWrongTypeIsNamedWithWhatWasExpected) {
  EXPECT_THAT(messages(R"({"workers": "two"})"),
              ElementsAre("workers is \"two\"; expected an integer from 0 to 256 (threads)"));
  EXPECT_THAT(messages(R"({"workers": 1.5})"),
              ElementsAre("workers is 1.5; expected an integer from 0 to 256 (threads)"));
  EXPECT_THAT(messages(R"({"workers": null})"),
              ElementsAre("workers is null; expected an integer from 0 to 256 (threads)"));
  EXPECT_THAT(messages(R"({"monitor": {"enabled": 1}})"),
              ElementsAre("monitor.enabled is 1; expected true or false"));
  EXPECT_THAT(messages(R"({"monitor": []})"), ElementsAre("monitor is []; expected an object"));
  EXPECT_THAT(messages(R"({"bus": {"topics": {"raw": ""}}})"),
              ElementsAre("bus.topics.raw is \"\"; expected a text of 1 to 200 characters"));
  EXPECT_THAT(messages(R"({"denoise": {"sample_rate_hz": -1}})"),
              ElementsAre("denoise.sample_rate_hz is -1; expected a number from 0 to 100000 (Hz)"));
}

TEST(SettingsIssues, ScreeningBySignificanceNeedsTheEmdOfItsNoiseLine) {
  EXPECT_THAT(messages(R"({"denoise": {"screening": "significance"}})"), IsEmpty());
  EXPECT_THAT(messages(R"({"denoise": {"screening": "windowed", "sifts": 8, "boundary": "linear"}})"),
              IsEmpty());
  const std::string why = ", for which alone denoise.screening \"significance\" has its noise line";
  EXPECT_THAT(messages(R"({"denoise": {"screening": "significance", "sifts": 8, "boundary": "linear"}})"),
              ElementsAre("denoise.sifts is 8; expected 10" + why,
                          "denoise.boundary is \"linear\"; expected \"mirror\"" + why));
}

TEST(SettingsIssues, AWrongNameOfAnEnumerationComesWithTheRightOnes) {
  EXPECT_THAT(messages(R"({"denoise": {"boundary": "Mirror"}})"),
              ElementsAre("denoise.boundary is \"Mirror\"; expected \"mirror\" or \"linear\""));
}

TEST(SettingsIssues, AnUnknownKeyComesWithTheNearestKnownOne) {
  EXPECT_THAT(messages(R"({"denoise": {"hop_sample": 32}})"),
              ElementsAre("unknown key denoise.hop_sample; did you mean hop_samples?"));
  EXPECT_THAT(messages(R"({"denose": {}})"), ElementsAre("unknown key denose; did you mean denoise?"));
}

TEST(SettingsIssues, AnUnknownKeyThatLacksItsUnitComesWithTheWholeOne) {
  EXPECT_THAT(messages(R"({"denoise": {"window": 512}})"),
              ElementsAre("unknown key denoise.window; did you mean window_samples?"));
}

TEST(SettingsIssues, AnUnknownKeyFarFromAllComesWithThoseThatThereAre) {
  EXPECT_THAT(messages(R"({"noise": {"axis": 3}})"),
              ElementsAre("unknown key noise.axis; expected one of calibrations, source, state_file"));
  EXPECT_THAT(messages(R"({"kalman": {}})"),
              ElementsAre(StartsWith("unknown key kalman; expected one of bus, denoise, ")));
}

TEST(SettingsIssues, ARepeatedKeyIsAnError) {
  EXPECT_THAT(messages(R"({"denoise": {"sifts": 10, "sifts": 10}})"),
              ElementsAre("denoise.sifts is given more than once; expected each key once"));
}

TEST(SettingsIssues, BadSyntaxComesWithLineColumnAndExpectation) {
  EXPECT_THAT(messages("{\n  \"workers\": 1,\n}"),
              ElementsAre(AllOf(StartsWith("line 3, column 1: "),
                                HasSubstr("unexpected '}'; expected string literal"))));
  EXPECT_THAT(messages("{\"workers\" 1}"),
              ElementsAre(AllOf(StartsWith("line 1, column 12: "), HasSubstr("expected ':'"))));
  EXPECT_THAT(messages("{\"workers\": 1} x"),
              ElementsAre(AllOf(StartsWith("line 1, column 16: "), HasSubstr("expected end"))));
}

TEST(SettingsIssues, TheExpectationOfBadSyntaxIsAFieldOfItsOwn) {
  const Outcome outcome = read_settings("{\"workers\" 1}", ".");
  ASSERT_EQ(outcome.issues.size(), 1U);
  EXPECT_EQ(outcome.issues[0].expected, "':'");
}

TEST(SettingsIssues, ALimitThatDependsOnAnotherKeyNamesIt) {
  EXPECT_THAT(
      messages(R"({"denoise": {"window_samples": 128, "hop_samples": 65, "lag_samples": 33},
                           "limits": {"max_hop_samples": 65, "max_bridged_samples": 33}})"),
      ElementsAre(
          "denoise.hop_samples is 65; expected at most half of denoise.window_samples (64)",
          "denoise.lag_samples is 33; expected at most a quarter of denoise.window_samples (32)",
          "limits.max_bridged_samples is 33; expected at most a quarter of denoise.window_samples (32)"));
  EXPECT_THAT(messages(R"({"denoise": {"hop_samples": 100}, "limits": {"max_hop_samples": 99}})"),
              ElementsAre("limits.max_hop_samples is 99; expected from denoise.hop_samples (100) to half of "
                          "denoise.window_samples (512)"));
  EXPECT_THAT(messages(R"({"bus": {"input": {"max_sensors": 1000}}})"),
              ElementsAre("bus.input.max_sensors is 1000; expected at least limits.max_channels (1024)"));
}

TEST(SettingsIssues, ADefaultThatNoLongerFitsIsCalledOne) {
  EXPECT_THAT(
      messages(R"({"limits": {"max_channels": 100000}})"),
      ElementsAre(
          "bus.input.max_sensors is 65536 (the default); expected at least limits.max_channels (100000)"));
}

TEST(SettingsIssues, HowFarTheHopWidensFollowsTheWindowWhereItIsNotSaid) {
  const auto widest = [](const char* text) {
    const Outcome outcome = read_settings(text, ".");
    EXPECT_THAT(outcome.issues, IsEmpty()) << text;
    return outcome.settings.engine.max_hop_samples;
  };
  EXPECT_EQ(widest("{}"), 256U);
  EXPECT_EQ(widest(R"({"denoise": {"window_samples": 256}})"), 128U);
  EXPECT_EQ(widest(R"({"denoise": {"window_samples": 4096, "hop_samples": 512}})"), 512U);
  EXPECT_THAT(messages(R"({"denoise": {"window_samples": 256}, "limits": {"max_hop_samples": 256}})"),
              ElementsAre("limits.max_hop_samples is 256; expected from denoise.hop_samples (32) to half of "
                          "denoise.window_samples (128)"));
}

TEST(SettingsIssues, LimitsThatDependOnAnotherKeyAreMetWithEquality) {
  EXPECT_THAT(messages(R"({"denoise": {"window_samples": 64, "hop_samples": 32, "lag_samples": 16},
                           "limits": {"max_hop_samples": 32, "max_bridged_samples": 16}})"),
              IsEmpty());
}

TEST(SettingsIssues, AModelMethodLooksNoFurtherAheadThanItsFiltersCarry) {
  const std::string lag = "denoise.lag_samples is 33; expected at most 32 where denoise.method is \"joint\"";
  EXPECT_THAT(messages(R"({"denoise": {"method": "joint", "lag_samples": 33}})"), Contains(lag));
  EXPECT_THAT(messages(R"({"denoise": {"method": "joint", "lag_samples": 32}})"), Not(Contains(lag)));
  EXPECT_THAT(messages(R"({"denoise": {"method": "paper", "lag_samples": 33}})"), IsEmpty());
  EXPECT_THAT(messages(R"({"denoise": {"lag_samples": 33}})"), Contains(lag)) << "joint is the default";
}

TEST(SettingsIssues, NobodyIsForgottenBeforeBeingSilent) {
  EXPECT_THAT(
      messages(R"({"limits": {"silent_after_s": 10, "forget_after_s": 9.5}})"),
      ElementsAre("limits.forget_after_s is 9.5; expected 0, or at least limits.silent_after_s (10)"));
  EXPECT_THAT(messages(R"({"limits": {"silent_after_s": 10, "forget_after_s": 0}})"), IsEmpty());
  EXPECT_THAT(messages(R"({"limits": {"silent_after_s": 10, "forget_after_s": 10}})"), IsEmpty());
}

TEST(SettingsIssues, TopicsHaveToDifferAndToBeNames) {
  EXPECT_THAT(
      messages(R"({"bus": {"topics": {"denoised": "gyro/raw"}}})"),
      ElementsAre(
          "bus.topics.denoised is \"gyro/raw\"; expected a name of its own, not that of bus.topics.raw"));
  EXPECT_THAT(messages(R"({"bus": {"topics": {"noise": "my noise"}}})"),
              ElementsAre("bus.topics.noise is \"my noise\"; expected letters, digits, '_' and '/', not "
                          "starting with a digit"));
}

TEST(SettingsIssues, AllErrorsOfAllKindsAreReportedTogether) {
  EXPECT_THAT(
      messages(
          R"({"bus": {"domain": 231, "input": {"max_sensors": 1}}, "denoise": {"lag_samples": 257, "sift": 3},
                           "workers": -1, "stop": {"deadline_s": "5"}, "log": {"level": "info", "level": "debug"}})"),
      UnorderedElementsAre(
          "bus.domain is 231; expected an integer from 0 to 230",
          "bus.input.max_sensors is 1; expected at least limits.max_channels (1024)",
          "denoise.lag_samples is 257; expected at most a quarter of denoise.window_samples (256)",
          "unknown key denoise.sift; did you mean sifts?",
          "workers is -1; expected an integer from 0 to 256 (threads)",
          "stop.deadline_s is \"5\"; expected a number from 0 to 3600 (s)",
          "log.level is given more than once; expected each key once"));
}

TEST(SettingsIssues, IssuesComeInTheOrderOfTheTextAndDefaultsLast) {
  EXPECT_THAT(messages(R"({"workers": -1, "log": {"loud": 1}, "bus": {"domain": -1},
                           "limits": {"max_channels": 100000}, "another": 2})"),
              ElementsAre(StartsWith("workers"), StartsWith("unknown key log.loud"), StartsWith("bus.domain"),
                          StartsWith("unknown key another"), StartsWith("bus.input.max_sensors")));
}

TEST(SettingsIssues, AKeyThatIsWrongByItselfIsNotComparedWithOthers) {
  EXPECT_THAT(
      messages(R"({"denoise": {"window_samples": "long", "hop_samples": 600}})"),
      ElementsAre("denoise.window_samples is \"long\"; expected an integer from 64 to 65536 (samples)"));
}

}  // namespace
}  // namespace gyrod::settings
