/// Files that hold what nobody else may know.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <sys/types.h>

#include "secrets/access.hpp"

namespace gyrod::monitor {

/// A certificate, key, token or password file is no good. what() names the file, what is wrong, and what was expected;
/// never what the file holds.
class AccessError : public std::runtime_error {
 public:
  AccessError(const std::string& file, const std::string& trouble)
      : std::runtime_error("'" + file + "': " + trouble) {}
};

using secrets::FileOwner;

/// @throws AccessError where it cannot be read, is empty, or has more than 1 MiB
[[nodiscard]] std::string read_file(const std::string& path);

/// The same, for what others must not read.
/// @throws AccessError also where they could, or it belongs to somebody else (secrets/access.hpp)
[[nodiscard]] std::string read_secret_file(const std::string& path, FileOwner owner);

/// Notices that a file is another one than before.
class FileWatch {
 public:
  explicit FileWatch(std::string path) : path_(std::move(path)), seen_(stamp()) {}
  /// @return true once after each change of what is in it or of who may read it; not while it is missing
  [[nodiscard]] bool changed();
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  struct Stamp {
    std::int64_t changed_ns = 0;
    ino_t inode = 0;
    off_t bytes = 0;
    bool operator==(const Stamp&) const = default;
  };
  [[nodiscard]] std::optional<Stamp> stamp() const;

  std::string path_;
  std::optional<Stamp> seen_;
};

}  // namespace gyrod::monitor
