/// A file's text, or why it cannot be had.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace gyrod::settings {

struct TextFile {
  std::string text;
  std::string trouble;   ///< empty if it was read
  bool missing = false;  ///< the trouble is that there is no such file
  bool damaged = false;  ///< the trouble is in what the file holds
};

/// Reads a regular file of at most so many MiB, plain or gzip, whatever its name; a larger one is refused before it is read, or, compressed,
/// while it is.
[[nodiscard]] TextFile read_text_file(const std::filesystem::path& file, std::size_t most_mebibytes);

}  // namespace gyrod::settings
