/// The files that DDS Security works with.
#pragma once

#include <string>

namespace gyrod::bus {

/// Paths of one program's files. A folder holds them under the names of a ROS 2 (SROS2) enclave, so that gyrod can use one.
struct SecurityFiles {
  std::string identity_ca;     ///< identity_ca.cert.pem: the authority that signs everyone's certificate
  std::string certificate;     ///< cert.pem: who we are
  std::string private_key;     ///< key.pem
  std::string permissions_ca;  ///< permissions_ca.cert.pem: the authority that signs the two documents
  std::string governance;      ///< governance.p7s: how the domain is protected, the same for all
  std::string permissions;     ///< permissions.p7s: what we may do
  std::string
      revocation_list;  ///< crl.pem: whose certificate holds no more; empty where there is no such file
};

[[nodiscard]] SecurityFiles security_files(const std::string& folder);

}  // namespace gyrod::bus
