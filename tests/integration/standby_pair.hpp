/// Two daemons with the same output, as two processes, for integration tests.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "rig.hpp"
#include "support/eventually.hpp"

namespace gyrod::testing {

class StandbyPair : public Rig {
 protected:
  static constexpr const char* kFirst = "first.json";
  static constexpr const char* kSecond = "second.json";

  /// What both have in common beside their roles; to be set before they start.
  DaemonOptions options_{.window_samples = 512};
  double takeover_s_ = 0.5;

  std::unique_ptr<Process> start_one(const std::string& name) {
    DaemonOptions options = options_;
    options.patch =
        merged(options_.patch, R"({"bus": {"output": {"takeover_s": )" + std::to_string(takeover_s_) +
                                   R"(, "ownership_strength": )" + (name == kFirst ? "20" : "10") + "}}}");
    write_config(options, name);
    auto daemon = start({"run", "--config", path(name)});
    if (!daemon->wait_for_err("/metrics"))
      throw std::runtime_error("the daemon did not start: " + daemon->err());
    return daemon;
  }
  /// The first is the stronger one. Both are there before the sensor, so that their outputs are the same bits.
  void start_two() {
    first_ = start_one(kFirst);
    second_ = start_one(kSecond);
    write_config(options_);
    ASSERT_TRUE(eventually([&] {
      return of(*first_, "gyrod_standby_others") == 1.0 && of(*second_, "gyrod_standby_others") == 1.0;
    }));
  }
  /// Publishes all sensors, or none of them.
  [[nodiscard]] static bool publishes(const Process& daemon, double sensors) {
    return of(daemon, "gyrod_standby_sensors") == sensors;
  }

  std::unique_ptr<Process> first_;
  std::unique_ptr<Process> second_;
};

}  // namespace gyrod::testing
