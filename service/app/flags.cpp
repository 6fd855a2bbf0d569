#include "app/flags.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "settings/load.hpp"
#include "stream/registry.hpp"

namespace gyrod::app {
namespace {

/// Text to speed: "max" or a number above 0. CLI11 hands text that fails to the user.
std::string check_speed(const std::string& text) {
  if (text == "max") return {};
  double speed = 0.0;
  const bool good = CLI::detail::lexical_cast(text, speed) && speed > 0.0 && speed <= 1e6;
  return good ? std::string{} : "--speed is '" + text + "'; expected a number above 0, up to 1e6, or max";
}

}  // namespace

void BusFlags::add_to(CLI::App& command) {
  command
      .add_option("--config", config, "Configuration file: domain, network and topic names are taken from it")
      ->type_name("FILE");
  command.add_option("--domain", domain, "DDS domain, 0 to 230 [as configured, else 0]")
      ->type_name("N")
      ->check(whole_in_range(0, 230));
  command
      .add_option("--network", network,
                  "loopback: this machine only; default: as CYCLONEDDS_URI says or Cyclone DDS finds it;\n"
                  "else a Cyclone DDS XML file [as configured, else loopback]")
      ->type_name("NET");
  command
      .add_option("--security", security,
                  "DDS Security with the certificate, key and permissions in this folder\n"
                  "(deploy/security/make.sh makes some) [as configured, else none]")
      ->type_name("FOLDER");
}

settings::Settings BusFlags::load() const {
  settings::Settings settings = load_or_default(config);
  if (domain) settings.bus.domain = *domain;
  if (network) settings.bus.network = *network;
  if (security) settings.bus.security.folder = *security;
  return settings;
}

std::string BusFlags::text() const {
  std::string text;
  if (!config.empty()) text += " --config " + std::filesystem::absolute(config).string();
  if (domain) text += " --domain " + std::to_string(*domain);
  if (network) text += " --network " + *network;
  if (security) text += " --security " + std::filesystem::absolute(*security).string();
  return text;
}

void RecordingFlags::add_to(CLI::App& command) {
  rate_ = command
              .add_option("--rate", options.nominal_rate_hz,
                          "Sample rate in Hz where the file has no time column [100]")
              ->type_name("HZ")
              ->check(in_range(1e-3, 1e6));
  command.add_flag("--allow-missing-axes", options.allow_missing_axes,
                   "Take a file without one or two of the axes; they count as 0");
  command.add_flag("--skip-broken-rows", options.skip_broken_rows,
                   "Leave out and count rows that cannot be read, instead of ending with an error");
}

std::string RecordingFlags::rate_note(const files::RecordingReader& reader) const {
  const bool given = rate_ != nullptr && !rate_->empty();
  if (given && !reader.stamps_made_up()) return "--rate is not used: the recording has a time column";
  if (given || !reader.stamps_made_up()) return "";
  std::ostringstream note;
  note << "no time column: taken at " << options.nominal_rate_hz << " Hz; --rate says otherwise";
  return note.str();
}

void SpeedFlag::add_to(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--speed", [this](const std::string& text) { speed = text == "max" ? 0.0 : std::stod(text); },
          "Times real time, e.g. 10; max: as fast as readers take them [1]")
      ->type_name("X|max")
      ->check(check_speed);
}

void add_unit(CLI::App& command, files::RateUnit& unit) {
  command
      .add_option_function<std::string>(
          "--unit", [&unit](const std::string& text) { unit = *files::rate_unit_of(text); },
          "Unit of the file: radps (all bits), mradps, dps, mdps, dph [radps]")
      ->type_name("UNIT")
      ->check(one_of({"radps", "mradps", "dps", "mdps", "dph"}));
}

CLI::Validator in_range(double least, double most) {
  const auto check = [least, most](const std::string& text) {
    double value = 0.0;
    if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most) return std::string{};
    std::ostringstream complaint;
    complaint << "'" << text << "' given; expected a number from " << least << " to " << most;
    return complaint.str();
  };
  return {check, ""};
}

CLI::Validator whole_in_range(std::uint64_t least, std::uint64_t most) {
  const auto check = [least, most](const std::string& text) {
    const bool digits =
        !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
    std::uint64_t value = 0;
    if (digits && CLI::detail::lexical_cast(text, value) && value >= least && value <= most)
      return std::string{};
    return "'" + text + "' given; expected a whole number from " + std::to_string(least) + " to " +
           std::to_string(most);
  };
  return {check, ""};
}

CLI::Validator sensor_id() {
  const auto check = [](const std::string& text) {
    if (stream::is_valid_sensor_id(text)) return std::string{};
    return "'" + text + "' given; expected 1 to 64 printable ASCII characters without spaces";
  };
  return {check, ""};
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  CLI::IsMember member(words);
  member.description("");
  return member;
}

settings::Settings load_or_default(const std::string& config) {
  return config.empty() ? settings::Settings{} : settings::load_settings(config);
}

}  // namespace gyrod::app
