#include "monitor/secret_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sys/stat.h>

namespace gyrod::monitor {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20U;

}  // namespace

std::string read_file(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string text(kMaxBytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file.is_open() || file.bad() || errno == EISDIR)
    throw AccessError(path, std::string("cannot be read: ") + std::strerror(errno));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.empty()) throw AccessError(path, "is empty");
  if (text.size() > kMaxBytes) throw AccessError(path, "has more than 1 MiB");
  return text;
}

std::string read_secret_file(const std::string& path, FileOwner owner) {
  if (const std::string trouble = secrets::access_trouble(path, owner); !trouble.empty())
    throw AccessError(path, trouble);
  return read_file(path);
}

bool FileWatch::changed() {
  const std::optional<Stamp> now = stamp();
  if (!now || now == seen_) return false;
  seen_ = now;
  return true;
}

std::optional<FileWatch::Stamp> FileWatch::stamp() const {
  struct stat status {};
  if (stat(path_.c_str(), &status) != 0) return std::nullopt;
  constexpr std::int64_t kNsPerSecond = 1'000'000'000;
  return Stamp{status.st_ctim.tv_sec * kNsPerSecond + status.st_ctim.tv_nsec, status.st_ino, status.st_size};
}

}  // namespace gyrod::monitor
