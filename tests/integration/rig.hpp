/// What the integration tests share: the binary, a folder and a DDS domain of their own, recordings, metrics.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/process.hpp"
#include "support/scratch_folder.hpp"

namespace gyrod::testing {

/// Runs subcommands of the binary that the environment names in GYROD_BINARY. Every test has a scratch
/// folder, removed at its end, and a DDS domain that no other program of the same test run uses.
class Rig : public ::testing::Test {
 protected:
  Rig();

  /// Path of a file in the scratch folder.
  [[nodiscard]] std::string path(const std::string& name) const { return folder_.path(name); }
  void write_file(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  [[nodiscard]] std::string read_file(const std::string& name) const { return folder_.read(name); }

  /// Starts `gyrod ARGUMENTS...`.
  [[nodiscard]] std::unique_ptr<Process> start(const std::vector<std::string>& arguments);
  /// The same with --config of this test's daemon, for subcommands on the bus.
  [[nodiscard]] std::unique_ptr<Process> start_on_bus(std::vector<std::string> arguments);
  struct Result {
    int exit_code = -1;
    std::string out;
    std::string err;
  };
  Result run(const std::vector<std::string>& arguments);
  Result run_on_bus(std::vector<std::string> arguments);

  /// What a test wants to be different in its daemon.
  struct DaemonOptions {
    std::size_t workers = 2;
    double stop_deadline_s = 120.0;  ///< a sanitizer's build may take its time
    std::size_t max_channels = 64;
    std::size_t window_samples = 1024;
    std::size_t max_messages = 4096;  ///< that DDS holds for the daemon
    std::string method = "joint";
    std::string state_file = {};  ///< of noise; empty: none
    double silent_after_s = 0.0;  ///< 0, never: a sensor that a sanitizer slows down is not silent
    double forget_after_s = 0.0;
    std::string network = "loopback";
    std::string patch = "{}";  ///< what else differs: a JSON merge patch (RFC 7396) of the configuration
  };
  /// Writes an XML file with the loopback network, where a killed process is gone after so long: a reliable writer waits for it until then.
  void write_loopback(const std::string& name, int lease_s) const;
  /// Writes the configuration that start_daemon() would.
  void write_config(const DaemonOptions& options, const std::string& name = "gyrod.json") const;
  /// Writes the configuration and starts the daemon; waits until it serves. Overload is out of reach, so that
  /// results do not depend on the machine.
  std::unique_ptr<Process> start_daemon(const DaemonOptions& options);
  std::unique_ptr<Process> start_daemon() { return start_daemon(DaemonOptions{}); }
  /// Starts `gyrod record` of a topic and waits until it listens to the daemon.
  std::unique_ptr<Process> start_recorder(const std::string& out, const std::vector<std::string>& arguments,
                                          const std::string& topic = "gyro/denoised");
  /// SIGTERM, and the exit code.
  int stop_daemon(Process& daemon);

  /// One metric of the daemon, e.g. `gyrod_samples_rejected_total{reason="duplicate"}`; nothing if it is not
  /// there.
  [[nodiscard]] static std::optional<double> metric(const Process& daemon, const std::string& series);
  /// The same, -1 if it is not there.
  [[nodiscard]] static double of(const Process& daemon, const std::string& series) {
    return metric(daemon, series).value_or(-1.0);
  }
  /// Whether the daemon has found somebody who reads this topic of its output: what it publishes earlier is lost where nothing is repaired.
  [[nodiscard]] static bool has_reader(const Process& daemon, const std::string& topic) {
    return of(daemon, "gyrod_bus_matched_readers{topic=\"" + topic + "\"}") >= 1.0;
  }
  /// Whether, in one answer of the daemon, received = published + rejected + in flight.
  [[nodiscard]] static bool is_balanced(const Process& daemon);
  /// Body of a GET on the daemon's port; empty if that fails.
  [[nodiscard]] static std::string get(const Process& daemon, const std::string& target);
  /// Its HTTP port, from its log.
  [[nodiscard]] static int port_of(const Process& daemon);

  [[nodiscard]] std::uint32_t domain_id() const noexcept { return domain_; }
  [[nodiscard]] std::string config() const { return path("gyrod.json"); }
  [[nodiscard]] const std::string& binary() const noexcept { return binary_; }

 private:
  ScratchFolder folder_;
  std::string binary_;
  std::uint32_t domain_;
  int started_ = 0;
};

/// A JSON object with what another one says besides (merge patch, RFC 7396).
[[nodiscard]] std::string merged(const std::string& json, const std::string& patch);

/// A whole file.
[[nodiscard]] std::string read_text(const std::string& file);

/// Columns of a CSV file by name, as text, row by row: "a,b" for two of them. @pre the columns exist
[[nodiscard]] std::vector<std::string> columns_of(const std::string& file,
                                                  const std::vector<std::string>& names);

/// A recording with sample, stamp_ns and rates in rad/s: slow motion with noise from a fixed generator.
[[nodiscard]] std::string noisy_recording(std::uint64_t samples);

}  // namespace gyrod::testing
