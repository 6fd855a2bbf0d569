#include <csignal>
#include <string>

#include <gtest/gtest.h>

#include "rig.hpp"
#include "support/eventually.hpp"

namespace gyrod::testing {
namespace {

class Silence : public Rig {};

// A sensor process that is stopped keeps its place on the bus; only its samples stay away.
TEST_F(Silence, OfASensorIsNoticedReleasedAndOver) {
  const auto daemon = start_daemon({.silent_after_s = 1.0, .forget_after_s = 0.0});
  const auto sensor = start_on_bus({"simulate", "--sensor", "imu1"});
  const auto value = [&](const std::string& series) { return metric(*daemon, series).value_or(-1.0); };
  ASSERT_TRUE(eventually([&] { return value("gyrod_samples_published_total") > 100.0; }));
  sensor->signal(SIGSTOP);
  ASSERT_TRUE(eventually([&] { return value("gyrod_sensor_silent{sensor=\"imu1\"}") == 1.0; }));
  EXPECT_EQ(value("gyrod_samples_in_flight"), 0.0) << "what was held is released";
  EXPECT_EQ(value("gyrod_samples_received_total"), value("gyrod_samples_published_total"));
  EXPECT_EQ(value("gyrod_sensors_silent"), 1.0);
  sensor->signal(SIGCONT);
  ASSERT_TRUE(eventually([&] { return value("gyrod_sensors_silent") == 0.0; }));
  EXPECT_GE(value("gyrod_sensor_silences_total{sensor=\"imu1\"}"), 1.0);
  sensor->signal(SIGINT);
  sensor->wait();
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(Silence, LongEnoughMakesASensorForgottenAndItsCountsStay) {
  const auto daemon = start_daemon({.silent_after_s = 0.5, .forget_after_s = 1.0});
  ASSERT_EQ(run_on_bus({"simulate", "--sensor", "imu1", "--samples", "500", "--speed", "max"}).exit_code, 0);
  ASSERT_TRUE(eventually([&] { return metric(*daemon, "gyrod_sensors_forgotten_total") == 1.0; }));
  EXPECT_EQ(metric(*daemon, "gyrod_sensors"), 0.0);
  EXPECT_EQ(metric(*daemon, "gyrod_samples_published_total"), 500.0);
  EXPECT_FALSE(metric(*daemon, "gyrod_sensor_silent{sensor=\"imu1\"}")) << "its series are gone";
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

}  // namespace
}  // namespace gyrod::testing
