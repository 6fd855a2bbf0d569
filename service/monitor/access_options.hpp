/// Who may reach the HTTP port, and how. Empty paths: not used.
#pragma once

#include <string>
#include <string_view>

namespace gyrod::monitor {

struct AccessOptions {
  /// PEM; ours first, then those between it and the authority. With its key: the port speaks TLS, and nothing else.
  std::string certificate_file = {};
  std::string key_file = {};
  /// One bearer token a line.
  std::string token_file = {};
  /// One `user:hash` a line, hashed as crypt(3) does.
  std::string users_file = {};

  [[nodiscard]] bool uses_tls() const noexcept { return !certificate_file.empty(); }
  [[nodiscard]] bool asks_who() const noexcept { return !token_file.empty() || !users_file.empty(); }
};

/// Whether only this machine can reach a port on that address or host name.
[[nodiscard]] constexpr bool is_loopback(std::string_view address) noexcept {
  return address == "localhost" || address == "::1" || address.starts_with("127.");
}

}  // namespace gyrod::monitor
