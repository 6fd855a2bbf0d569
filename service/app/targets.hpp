/// Files that a command writes to.
#pragma once

#include <span>
#include <string>

namespace gyrod::app {

/// A file on the command line.
struct NamedFile {
  std::string option;  ///< as the user wrote it
  std::string path;    ///< empty where it was not given; "-" for a standard stream
};

/// Refuses to write one file twice, or over one that is read: a recording replaced by what was made of it is lost. Two names of one regular
/// file count as one file.
/// @throws CLI::ValidationError that names both options
void require_apart(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs);

}  // namespace gyrod::app
