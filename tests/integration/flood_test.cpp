#include <csignal>

#include <gtest/gtest.h>

#include "bus/domain.hpp"
#include "bus/raw_writer.hpp"
#include "rig.hpp"
#include "support/eventually.hpp"
#include "support/samples.hpp"

namespace gyrod::testing {
namespace {

class Flood : public Rig {};

TEST_F(Flood, TenThousandNewSensorIdsAreRefusedAndCountedAndTheKnownOnesLiveOn) {
  constexpr std::size_t kIds = 10000;
  constexpr std::size_t kChannels = 16;
  const auto daemon = start_daemon({.max_channels = kChannels});
  bus::BusOptions options;
  const bus::Domain domain(domain_id(), "loopback");
  bus::RawWriter writer(domain, options);
  ASSERT_TRUE(writer.wait_for_subscriber(std::chrono::seconds{60}));
  const auto publish = [&writer](const std::string& sensor, std::uint64_t sequence) {
    const stream::Sample sample = sample_at(sequence, 0.01);
    ASSERT_EQ(writer.publish(sensor, {&sample, 1}), 1U);
  };
  for (std::size_t n = 0; n < kIds; ++n) publish("id" + std::to_string(n), 0);
  publish("id0", 1);

  EXPECT_TRUE(eventually(
      [&] { return metric(*daemon, "gyrod_samples_received_total") == static_cast<double>(kIds + 1); }));
  EXPECT_EQ(metric(*daemon, "gyrod_samples_rejected_total{reason=\"too_many_channels\"}"),
            static_cast<double>(kIds - kChannels));
  EXPECT_EQ(metric(*daemon, "gyrod_sensor_samples_received_total{sensor=\"id0\"}"), 2.0);
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

}  // namespace
}  // namespace gyrod::testing
