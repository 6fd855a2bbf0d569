#include <chrono>
#include <cstdio>

#include "app/command.hpp"
#include "app/exit_code.hpp"
#include "app/options.hpp"
#include "bus/security_check.hpp"
#include "monitor/gate.hpp"
#include "settings/load.hpp"
#include "settings/unused_keys.hpp"

namespace gyrod::app {
namespace {

int validate(const std::string& config) {
  const settings::Settings settings = settings::load_settings(config);
  if (!settings.bus.security.folder.empty()) {
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    (void)bus::check_security(bus::security_files(settings.bus.security.folder), now,
                              bus::KeyOwner::kAnyUser);
  }
  if (settings.monitor.enabled)
    monitor::check_access(monitor_options(settings.monitor).access, monitor::FileOwner::kAnyUser);
  std::printf("%s is valid\n", config.c_str());
  for (const std::string& line : settings::unused_keys(settings)) std::printf("  unused: %s\n", line.c_str());
  return kDone;
}

}  // namespace

void add_validate(CLI::App& parser, Action& chosen) {
  CLI::App* command =
      parser.add_subcommand("validate", "Check a configuration file and report all its errors");
  const auto config = std::make_shared<std::string>();
  command->add_option("--config,config", *config, "Configuration file; config/gyrod.json shows every key")
      ->type_name("FILE")
      ->required();
  command->footer(
      "Every error is reported at once: the key, its value, and what was expected.\n"
      "What is set in vain, a key of the other denoise.method, is named as well and is no error.\n"
      "The files of bus.security.folder, monitor.tls and monitor.auth are checked, too, for whatever\n"
      "user will run gyrod.\n"
      "Exit code 0 if there is no error, 7 for those files, else 3.\n\n"
      "Example:\n  gyrod validate --config /etc/gyrod/gyrod.json");
  command->callback([&chosen, config] { chosen = [config](Interrupt&) { return validate(*config); }; });
}

}  // namespace gyrod::app
