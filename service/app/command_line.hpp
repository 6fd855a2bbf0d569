/// From the command line to an exit code.
#pragma once

namespace gyrod::app {

/// Parses, does what the subcommand says, and turns what it throws into a line on standard error and an
/// ExitCode.
[[nodiscard]] int run_command_line(int argc, const char* const* argv) noexcept;

}  // namespace gyrod::app
