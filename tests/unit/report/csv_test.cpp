#include "report/csv.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace gyrod::report {
namespace {

TEST(TableCsv, InnerObjectsBecomeColumnsAndNullAnEmptyCell) {
  const Json rows = Json::parse(R"([{"axis":"x","q":{"value":1.5,"known":true},"a":[1,2]},
                                    {"axis":"y","q":{"value":null,"known":false},"a":[]}])");
  EXPECT_EQ(table_csv(rows), "axis,q_value,q_known,a\nx,1.5,true,1 2\ny,,false,\n");
}

TEST(TableCsv, TextIsQuotedWhereItMustBe) {
  EXPECT_EQ(table_csv(Json::parse(R"([{"t":"a, \"b\""}])")), "t\n\"a, \"\"b\"\"\"\n");
}

TEST(SeriesCsv, HasARowASampleAndAnEmptyCellForWhatIsNotFinite) {
  const std::vector<double> a = {1.0, 0.1, std::numeric_limits<double>::quiet_NaN()};
  const std::vector<double> b = {0.0, -2.0, 4e-7};
  std::string text;
  write_series("time_s", 0.5, {{"a", a, 10.0}, {"b", b}}, [&text](std::string_view piece) { text += piece; });
  EXPECT_EQ(text, "time_s,a,b\n0,10,0\n0.5,1,-2\n1,,4e-07\n");
}

}  // namespace
}  // namespace gyrod::report
