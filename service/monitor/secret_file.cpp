#include "monitor/secret_file.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace gyrod::monitor {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{1} << 20U;

/// Whether systemd has put the file there for this service.
bool is_credential(const std::string& file) {
  const char* folder = std::getenv("CREDENTIALS_DIRECTORY");
  std::error_code error;
  return folder != nullptr && fs::equivalent(fs::path(file).parent_path(), folder, error);
}

void check_access(const std::string& path, FileOwner owner) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0)
    throw AccessError(path, std::string("cannot be read: ") + std::strerror(errno));
  const bool credential = is_credential(path);
  // systemd may let the service in by an access control list, whose mask shows in the place of the group's bits.
  const mode_t forbidden = credential ? S_IRWXO : S_IRWXG | S_IRWXO;
  if ((status.st_mode & forbidden) != 0) {
    std::array<char, 8> mode{};
    std::snprintf(mode.data(), mode.size(), "%04o", static_cast<unsigned>(status.st_mode & 07777U));
    throw AccessError(path, std::string("its mode is ") + mode.data() +
                                ": others than its owner may use it; expected 0600 or 0400");
  }
  const bool ours = status.st_uid == geteuid() || (credential && status.st_uid == 0);
  if (owner == FileOwner::kAnyUser || ours) return;
  throw AccessError(path, "belongs to user " + std::to_string(status.st_uid) + ", but gyrod runs as user " +
                              std::to_string(geteuid()) +
                              "; expected a file of its own, or one by systemd's LoadCredential=");
}

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
  check_access(path, owner);
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
