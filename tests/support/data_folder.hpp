/// Where real recordings are; who uses them skips, with a clear word, where they are absent.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace gyrod::test {

/// GYROD_DATA; without it, ../shared/data beside the project.
inline std::filesystem::path data_folder() {
  if (const char* data = std::getenv("GYROD_DATA")) return data;
  const char* source = std::getenv("GYROD_SOURCE_DIR");
  return std::filesystem::path(source != nullptr ? source : ".") / "../shared/data";
}

}  // namespace gyrod::test
