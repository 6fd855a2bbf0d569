/// Where a gyrod answers over HTTP.
#pragma once

#include <cstdint>
#include <string>

namespace gyrod::top {

struct Address {
  bool encrypted = false;
  std::string host = "127.0.0.1";  ///< of IPv6 without brackets
  std::uint16_t port = 9464;
  std::string prefix;  ///< path in front of /api, as a proxy may have one; without the last '/'

  /// scheme://host:port, without the prefix.
  [[nodiscard]] std::string origin() const;
  /// The whole of it, as a user would write it.
  [[nodiscard]] std::string url() const { return origin() + prefix; }
};

/// Reads "car7", "car7:9464", "[::1]:9464" (http, and port 9464 where none is given), or a URL with http:// or https://, whose port is
/// then 80 or 443 where none is given. @throws std::invalid_argument that names what is wrong and what was expected
[[nodiscard]] Address parse_address(const std::string& text);

}  // namespace gyrod::top
