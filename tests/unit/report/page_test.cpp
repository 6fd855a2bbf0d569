#include "report/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "web/assets.hpp"

namespace gyrod::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count(const std::string& text, std::string_view part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(ScriptText, HoldsNothingThatCouldEndAScriptAndReadsBackTheSame) {
  const Json json{{"name", "</script><!--<script>&\u2028'\""}};
  const std::string text = script_text(json);
  EXPECT_EQ(text.find_first_of("<>&"), std::string::npos) << text;
  EXPECT_EQ(Json::parse(text), json);
}

TEST(ScriptText, BrokenUtf8IsReplacedNotThrown) {
  EXPECT_THAT(script_text(Json{{"name", "a\xff.csv"}}), HasSubstr("a\uFFFD.csv"));
}

TEST(Page, TextOfTheRecordStaysText) {
  const std::string name = "</title></script><img src=x onerror=alert(1)>@DATA@@SCRIPTS@";
  const std::string plain = report_page("plain", Json{{"name", "plain"}});
  const std::string page = report_page(name, Json{{"name", name}});
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  for (const char* tag : {"<script", "</script", "</title", "<style"})
    EXPECT_EQ(count(page, tag), count(plain, tag)) << tag;
  EXPECT_THAT(page, HasSubstr("@DATA@@SCRIPTS@</title>")) << "what is put in is not a template";
}

TEST(Page, LoadsNothingAndItsPolicyLetsOnlyItsOwnScriptsRun) {
  const std::string page = report_page("t", Json::object());
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, Not(HasSubstr("unsafe")));
  for (const char* name : {"uplot.js", "charts.js", "parts.js", "tabs.js", "report_figures.js", "report.js",
                           "uplot.css", "page.css", "report.css"}) {
    EXPECT_THAT(page, HasSubstr("'" + std::string(web::asset_hash(name)) + "'")) << name;
    EXPECT_THAT(page, HasSubstr(std::string(web::asset(name)))) << name;
  }
  for (const char* loads : {" src=", "@import", "<link"}) EXPECT_THAT(page, Not(HasSubstr(loads)));
}

TEST(Page, KeepsTheLicenceOfThePlottingLibrary) {
  const std::string page = report_page("t", Json::object());
  EXPECT_THAT(page, HasSubstr("Copyright (c) 2022 Leon Sorokin"));
  EXPECT_THAT(page, HasSubstr("Permission is hereby granted"));
}

TEST(Rounded, KeepsSixDigitsAndMakesNullOfWhatIsNotFinite) {
  const std::vector<double> values = {0.123456789, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(rounded(values, 10.0).dump(), "[1.23457,null]");
}

TEST(NumberText, HasTheDigitsAskedFor) {
  EXPECT_EQ(number_text(0.35004), "0.3500");
  EXPECT_EQ(number_text(12.3456), "12.35");
  EXPECT_EQ(number_text(3.847, 2), "3.8");
  EXPECT_EQ(number_text(0.0), "0");
}

}  // namespace
}  // namespace gyrod::report
