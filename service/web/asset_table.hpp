/// What CMake built into the binary, as one table.
#pragma once

#include <span>
#include <string_view>

namespace gyrod::web {

struct Asset {
  std::string_view name;
  std::string_view hash;  ///< "sha256-...", as a Content-Security-Policy names it
  std::string_view text;
};

/// All of them, in the order of CMakeLists.txt.
[[nodiscard]] std::span<const Asset> assets() noexcept;

}  // namespace gyrod::web
