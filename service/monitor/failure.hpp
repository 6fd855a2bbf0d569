/// Answers that are not what was asked for.
#pragma once

#include <string_view>

#include "monitor/answer.hpp"

namespace gyrod::monitor {

/// In the form of what was asked for: JSON below /api/, else text.
[[nodiscard]] Answer failure(int status, std::string_view path, std::string_view words);

}  // namespace gyrod::monitor
