#include "secrets/access.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace gyrod::secrets {
namespace {

/// Whether systemd has put the file there for this service.
bool is_credential(const std::string& file) {
  const char* folder = std::getenv("CREDENTIALS_DIRECTORY");
  std::error_code error;
  return folder != nullptr &&
         std::filesystem::equivalent(std::filesystem::path(file).parent_path(), folder, error);
}

}  // namespace

std::string access_trouble(const std::string& path, FileOwner owner) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return std::string("cannot be read: ") + std::strerror(errno);
  const bool credential = is_credential(path);
  // systemd may let the service in by an access control list, whose mask shows in the place of the group's bits.
  const mode_t forbidden = credential ? S_IRWXO : S_IRWXG | S_IRWXO;
  if ((status.st_mode & forbidden) != 0) {
    return "its mode is " + octal(status.st_mode) +
           ": others than its owner may use it; expected 0600 or 0400";
  }
  const bool ours = status.st_uid == geteuid() || (credential && status.st_uid == 0);
  if (owner == FileOwner::kAnyUser || ours) return {};
  return "belongs to user " + std::to_string(status.st_uid) + ", but gyrod runs as user " +
         std::to_string(geteuid()) + "; expected a file of its own, or one by systemd's LoadCredential=";
}

std::string octal(mode_t mode) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "%04o", static_cast<unsigned>(mode & 07777U));
  return text.data();
}

}  // namespace gyrod::secrets
