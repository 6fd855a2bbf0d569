/// What a subcommand of the binary is.
#pragma once

#include <functional>

#include <CLI/CLI.hpp>

#include "app/interrupt.hpp"

namespace gyrod::app {

/// What a chosen subcommand does. @return an ExitCode. Errors that end it are thrown and caught once, in
/// run_command_line().
using Action = std::function<int(Interrupt&)>;

// Each adds one subcommand with its options to the parser, and sets `chosen` when the command line names it.
void add_run(CLI::App& parser, Action& chosen);
void add_validate(CLI::App& parser, Action& chosen);
void add_denoise(CLI::App& parser, Action& chosen);
void add_decompose(CLI::App& parser, Action& chosen);
void add_replay(CLI::App& parser, Action& chosen);
void add_record(CLI::App& parser, Action& chosen);
void add_simulate(CLI::App& parser, Action& chosen);
void add_report(CLI::App& parser, Action& chosen);
void add_allan(CLI::App& parser, Action& chosen);
void add_navigate(CLI::App& parser, Action& chosen);
void add_calibrate(CLI::App& parser, Action& chosen);
void add_evaluate(CLI::App& parser, Action& chosen);
void add_top(CLI::App& parser, Action& chosen);

}  // namespace gyrod::app
