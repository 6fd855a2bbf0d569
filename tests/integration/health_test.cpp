/// Faults of sensors, each of which has to give its own state of health and no other.
#include "stream/health.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rig.hpp"
#include "support/eventually.hpp"

namespace gyrod::testing {
namespace {

using ::testing::HasSubstr;
using Rates = std::array<double, 3>;

constexpr std::uint64_t kSamples = 13'500;  // at 100 Hz
constexpr std::uint64_t kFault = 8'500;     // when the fault begins: a bias takes 60 s of rest to be known

/// A sensor at rest whose fault changes its rates, and may lose a sample.
struct Fault {
  std::string sensor;
  std::string state;
  std::function<void(std::uint64_t, Rates&)> change;
  std::function<bool(std::uint64_t)> is_lost = [](std::uint64_t) { return false; };
};

std::string recording_of(const Fault& fault) {
  std::mt19937_64 bits(11);  // NOLINT(cert-msc51-cpp): the same each time
  std::normal_distribution<double> normal(0.0, 0.006);
  std::ostringstream text;
  text.precision(17);
  text << "sequence,stamp_ns,gyro_x_radps,gyro_y_radps,gyro_z_radps\n";
  for (std::uint64_t n = 0; n < kSamples; ++n) {
    Rates rates = {normal(bits), normal(bits), normal(bits)};
    if (n >= kFault) fault.change(n, rates);
    if (n >= kFault && fault.is_lost(n)) continue;
    text << n << ',' << n * 10'000'000 << ',' << rates[0] << ',' << rates[1] << ',' << rates[2] << '\n';
  }
  return text.str();
}

const std::vector<Fault>& faults() {
  static const std::vector<Fault> all = {
      {"healthy", "ok", [](std::uint64_t, Rates&) {}},
      {"frozen", "stuck", [](std::uint64_t, Rates& rates) { rates[1] = 0.004; }},
      {"clipped", "saturated",
       [](std::uint64_t n, Rates& rates) {
         rates[2] = std::clamp(rates[2] + 3.0 * std::sin(0.06 * static_cast<double>(n)), -2.0, 2.0);
       }},
      {"loud", "noisy",
       [](std::uint64_t, Rates& rates) {
         for (double& rate : rates) rate *= 3.0;
       }},
      {"moved", "drifting", [](std::uint64_t, Rates& rates) { rates[0] += 0.006; }},
      {"leaky", "lossy", [](std::uint64_t, Rates&) {}, [](std::uint64_t n) { return n % 20 == 7; }}};
  return all;
}

class Health : public Rig {
 protected:
  /// States that a sensor was seen in.
  void look(const Process& daemon) {
    std::stringstream text(get(daemon, "/metrics"));
    const std::string begin = "gyrod_sensor_health{sensor=\"";
    for (std::string line; std::getline(text, line);) {
      if (!line.starts_with(begin)) continue;
      const std::size_t end = line.find('"', begin.size());
      const auto number = std::stoul(line.substr(line.rfind(' ') + 1));
      seen_[line.substr(begin.size(), end - begin.size())].emplace(
          stream::name_of(static_cast<stream::Health>(number)));
    }
  }
  std::map<std::string, std::set<std::string>> seen_;
};

// Health is judged once a second, which is 15 s of the recordings: each state lasts for twice that. Nothing is computed in the windows,
// and silence is far away, so that a sanitizer's build keeps up.
TEST_F(Health, EachFaultGivesItsOwnStateAndNoOther) {
  const auto daemon = start_daemon(
      {.window_samples = 128,
       .method = "paper",
       .patch = R"({"denoise": {"scheme": "raw", "hop_samples": 64}, "limits": {"max_hop_samples": 64},
                    "health": {"silent_after_s": 60, "noisy_after_s": 5, "loss_window_s": 1}})"});
  std::vector<std::unique_ptr<Process>> sensors;
  for (const Fault& fault : faults()) {
    write_file(fault.sensor + ".csv", recording_of(fault));
    sensors.push_back(start_on_bus(
        {"replay", path(fault.sensor + ".csv"), "--sensor", fault.sensor, "--speed", "15", "--batch", "10"}));
  }
  const auto all_over = [&] {
    look(*daemon);
    return std::ranges::all_of(faults(),
                               [&](const Fault& fault) { return seen_[fault.sensor].contains("silent"); });
  };
  EXPECT_TRUE(eventually(all_over)) << "a sensor whose writer has gone is silent";
  for (const Fault& fault : faults()) {
    std::set<std::string> expected = {"ok", fault.state, "silent"};
    seen_[fault.sensor].erase("warming_up");  // the first second may be missed
    EXPECT_EQ(seen_[fault.sensor], expected) << fault.sensor;
  }
  for (const auto& sensor : sensors) sensor->wait();
  EXPECT_EQ(stop_daemon(*daemon), 0);
  EXPECT_THAT(daemon->err(), HasSubstr("frozen is stuck, before ok (axis y"));
  EXPECT_THAT(daemon->err(), HasSubstr("loud is noisy, before ok"));
}

}  // namespace
}  // namespace gyrod::testing
