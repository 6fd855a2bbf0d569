#include "monitor/live_page.hpp"

#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "web/assets.hpp"

namespace gyrod::monitor {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string header(const Answer& answer, std::string_view name) {
  for (const auto& [key, value] : answer.headers)
    if (key == name) return value;
  return "";
}

TEST(LivePage, ItsPolicyLetsItsOwnScriptsRunAndItAskThisDaemonAlone) {
  const Answer page = live_page();
  const std::string policy = header(page, "Content-Security-Policy");
  EXPECT_THAT(policy, HasSubstr("default-src 'none'"));
  EXPECT_THAT(policy, HasSubstr("connect-src 'self'"));
  EXPECT_THAT(policy, Not(HasSubstr("unsafe")));
  for (const char* name : {"uplot.js", "charts.js", "live_list.js", "live.js", "page.css", "live.css"}) {
    EXPECT_THAT(policy, HasSubstr("'" + std::string(web::asset_hash(name)) + "'")) << name;
    EXPECT_THAT(page.body, HasSubstr(std::string(web::asset(name)))) << name;
  }
}

TEST(LivePage, NoPlaceInItsTemplateIsLeftEmptyAndTheLicenceOfThePlottingLibraryIsThere) {
  const std::string page = live_page().body;
  for (const char* place : {"@STYLES@", "@SCRIPTS@", "@UPLOT_LICENSE@"})
    EXPECT_THAT(page, Not(HasSubstr(place))) << place;
  EXPECT_THAT(page, HasSubstr("Copyright (c) 2022 Leon Sorokin"));
}

TEST(LivePage, NothingBecomesMarkup) {
  const std::string page = live_page().body;
  for (const char* way : {"innerHTML", "insertAdjacentHTML", "document.write", "eval("})
    EXPECT_THAT(page, Not(HasSubstr(way))) << way;
}

}  // namespace
}  // namespace gyrod::monitor
