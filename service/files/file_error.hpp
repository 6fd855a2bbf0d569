/// The one exception of this room: the file is not what it should be, or cannot be read or written.
#pragma once

#include <stdexcept>

namespace gyrod::files {

/// what() names the file, and where it helps the line and the column, the value found and what was expected.
class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace gyrod::files
