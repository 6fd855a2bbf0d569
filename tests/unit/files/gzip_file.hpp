/// Gzip files for tests.
#pragma once

#include <string>
#include <string_view>

#include <zlib.h>

#include "support/scratch_folder.hpp"

namespace gyrod::testing {

/// Writes a gzip file, whatever its name. @return its path
inline std::string write_gzip(const ScratchFolder& folder, std::string_view name, std::string_view text) {
  const std::string path = folder.path(name);
  const gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  return path;
}

}  // namespace gyrod::testing
