#include "rig.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <unistd.h>

#include <httplib.h>
#include <nlohmann/json.hpp>

#include "support/samples.hpp"

namespace gyrod::testing {
namespace {

std::string required_variable(const char* name) {
  const char* value = std::getenv(name);
  if (value == nullptr) throw std::runtime_error(std::string(name) + " is not set; ctest sets it");
  return value;
}

/// One of the domains 80..219, beyond those of other tests. Programs of one run, side by side, differ in their
/// slot; two runs on one machine most likely in the block of thirty-five.
std::uint32_t own_domain() {
  constexpr std::uint32_t kFirst = 80;
  constexpr std::uint32_t kSlots = 35;
  constexpr std::uint32_t kBlocks = 4;
  const auto slot = static_cast<std::uint32_t>(std::stoul(required_variable("GYROD_TEST_SLOT")));
  return kFirst + static_cast<std::uint32_t>(getpid()) % kBlocks * kSlots + slot % kSlots;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

}  // namespace

Rig::Rig() : binary_(required_variable("GYROD_BINARY")), domain_(own_domain()) {}

std::unique_ptr<Process> Rig::start(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{binary_};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return std::make_unique<Process>(command, folder_.path(), "process" + std::to_string(++started_));
}

std::unique_ptr<Process> Rig::start_on_bus(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--config", config()});
  return start(arguments);
}

Rig::Result Rig::run(const std::vector<std::string>& arguments) {
  const auto process = start(arguments);
  const int exit_code = process->wait();
  return {exit_code, process->out(), process->err()};
}

Rig::Result Rig::run_on_bus(std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--config", config()});
  return run(arguments);
}

void Rig::write_loopback(const std::string& name, int lease_s) const {
  write_file(name, R"(<CycloneDDS xmlns="https://cdds.io/config"><Domain Id="any">
  <General><Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces>
    <AllowMulticast>false</AllowMulticast></General>
  <Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>120</MaxAutoParticipantIndex>
    <Peers><Peer address="127.0.0.1"/></Peers><LeaseDuration>)" +
                       std::to_string(lease_s) + R"(s</LeaseDuration></Discovery>
</Domain></CycloneDDS>)");
}

void Rig::write_config(const DaemonOptions& options, const std::string& name) const {
  nlohmann::json config = {
      {"bus",
       {{"domain", domain_},
        {"network", options.network},
        {"input", {{"max_messages", options.max_messages}}}}},
      {"denoise", {{"method", options.method}, {"window_samples", options.window_samples}}},
      {"noise", {{"state_file", options.state_file}}},
      {"limits",
       {{"max_delay_s", 3600},
        {"max_channels", options.max_channels},
        {"silent_after_s", options.silent_after_s},
        {"forget_after_s", options.forget_after_s}}},
      {"workers", options.workers},
      {"monitor", {{"port", 0}}},
      {"stop", {{"deadline_s", options.stop_deadline_s}}}};
  config.merge_patch(nlohmann::json::parse(options.patch));
  write_file(name, config.dump(2));
}

std::unique_ptr<Process> Rig::start_daemon(const DaemonOptions& options) {
  write_config(options);
  auto daemon = start({"run", "--config", config()});
  if (!daemon->wait_for_err("/metrics"))
    throw std::runtime_error("the daemon did not start: " + daemon->err());
  return daemon;
}

std::unique_ptr<Process> Rig::start_recorder(const std::string& out,
                                             const std::vector<std::string>& arguments,
                                             const std::string& topic) {
  std::vector<std::string> all = {"record", "--topic", topic, "-o", path(out)};
  all.insert(all.end(), arguments.begin(), arguments.end());
  auto recorder = start_on_bus(all);
  if (!recorder->wait_for_err("listening"))
    throw std::runtime_error("the recorder does not listen: " + recorder->err());
  return recorder;
}

int Rig::stop_daemon(Process& daemon) {
  daemon.signal(SIGTERM);
  return daemon.wait();
}

int Rig::port_of(const Process& daemon) {
  const std::string log = daemon.err();
  const std::size_t end = log.find("/metrics");
  const std::size_t colon = log.rfind(':', end);
  if (end == std::string::npos || colon == std::string::npos) throw std::runtime_error("no port in: " + log);
  return std::stoi(log.substr(colon + 1, end - colon - 1));
}

std::string Rig::get(const Process& daemon, const std::string& target) {
  httplib::Client client("127.0.0.1", port_of(daemon));
  const auto response = client.Get(target.c_str());
  return response ? response->body : std::string{};
}

std::optional<double> Rig::metric(const Process& daemon, const std::string& series) {
  std::stringstream text(get(daemon, "/metrics"));
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with(series + " ")) return std::stod(line.substr(series.size() + 1));
  }
  return std::nullopt;
}

bool Rig::is_balanced(const Process& daemon) {
  double received = -1.0;
  double accounted = 0.0;
  std::stringstream text(get(daemon, "/metrics"));
  for (std::string line; std::getline(text, line);) {
    const std::size_t end = line.rfind(' ');
    if (line.starts_with('#') || end == std::string::npos) continue;
    const std::string_view name = std::string_view(line).substr(0, line.find_first_of("{ "));
    const double value = std::strtod(line.c_str() + end, nullptr);
    if (name == "gyrod_samples_received_total") received = value;
    if (name == "gyrod_samples_published_total" || name == "gyrod_samples_in_flight" ||
        name == "gyrod_samples_rejected_total")
      accounted += value;
  }
  return received == accounted;
}

std::string merged(const std::string& json, const std::string& patch) {
  nlohmann::json both = nlohmann::json::parse(json);
  both.merge_patch(nlohmann::json::parse(patch));
  return both.dump();
}

std::string read_text(const std::string& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::vector<std::string> columns_of(const std::string& file, const std::vector<std::string>& names) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> header = cells_of(line);
  std::vector<std::size_t> columns;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(header, name);
    if (found == header.end()) throw std::runtime_error(file + " has no column " + name);
    columns.push_back(static_cast<std::size_t>(found - header.begin()));
  }
  std::vector<std::string> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = cells_of(line);
    std::string row;
    for (const std::size_t column : columns) row += (row.empty() ? "" : ",") + cells.at(column);
    rows.push_back(row);
  }
  return rows;
}

std::string noisy_recording(std::uint64_t samples) {
  std::ostringstream text;
  text.precision(17);
  text << "sequence,stamp_ns,gyro_x_radps,gyro_y_radps,gyro_z_radps\n";
  for (const stream::Sample& sample : noisy_samples(samples)) {
    text << sample.sequence << ',' << sample.stamp_ns << ',' << sample.rate_radps[0] << ','
         << sample.rate_radps[1] << ',' << sample.rate_radps[2] << '\n';
  }
  return text.str();
}

}  // namespace gyrod::testing
