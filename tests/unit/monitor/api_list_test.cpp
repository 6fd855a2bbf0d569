/// The API's list of sensors: which, in what order, and how many.
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "unit/monitor/api_fixture.hpp"

namespace gyrod::monitor::test {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> ids_of(const nlohmann::json& listing) {
  std::vector<std::string> ids;
  for (const auto& row : listing.at("channels")) ids.push_back(row.at("sensor"));
  return ids;
}

using ApiListTest = ApiTest;

TEST_F(ApiListTest, ListsTheWorstFirst) {
  const json listing = get("channels");
  EXPECT_THAT(ids_of(listing), ElementsAre("imu_front", "imu_rear"));
  EXPECT_EQ(listing.at("total"), 2);
  EXPECT_EQ(listing.at("matching"), 2);
  EXPECT_FALSE(listing.at("channels")[0].at("axes")[0].contains("history"));
}

TEST_F(ApiListTest, ListsWhatIsAskedForInTheOrderAskedFor) {
  shown_.channels = {busy_sensor("b"), busy_sensor("c"), new_sensor("a")};
  shown_.channels[1].last_report.axis[2].noise_floor = 1.0;
  EXPECT_THAT(ids_of(get("channels?sort=sensor")), ElementsAre("a", "b", "c"));
  EXPECT_THAT(ids_of(get("channels?sort=sensor&order=desc")), ElementsAre("c", "b", "a"));
  EXPECT_THAT(ids_of(get("channels?sort=noise_in")), ElementsAre("c", "b", "a"));
  EXPECT_THAT(ids_of(get("channels?sort=noise_in&order=asc")), ElementsAre("b", "c", "a"))
      << "what is not known comes last";
  EXPECT_THAT(ids_of(get("channels?health=warming_up,noisy")), ElementsAre("a"));
  EXPECT_THAT(ids_of(get("channels?search=B")), ElementsAre());
  EXPECT_THAT(ids_of(get("channels?search=c")), ElementsAre("c"));
  const json page = get("channels?sort=sensor&offset=1&limit=1");
  EXPECT_THAT(ids_of(page), ElementsAre("b"));
  EXPECT_EQ(page.at("matching"), 3);
  EXPECT_EQ(page.at("offset"), 1);
}

TEST_F(ApiListTest, SortsByTheFigureThatIsNamed) {
  shown_.channels = {busy_sensor("loud"), busy_sensor("quick"), busy_sensor("reduced"), new_sensor("new")};
  shown_.channels[0].last_report.axis[1].noise_floor = 1.0;
  shown_.channels[0].last_report.axis[1].output_noise = 0.9;
  shown_.channels[1].sample_rate_hz = 400.0;
  shown_.channels[2].last_report.axis[2].output_noise = 1e-5;
  EXPECT_EQ(ids_of(get("channels?sort=noise_in")).front(), "loud");
  EXPECT_EQ(ids_of(get("channels?sort=rate")).front(), "quick");
  EXPECT_EQ(ids_of(get("channels?sort=reduction")).front(), "reduced");
  EXPECT_EQ(ids_of(get("channels?sort=rate&order=asc")).back(), "new") << "not known";
}

TEST_F(ApiListTest, ListsAThousandSensors) {
  shown_.channels.clear();
  for (int i = 0; i < 1000; ++i) shown_.channels.push_back(busy_sensor("vehicle/imu" + std::to_string(i)));
  EXPECT_EQ(get("channels").at("channels").size(), 1000U);
  EXPECT_EQ(get("channels?offset=990&limit=100").at("channels").size(), 10U);
}

TEST_F(ApiListTest, TheNoiseOfTheLastMinutesComesWhereItIsAskedFor) {
  stream::ChannelSnapshot sensor = busy_sensor("imu_front");
  live_.noise.note(new_sensor("imu_front"));
  live_.noise.end_round();
  live_.noise.note(sensor);
  live_.noise.end_round();
  const json axes = get("channels?history=1").at("channels")[0].at("axes");
  EXPECT_THAT(axes[1].at("history"), ElementsAre(nullptr, 0.016));
}

}  // namespace
}  // namespace gyrod::monitor::test
