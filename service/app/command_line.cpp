#include "app/command_line.hpp"

#include <cstdio>
#include <exception>
#include <string>

#include "app/command.hpp"
#include "app/errors.hpp"
#include "app/exit_code.hpp"
#include "app/version.hpp"
#include "bus/bus_error.hpp"
#include "bus/security_error.hpp"
#include "files/file_error.hpp"
#include "monitor/secret_file.hpp"
#include "settings/json_fields.hpp"
#include "settings/load.hpp"

namespace gyrod::app {
namespace {

int complain(const std::exception& error, ExitCode code) noexcept {
  std::fprintf(stderr, "gyrod: %s\n", error.what());
  return code;
}

/// What is wrong with the first word where that is no subcommand, or nothing.
std::string unknown_command(const CLI::App& parser, int argc, const char* const* argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  if (word.empty() || word.front() == '-') return {};
  std::string message = "unknown command '" + word + "'; expected one of:";
  for (const CLI::App* command : parser.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->check_name(word)) return {};
    message += " " + command->get_name();
  }
  return message;
}

int parse_and_act(int argc, const char* const* argv) {
  CLI::App parser(
      "gyrod denoises MEMS gyroscopes: live on Cyclone DDS topics (run), or a recording (denoise).\n"
      "By the two-speed estimator (method joint) or improved EMD with AR-Kalman filtering (method paper);\n"
      "methods and sources: docs/joint.md, docs/method.md.");
  parser.name("gyrod");
  parser.set_version_flag("--version", version_text(), "Print the version and what it is built on");
  parser.require_subcommand(1);
  parser.footer(std::string("gyrod SUBCOMMAND --help explains one, with examples.\n") + kExitCodesHelp);
  Action chosen;
  for (const auto add :
       {add_run, add_validate, add_denoise, add_decompose, add_allan, add_calibrate, add_navigate, add_report,
        add_evaluate, add_replay, add_record, add_simulate, add_top})
    add(parser, chosen);
  const std::string unknown = unknown_command(parser, argc, argv);
  if (!unknown.empty()) {
    std::fprintf(stderr, "gyrod: %s\nRun with --help for more information.\n", unknown.c_str());
    return kWrongUsage;
  }
  try {
    parser.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return parser.exit(error) == 0 ? kDone : kWrongUsage;
  }
  Interrupt interrupt;
  return chosen(interrupt);
}

}  // namespace

int run_command_line(int argc, const char* const* argv) noexcept {
  try {
    return parse_and_act(argc, argv);
  } catch (const CLI::Error& error) {
    return complain(error, kWrongUsage);
  } catch (const settings::SettingsError& error) {
    return complain(error, kWrongSettings);
  } catch (const files::FileError& error) {
    return complain(error, kFileTrouble);
  } catch (const settings::NoiseFileError& error) {
    return complain(error, kFileTrouble);
  } catch (const bus::SecurityError& error) {
    return complain(error, kNotAllowed);
  } catch (const monitor::AccessError& error) {
    return complain(error, kNotAllowed);
  } catch (const bus::BusError& error) {
    return complain(error, kUnavailable);
  } catch (const Unavailable& error) {
    return complain(error, kUnavailable);
  } catch (const Incomplete& error) {
    return complain(error, kIncomplete);
  } catch (const std::exception& error) {
    return complain(error, kFailed);
  }
}

}  // namespace gyrod::app
