/// Several hosts for integration tests: gyrod's programs in network namespaces, on a network that may lose packets.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "rig.hpp"
#include "support/network_namespace.hpp"

namespace gyrod::testing {

/// Every test has five hosts of its own; it is skipped where there are no network namespaces.
class Hosts : public Rig {
 protected:
  static constexpr std::size_t kHosts = 5;

  void SetUp() override {
    const std::string why_not = TestNetwork::why_not();
    if (!why_not.empty()) GTEST_SKIP() << "skipped: " << why_not;
    network_ = std::make_unique<TestNetwork>(kHosts);
  }

  [[nodiscard]] const TestNetwork& network() const { return *network_; }

  /// Writes NAME.json for a program on eth0, and the network's file that it names.
  /// @param lost_per_mille of the packets that the program sends, those of discovery among them
  /// @param lease_s after which a host that is not heard of is gone
  std::string config_of(const std::string& name, unsigned lost_per_mille, DaemonOptions options,
                        double lease_s = 10.0) const {
    write_file(name + ".xml",
               R"(<CycloneDDS xmlns="https://cdds.io/config"><Domain Id="any">
  <General><Interfaces><NetworkInterface name="eth0"/></Interfaces></General>
  <Discovery><LeaseDuration>)" +
                   std::to_string(lease_s) +
                   R"(s</LeaseDuration></Discovery>
  <Internal><Test><XmitLossiness>)" +
                   std::to_string(lost_per_mille) + R"(</XmitLossiness></Test></Internal>
</Domain></CycloneDDS>)");
    options.network = name + ".xml";
    write_config(options, name + ".json");
    return path(name + ".json");
  }

  /// Starts `gyrod ARGUMENTS... --config FILE` on the host.
  std::unique_ptr<Process> start_on(std::size_t host, std::vector<std::string> arguments,
                                    const std::string& config_file) {
    arguments.insert(arguments.end(), {"--config", config_file});
    std::unique_ptr<Process> process;
    network_->on(host, [&] { process = start(arguments); });
    return process;
  }

  std::unique_ptr<Process> start_daemon_on(std::size_t host, const std::string& config_file) {
    auto daemon = start_on(host, {"run"}, config_file);
    if (!daemon->wait_for_err("/metrics"))
      throw std::runtime_error("the daemon did not start: " + daemon->err());
    return daemon;
  }

  /// A metric of a daemon on that host.
  [[nodiscard]] double metric_on(std::size_t host, const Process& daemon, const std::string& series) const {
    std::optional<double> value;
    network_->on(host, [&] { value = metric(daemon, series); });
    return value.value_or(-1.0);
  }

 private:
  std::unique_ptr<TestNetwork> network_;
};

/// The column `sequence` of a recording of one sensor.
[[nodiscard]] inline std::vector<std::uint64_t> sequences_of(const std::string& file) {
  std::vector<std::uint64_t> sequences;
  for (const std::string& row : columns_of(file, {"sequence"})) sequences.push_back(std::stoull(row));
  return sequences;
}

}  // namespace gyrod::testing
