/// /metrics against docs/metrics.md, and as promtool sees it.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "stream/counters.hpp"
#include "unit/monitor/scrape.hpp"

namespace gyrod::monitor::test {
namespace {

std::string manual() {
  const char* project = std::getenv("GYROD_SOURCE_DIR");
  std::ifstream file(std::string(project == nullptr ? "." : project) + "/docs/metrics.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Metrics, EveryFamilyHasARowInTheManualWithItsType) {
  const std::string text = manual();
  for (const Family& family : families_of(busy_gyrod())) {
    EXPECT_NE(text.find("| `" + family.name + "` | " + family.type + " |"), std::string::npos)
        << family.name << " (" << family.type << ") has no row in docs/metrics.md";
  }
}

TEST(Metrics, TheManualHasNoRowThatIsNotExported) {
  const auto families = families_of(busy_gyrod());
  const std::string text = manual();
  const std::string row = "\n| `";
  std::size_t rows = 0;
  for (std::size_t at = text.find(row); at != std::string::npos; at = text.find(row, at + 1)) {
    const std::size_t begin = at + row.size();
    const std::string name = text.substr(begin, text.find('`', begin) - begin);
    if (!name.starts_with("gyrod_") && !name.starts_with("process_")) continue;
    EXPECT_NE(find_family(families, name), nullptr) << name;
    ++rows;
  }
  EXPECT_EQ(rows, families.size());
}

TEST(Metrics, TheManualExplainsEveryReason) {
  const std::string text = manual();
  for (std::size_t i = 0; i < stream::kRejectReasons; ++i) {
    const std::string reason(stream::name_of(static_cast<stream::RejectReason>(i)));
    EXPECT_NE(text.find("\n| `" + reason + "` |"), std::string::npos) << reason;
  }
}

TEST(Metrics, TheManualExplainsEveryReasonToTurnAClientAway) {
  const std::string text = manual();
  for (std::size_t i = 0; i < kRefusals; ++i) {
    const std::string reason(name_of(static_cast<Refusal>(i)));
    EXPECT_NE(text.find("\n| `" + reason + "` |"), std::string::npos) << reason;
  }
}

TEST(Metrics, PromtoolAcceptsThem) {
  if (std::system("command -v promtool > /dev/null 2>&1") != 0) GTEST_SKIP() << "promtool is not installed";
  std::FILE* promtool = popen("promtool check metrics", "w");
  ASSERT_NE(promtool, nullptr);
  const std::string text = exposition_of(busy_gyrod());
  EXPECT_EQ(std::fwrite(text.data(), 1, text.size(), promtool), text.size());
  EXPECT_EQ(pclose(promtool), 0);
}

}  // namespace
}  // namespace gyrod::monitor::test
