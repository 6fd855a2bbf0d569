/// Rows of comma-separated text (RFC 4180 without line ends inside quotes). Views into the row, nothing is
/// copied.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gyrod::files {

/// Cuts a row into its cells as they stand there, quotes and blanks included; joined by `separator` they give
/// the row again. Reuses the memory of `cells`.
/// @return false if a quoted cell does not end
[[nodiscard]] bool split_row(std::string_view row, char separator, std::vector<std::string_view>& cells);

/// The cell without the blanks around it and without its quotes. Doubled quotes inside stay doubled.
[[nodiscard]] std::string_view bare(std::string_view cell) noexcept;

/// The text between quotes for a message: bytes that do not print become '?', and what is long is cut.
[[nodiscard]] std::string shown(std::string_view text);

}  // namespace gyrod::files
