/// Groups of command-line options that several subcommands share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "files/rate_unit.hpp"
#include "files/recording_reader.hpp"
#include "settings/settings.hpp"

namespace gyrod::app {

/// Where the bus is.
struct BusFlags {
  std::string config;
  std::optional<std::uint32_t> domain;
  std::optional<std::string> network;
  std::optional<std::string> security;

  void add_to(CLI::App& command);
  /// The configuration file's settings, or the defaults where none is named, with the flags on top.
  /// @throws settings::SettingsError
  [[nodiscard]] settings::Settings load() const;
  /// The same flags as text, "" or " --domain 3": for a command that is to be on the same bus.
  [[nodiscard]] std::string text() const;
};

/// How a recording is read.
struct RecordingFlags {
  files::ReaderOptions options;

  void add_to(CLI::App& command);
  /// What the user may not expect of --rate: that stamps come before it, and what is assumed where there is neither. Empty where nothing is.
  [[nodiscard]] std::string rate_note(const files::RecordingReader& reader) const;

 private:
  const CLI::Option* rate_ = nullptr;
};

/// How fast samples are sent: by their stamps.
struct SpeedFlag {
  /// Times real time; 0: as fast as readers take them.
  double speed = 1.0;

  void add_to(CLI::App& command);
};

/// Checks of option values. Unlike CLI11's own, they do not add their limits to the option's line in the
/// help, where the text says what is meant.
[[nodiscard]] CLI::Validator in_range(double least, double most);
[[nodiscard]] CLI::Validator whole_in_range(std::uint64_t least, std::uint64_t most);
[[nodiscard]] CLI::Validator sensor_id();
[[nodiscard]] CLI::Validator one_of(const std::vector<std::string>& words);

/// Adds --unit, which sets the unit of the angular rates in an output file.
void add_unit(CLI::App& command, files::RateUnit& unit);

/// Settings of a configuration file, or the defaults where none is named. @throws settings::SettingsError
[[nodiscard]] settings::Settings load_or_default(const std::string& config);

}  // namespace gyrod::app
