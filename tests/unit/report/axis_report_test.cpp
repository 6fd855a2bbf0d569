#include "report/axis_report.hpp"

#include <cmath>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/report/noise.hpp"

namespace gyrod::report {
namespace {

using ::testing::HasSubstr;

TEST(AxisReport, HoldsEveryFigureAndTableOfARecord) {
  const auto record = testing::white_noise(4000, 0.01, 8, 0.003);
  const core::RecordAnalysis analysis = core::analyse_record(record);
  const Json json = axis_report({"x", 100.0, true, {}, analysis});
  for (const char* part : {"record", "decomposition", "models", "before_after", "table5", "allan"}) {
    EXPECT_FALSE(json.at(part).contains("absent")) << part;
  }
  const Json& decomposition = json.at("decomposition");
  EXPECT_EQ(decomposition.at("imfs").size(), analysis.imfs.size());
  EXPECT_EQ(decomposition.at("j"), analysis.report.j);
  EXPECT_EQ(json.at("models").at("rows").size(), analysis.mixed.size() + 1) << "and the record's own";
  EXPECT_EQ(json.at("table5").at("rows").size(), core::kSchemes);
  EXPECT_EQ(json.at("allan").at("curves").size(), core::kSchemes);
}

TEST(AxisReport, FiveSamplesSayWhatTheyCannotShow) {
  const auto record = testing::white_noise(5, 0.01, 9);
  const core::RecordAnalysis analysis = core::analyse_record(record);
  const Json json = axis_report({"y", 100.0, true, {}, analysis});
  EXPECT_THAT(json.at("decomposition").at("absent").get<std::string>(), HasSubstr("5 samples"));
  EXPECT_TRUE(json.at("models").contains("absent"));
  EXPECT_THAT(json.at("allan").at("absent").get<std::string>(), HasSubstr("5 samples"));
  EXPECT_EQ(json.at("record").at("trace").at("values_dps").size(), 5U);
  EXPECT_EQ(json.at("table5").at("rows").size(), core::kSchemes);
}

TEST(AxisReport, AConstantRecordIsToldToBeOne) {
  const core::RecordAnalysis analysis = core::analyse_record(std::vector<double>(300, 0.5));
  const Json json = axis_report({"z", 100.0, true, {}, analysis});
  EXPECT_THAT(json.at("decomposition").at("absent").get<std::string>(), HasSubstr("does not oscillate"));
}

TEST(Series, SchemesAreWrittenSampleBySampleAndImfsAsDrawnOrInFull) {
  const auto record = testing::white_noise(5000, 0.01, 10);
  const core::RecordAnalysis analysis = core::analyse_record(record);
  const AxisInput input{"x", 100.0, true, {}, analysis};
  const auto lines = [](auto&& write) {
    std::string text;
    write([&text](std::string_view piece) { text += piece; });
    return std::ranges::count(text, '\n');
  };
  EXPECT_EQ(lines([&](const Sink& sink) { write_schemes(input, sink); }), 5001);
  EXPECT_EQ(lines([&](const Sink& sink) { write_imfs(input, true, sink); }), 5001);
  EXPECT_EQ(lines([&](const Sink& sink) { write_acfs(input, true, sink); }), 5001);
  EXPECT_LE(lines([&](const Sink& sink) { write_imfs(input, false, sink); }), 2001);
  EXPECT_LE(lines([&](const Sink& sink) { write_acfs(input, false, sink); }), 2001);
}

TEST(Series, ImfsAndResidueAddUpToTheRecord) {
  const auto record = testing::white_noise(500, 0.01, 11, 0.02);
  const core::RecordAnalysis analysis = core::analyse_record(record);
  std::ostringstream text;
  write_imfs({"x", 100.0, true, {}, analysis}, true, [&text](std::string_view piece) { text << piece; });
  std::istringstream lines(text.str());
  std::string line;
  std::getline(lines, line);
  EXPECT_THAT(line, HasSubstr("time_s,imf_1_dps,"));
  for (const double sample : record) {
    ASSERT_TRUE(std::getline(lines, line));
    std::istringstream cells(line);
    std::string cell;
    std::getline(cells, cell, ',');
    double sum = 0.0;
    while (std::getline(cells, cell, ',')) sum += std::stod(cell);
    ASSERT_NEAR(sum, sample * kDegPerRad, 1e-7) << "9 digits of each of ten columns";
  }
}

}  // namespace
}  // namespace gyrod::report
