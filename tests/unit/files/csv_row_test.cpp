#include "files/csv_row.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyrod::files {
namespace {

using ::testing::ElementsAre;

std::vector<std::string_view> split(std::string_view row, char separator = ',') {
  std::vector<std::string_view> cells;
  EXPECT_TRUE(split_row(row, separator, cells));
  return cells;
}

TEST(CsvRow, SplitsAtEverySeparator) {
  EXPECT_THAT(split("a,b,c"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(split("a;b,c", ';'), ElementsAre("a", "b,c"));
}

TEST(CsvRow, KeepsEmptyCells) {
  EXPECT_THAT(split(",,"), ElementsAre("", "", ""));
  EXPECT_THAT(split(""), ElementsAre(""));
}

TEST(CsvRow, SeparatorInsideQuotesBelongsToTheCell) {
  EXPECT_THAT(split(R"("a,b",c)"), ElementsAre(R"("a,b")", "c"));
  EXPECT_THAT(split(R"("say ""x,y""",c)"), ElementsAre(R"("say ""x,y""")", "c"));
}

TEST(CsvRow, QuoteWithoutEndIsRefused) {
  std::vector<std::string_view> cells;
  EXPECT_FALSE(split_row(R"(a,"b,c)", ',', cells));
}

TEST(CsvRow, BareCellHasNeitherBlanksNorQuotes) {
  EXPECT_EQ(bare("  a b\t"), "a b");
  EXPECT_EQ(bare(R"( " 1.5 " )"), "1.5");
  EXPECT_EQ(bare(R"(")"), R"(")");
  EXPECT_EQ(bare("   "), "");
}

TEST(CsvRow, ShownTextIsPrintableAndShort) {
  EXPECT_EQ(shown("a\x01\xff"), "\"a??\"");
  EXPECT_EQ(shown(std::string(1000, 'x')), "\"" + std::string(60, 'x') + "...\"");
}

}  // namespace
}  // namespace gyrod::files
