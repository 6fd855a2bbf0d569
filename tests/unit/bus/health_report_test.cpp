/// Health events from the publisher to readers.
#include <gyrod.h>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bus/publisher.hpp"
#include "bus/qos.hpp"
#include "bus/topic_reader.hpp"
#include "unit/bus/bus_test.hpp"

namespace gyrod::bus::test {
namespace {

class HealthReportTest : public BusTest {
 protected:
  static stream::SensorHealth health(stream::Health y) {
    stream::SensorHealth health{.state = y, .axis = {}};
    health.axis.fill({stream::Health::kOk, 0.0, 0.0});
    health.axis[1] = {y, 1.5, 1.25};
    return health;
  }
};

TEST_P(HealthReportTest, ALateReaderGetsTheLastOfEachSensorUntilItIsForgotten) {
  Publisher publisher(writer_domain(), options_);
  const auto ok = health(stream::Health::kOk);
  publisher.publish_health("front", ok, health(stream::Health::kNoisy), 1);
  publisher.publish_health("front", health(stream::Health::kNoisy), health(stream::Health::kStuck), -7);
  publisher.publish_health("rear", ok, ok, 3);
  publisher.publish_health("gone", ok, ok, 4);
  publisher.unregister_health("gone");

  Qos qos;
  qos.reliable(0).keep_all().keep_for_late_joiners(1);
  const Domain domain = reader_domain();
  const TopicReader<gyrod_HealthReport> reader(domain.participant(), options_.topics.health, qos);
  std::vector<std::string> sensors;
  wait_until([&] {
    reader.take([&](const gyrod_HealthReport& wire, const dds_sample_info_t& info) {
      if (!info.valid_data) return;
      sensors.emplace_back(wire.sensor);
      if (sensors.back() != "front") return;
      EXPECT_EQ(wire.stamp_ns, -7);
      EXPECT_EQ(wire.state, gyrod_HEALTH_STUCK);
      EXPECT_EQ(wire.previous_state, gyrod_HEALTH_NOISY);
      EXPECT_EQ(wire.axis[0].state, gyrod_HEALTH_OK);
      EXPECT_EQ(wire.axis[1].state, gyrod_HEALTH_STUCK);
      EXPECT_EQ(wire.axis[1].previous_state, gyrod_HEALTH_NOISY);
      EXPECT_EQ(wire.axis[1].value, 1.5);
      EXPECT_EQ(wire.axis[1].limit, 1.25);
    });
    return sensors.size() >= 2;
  });
  EXPECT_THAT(sensors, testing::UnorderedElementsAre("front", "rear"));
  EXPECT_EQ(publisher.write_errors(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Bus, HealthReportTest, testing::Values(Route::kInProcess, Route::kUdp), route_name);

}  // namespace
}  // namespace gyrod::bus::test
