#include "bus/security_files.hpp"

#include <filesystem>
#include <system_error>

namespace gyrod::bus {

SecurityFiles security_files(const std::string& folder) {
  // Absolute: Cyclone takes them as URIs.
  const std::filesystem::path root = std::filesystem::absolute(folder).lexically_normal();
  std::error_code error;
  const std::filesystem::path list = root / "crl.pem";
  return {.identity_ca = root / "identity_ca.cert.pem",
          .certificate = root / "cert.pem",
          .private_key = root / "key.pem",
          .permissions_ca = root / "permissions_ca.cert.pem",
          .governance = root / "governance.p7s",
          .permissions = root / "permissions.p7s",
          .revocation_list = std::filesystem::exists(list, error) ? list.string() : std::string{}};
}

}  // namespace gyrod::bus
