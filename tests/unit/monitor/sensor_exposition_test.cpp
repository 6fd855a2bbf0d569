/// The text of many sensors against that of the library, byte for byte.
#include "monitor/sensor_exposition.hpp"

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <prometheus/text_serializer.h>

#include "monitor/health_metrics.hpp"
#include "monitor/metric_builders.hpp"
#include "unit/monitor/fixed_view.hpp"

namespace gyrod::monitor::test {
namespace {

/// The library's way.
std::string by_library(std::span<const SensorMetric> metrics,
                       const std::vector<stream::ChannelSnapshot>& sensors) {
  std::vector<prometheus::MetricFamily> families;
  for (const SensorMetric& kind : metrics) {
    families.push_back(family(kind.name, kind.help, kind.type));
    for (const stream::ChannelSnapshot& sensor : sensors) {
      for (std::size_t axis = 0; axis < (kind.of_axis ? stream::kAxes : 1); ++axis) {
        const Value value = kind.value(sensor, axis);
        Labels labels{{"sensor", sensor.sensor}};
        if (kind.of_axis) labels.push_back({"axis", stream::kAxisNames[axis]});
        if (value) families.back().metric.push_back(metric(kind.type, *value, labels));
      }
    }
  }
  return prometheus::TextSerializer().Serialize(families);
}

std::string by_us(std::span<const SensorMetric> metrics,
                  const std::vector<stream::ChannelSnapshot>& sensors) {
  SensorExposition exposition({metrics});
  for (const stream::ChannelSnapshot& sensor : sensors) exposition.add(sensor);
  std::string text;
  exposition.append_to(text);
  return text;
}

TEST(SensorExposition, IsTheLibrarysTextForEveryFamily) {
  const std::vector<stream::ChannelSnapshot> sensors = {busy_sensor("imu_front"), new_sensor("imu_rear"),
                                                        busy_sensor(R"(a"quoted\one)")};
  EXPECT_EQ(by_us(sensor_metrics(), sensors), by_library(sensor_metrics(), sensors));
  EXPECT_EQ(by_us(health_metrics(), sensors), by_library(health_metrics(), sensors));
}

TEST(SensorExposition, IsTheLibrarysTextForNumbersOfAnySize) {
  // The bias is told as it is, whatever it is.
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<double> values = {0.0,
                                      -0.0,
                                      1.0,
                                      -1.0,
                                      0.1,
                                      -0.1,
                                      1e15,
                                      1e16,
                                      1e17,
                                      1e300,
                                      5e-324,
                                      1.0 / 3.0,
                                      2.0e-5,
                                      123456789012345.0,
                                      -4e9,
                                      0.5,
                                      1e14,
                                      -1e15,
                                      kInfinity,
                                      -kInfinity,
                                      999999999999999.9,
                                      1e-4,
                                      9e-5,
                                      1e5,
                                      1234567.0,
                                      std::numeric_limits<double>::quiet_NaN()};
  std::vector<stream::ChannelSnapshot> sensors;
  for (const double value : values) {
    sensors.push_back(busy_sensor("imu" + std::to_string(sensors.size())));
    sensors.back().bias_radps = {value, 2.0 * value, value / 7.0};
  }
  EXPECT_EQ(by_us(health_metrics(), sensors), by_library(health_metrics(), sensors));
}

}  // namespace
}  // namespace gyrod::monitor::test
