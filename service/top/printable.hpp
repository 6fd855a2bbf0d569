/// Text from the network on its way to a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gyrod::top {

/// The text with '?' in place of every byte that is not a printable ASCII character, cut to `most`: what a sensor or a server calls itself
/// must not move the cursor, change the title or look like another line. One character is one column wide.
[[nodiscard]] std::string printable(std::string_view text, std::size_t most = 256);

}  // namespace gyrod::top
