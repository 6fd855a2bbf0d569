#include "report/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/axis_report.hpp"
#include "unit/report/noise.hpp"

namespace gyrod::report {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Sections of an axis as far as the summary reads them.
Json axis(double raw, double direct, double emd, double improved) {
  Json rows = Json::array();
  Json chosen = Json::array();
  const auto add = [&](const char* scheme, double deviation) {
    rows.push_back(Json{{"scheme", scheme}, {"std_dps", deviation}, {"snr_db", nullptr}});
    chosen.push_back(Json{{"scheme", scheme}, {"deviation_dps", {deviation / 2.0}}});
  };
  add("raw", raw);
  add("direct", direct);
  add("emd", emd);
  add("improved", improved);
  Json imfs = Json::array();
  for (const double period : {0.03, 0.06, 0.125, 8.0}) imfs.push_back(Json{{"mean_period_s", period}});
  return Json{{"decomposition", {{"j", 2}, {"k", 3}, {"imfs", imfs}}},
              {"table5", {{"rows", rows}}},
              {"allan", {{"chosen_tau_s", {0.1}}, {"chosen", chosen}}}};
}

TEST(Summary, GivesTheChangeAndTheFrequenciesThatAreDroppedFilteredAndKept) {
  const Json rows = summary_rows(Json{{"x", axis(0.4, 0.3, 0.2, 0.1)}}, true);
  EXPECT_DOUBLE_EQ(rows.at(0).at("std_ratio"), 0.25);
  EXPECT_EQ(rows.at(0).at("dropped_hz"), "from 17 up");
  EXPECT_EQ(rows.at(0).at("filtered_hz"), "8.0");
  EXPECT_EQ(rows.at(0).at("kept_hz"), "up to 0.12");
}

TEST(Summary, SaysThatImprovedIsBestOrWhereItIsNot) {
  const Json good{{"x", axis(0.4, 0.3, 0.2, 0.1)}};
  EXPECT_THAT(summary_sentences(good, true), Contains(HasSubstr("improved is best on every axis")));
  const Json bad{{"x", axis(0.4, 0.3, 0.2, 0.1)}, {"y", axis(0.4, 0.05, 0.2, 0.1)}};
  EXPECT_THAT(summary_sentences(bad, true),
              Contains(HasSubstr(
                  "not the best of the paper's schemes (raw, direct, emd, improved) everywhere. "
                  "y: standard deviation (best: direct); y: Allan deviation at 0.1 s (best: direct).")));
}

TEST(Summary, GivesTheRangeOverTheAxes) {
  const Json axes{{"x", axis(0.4, 0.3, 0.2, 0.1)}, {"y", axis(0.4, 0.3, 0.2, 0.06)}};
  EXPECT_THAT(summary_sentences(axes, true),
              Contains(HasSubstr("standard deviation 75 to 85 % less; Allan")));
}

TEST(Summary, RanksNothingOnAMovingRecord) {
  const Json axes{{"x", axis(0.4, 0.3, 0.2, 0.1)}};
  EXPECT_THAT(summary_sentences(axes, false), Not(Contains(HasSubstr("best"))));
}

Json record_json() {
  return Json{{"samples", 360'000}, {"still", true}, {"gaps", 0},    {"rows", 360'000},
              {"left_out", 0},      {"bridged", 0},  {"refused", 0}, {"broken_rows", 0}};
}

TEST(Cautions, AGoodRecordNeedsNone) { EXPECT_THAT(cautions(record_json()), IsEmpty()); }

TEST(Cautions, NameMotionLengthGapsAndRefusedSamples) {
  Json record = record_json();
  record["still"] = false;
  record["samples"] = 1000;
  record["gaps"] = 2;
  record["refused"] = 7;
  const auto words = cautions(record);
  EXPECT_THAT(words, Contains(HasSubstr("This record moves")));
  EXPECT_THAT(words, Contains(HasSubstr("This record has 1000")));
  EXPECT_THAT(words, Contains(HasSubstr("longest stretch")));
  EXPECT_THAT(words, Contains(HasSubstr("7 samples were refused")));
}

}  // namespace
}  // namespace gyrod::report
