// The machine's wall clock is set while the daemon runs: by an hour, ahead and back.
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bus/bus_options.hpp"
#include "bus/domain.hpp"
#include "rig.hpp"
#include "support/arrivals.hpp"
#include "support/eventually.hpp"

namespace gyrod::testing {
namespace {

constexpr std::int64_t kHourNs = 3'600'000'000'000;
/// Of DDS, 10 s, after which who has said nothing is given up.
constexpr std::chrono::seconds kLongerThanALease{12};

class ClockStep : public Rig {
 protected:
  ClockStep() { write_file("clock", std::string(sizeof(std::int64_t), '\0')); }

  /// Of the programs that were started with it. They have the file mapped: it keeps its length.
  void set_clock(std::int64_t offset_ns) const {
    std::fstream file(path("clock"), std::ios::in | std::ios::out | std::ios::binary);
    file.write(reinterpret_cast<const char*>(&offset_ns), sizeof offset_ns);
  }
  std::unique_ptr<Process> start_daemon_with_clock() {
    setenv("LD_PRELOAD", std::getenv("GYROD_STEPPING_CLOCK"), 1);
    setenv("GYROD_TEST_CLOCK", path("clock").c_str(), 1);
    auto daemon = start_daemon({.silent_after_s = 2.0});
    unsetenv("LD_PRELOAD");
    return daemon;
  }
  [[nodiscard]] const bus::Domain& domain() const { return domain_; }

 private:
  bus::Domain domain_{domain_id(), "loopback"};
};

TEST_F(ClockStep, ADaemonWhoseClockIsSetByAnHourLosesNothing) {
  const auto daemon = start_daemon_with_clock();
  const Arrivals output(domain(), bus::BusOptions{}, "gyro/denoised", "imu");
  ASSERT_TRUE(eventually([&] { return output.writers() == 1; }));
  set_clock(-kHourNs);  // while it has nothing to send
  const auto set = std::chrono::steady_clock::now();
  EXPECT_TRUE(eventually([&] { return std::chrono::steady_clock::now() - set > kLongerThanALease; }));
  EXPECT_EQ(output.writers(), 1U);
  const auto sensor = start_on_bus({"simulate", "--sensor", "imu", "--rate", "100", "--wait", "60"});
  EXPECT_TRUE(output.more_arrive(200));
  for (const std::int64_t offset_ns : {std::int64_t{0}, kHourNs, std::int64_t{0}}) {
    set_clock(offset_ns);
    EXPECT_TRUE(output.more_arrive(300)) << offset_ns;
  }
  EXPECT_EQ(output.missing(), 0U);
  EXPECT_EQ(output.duplicates(), 0U);
  for (const std::string series : {"gyrod_silences_total", "gyrod_gaps_total", "gyrod_restarts_total",
                                   "gyrod_samples_missing_total", "gyrod_samples_passed_through_total"})
    EXPECT_EQ(metric(*daemon, series), 0.0) << series;
  sensor->signal(SIGINT);
  EXPECT_EQ(sensor->wait(), 0);
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

}  // namespace
}  // namespace gyrod::testing
