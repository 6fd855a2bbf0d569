// Too much work for the workers: what gives way, in which order, how it shows, and how it ends.
#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bus/raw_writer.hpp"
#include "rig.hpp"
#include "support/arrivals.hpp"
#include "support/eventually.hpp"
#include "support/samples.hpp"

namespace gyrod::testing {
namespace {

constexpr unsigned kPassThrough = 4;
constexpr unsigned kHopWidened = 8;

class Overload : public Rig {
 protected:
  /// One worker, long windows, and little patience.
  std::unique_ptr<Process> start_starved(const std::string& method) {
    return start_daemon({.workers = 1,
                         .window_samples = 4096,
                         .method = method,
                         .patch = R"({"limits": {"max_delay_s": 0.01}})"});
  }
  [[nodiscard]] Arrivals arrivals(const std::string& sensor) const {
    return {domain_, bus::BusOptions{}, "gyro/denoised", sensor};
  }
  static std::size_t flagged(const std::vector<stream::DenoisedSample>& samples, unsigned flag) {
    return static_cast<std::size_t>(
        std::ranges::count_if(samples, [flag](const auto& sample) { return (sample.flags & flag) != 0; }));
  }
  static void send(bus::RawWriter& writer, const std::string& sensor,
                   std::span<const stream::Sample> samples) {
    while (!samples.empty()) samples = samples.subspan(writer.publish(sensor, samples));
  }
  /// Thirty-two sensors that send a hop each at the same moment, again and again; "imu" is one of them. The next hop is sent when all of
  /// the last one has come in: DDS would hand over a backlog sensor by sensor, of which each waits for its own windows alone.
  static void flood(const Process& daemon, bus::RawWriter& writer, std::span<const stream::Sample> samples) {
    constexpr std::size_t kHop = 32;
    constexpr int kSensors = 32;
    for (std::size_t at = 0; at < samples.size(); at += kHop) {
      const auto part = samples.subspan(at, std::min(kHop, samples.size() - at));
      for (int n = 0; n < kSensors; ++n) send(writer, n == 20 ? "imu" : "other" + std::to_string(n), part);
      const auto sent = static_cast<double>(kSensors * (at + part.size()));
      ASSERT_TRUE(eventually([&] { return of(daemon, "gyrod_samples_received_total") >= sent; }));
    }
  }
  /// Many samples as fast as they are taken, then a pace that one worker can keep.
  void flood_then_rest(Process& daemon, const Arrivals& all, const Arrivals& output, unsigned flag) {
    constexpr std::size_t kFlood = 2048;
    ASSERT_TRUE(eventually([&] { return all.writers() == 1 && output.writers() == 1; }));
    bus::RawWriter writer(domain_, bus::BusOptions{}, 32);
    ASSERT_TRUE(writer.wait_for_subscriber(std::chrono::seconds{60}));
    const auto samples = noisy_samples(100'000);
    const std::span<const stream::Sample> input(samples);
    flood(daemon, writer, input.first(kFlood));
    // The widest hop and the lag may be held back until more comes.
    ASSERT_TRUE(eventually([&] { return output.count() >= kFlood - 256 - 16 - 32; }));
    EXPECT_GT(flagged(all.samples(), flag), 0U);
    EXPECT_GT(of(daemon, "gyrod_hops_widened_total"), 0.0);
    EXPECT_TRUE(eventually(
        [&] { return get(daemon, "/api/v1/events").find("Overload step ") != std::string::npos; }));

    std::size_t sent = kFlood;
    ASSERT_TRUE(eventually([&] {
      send(writer, "imu", input.subspan(sent++, 1));
      return output.count() > kFlood + 64 &&
             (output.samples().back().flags & (kPassThrough | kHopWidened)) == 0 &&
             of(daemon, "gyrod_sensor_overload_step{sensor=\"imu\"}") == 0.0;
    })) << "over by itself";
    ASSERT_TRUE(writer.end("imu"));
    ASSERT_TRUE(eventually([&] { return output.count() == sent; }));
    EXPECT_EQ(output.missing(), 0U) << "nothing was lost";
    EXPECT_EQ(output.duplicates(), 0U);
    EXPECT_TRUE(is_balanced(daemon));
  }

 private:
  bus::Domain domain_{domain_id(), "loopback"};
};

TEST_F(Overload, OfAWindowMethodWidensTheHopThenPassesThroughAndEndsByItself) {
  const auto daemon = start_starved("paper");
  const Arrivals all = arrivals("");
  const Arrivals output = arrivals("imu");
  flood_then_rest(*daemon, all, output, kPassThrough);
  EXPECT_GT(flagged(all.samples(), kHopWidened), 0U);
  EXPECT_GT(of(*daemon, "gyrod_overloads_total"), 0.0);
  EXPECT_GT(of(*daemon, "gyrod_samples_passed_through_total"), 0.0);
  EXPECT_TRUE(daemon->wait_for_err("overload: samples pass through undenoised"));
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

TEST_F(Overload, OfAModelMethodGoesOnWithOlderModelsAndEndsByItself) {
  const auto daemon = start_starved("joint");
  const Arrivals all = arrivals("");
  const Arrivals output = arrivals("imu");
  flood_then_rest(*daemon, all, output, kHopWidened);
  EXPECT_EQ(flagged(all.samples(), kPassThrough), 0U);
  EXPECT_TRUE(daemon->wait_for_err("overload: windows come less often"));
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

}  // namespace
}  // namespace gyrod::testing
