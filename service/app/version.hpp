/// Which gyrod this is.
#pragma once

#include <string>

namespace gyrod::app {

/// E.g. "0.1.0".
[[nodiscard]] const char* version() noexcept;

/// "gyrod 0.1.0" and, line by line, the libraries it is built on.
[[nodiscard]] std::string version_text();

}  // namespace gyrod::app
