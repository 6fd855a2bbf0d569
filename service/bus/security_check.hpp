/// Whether the files of DDS Security fit together, found out before DDS is asked: its own answers name no file, and some faults it
/// does not notice, such as a key that belongs to another certificate.
#pragma once

#include <chrono>
#include <string>

#include "bus/security_files.hpp"
#include "secrets/access.hpp"

namespace gyrod::bus {

/// Who we are, and until when.
struct Identity {
  std::string subject;  ///< of the certificate, RFC 2253
  std::chrono::sys_seconds
      expires_at;             ///< when the first of the certificates in use ends: ours or an authority's
  std::string expiring_file;  ///< which one that is
};

/// Whose the private key has to be.
using KeyOwner = secrets::FileOwner;

/// Checks in this order: all files are there and can be read; nobody but the owner may read the key, nobody but the owner and group
/// may change any file; every certificate holds now; ours is signed by the identity authority; the key is its key; both documents are
/// signed by the permissions authority; the permissions have a grant for our subject. What the grant allows, and whether both documents cover a domain, is for DDS to say.
///
/// Who may use the key: secrets/access.hpp.
/// @throws SecurityError at the first trouble, naming the file, what it holds, and what was expected
[[nodiscard]] Identity check_security(const SecurityFiles& files, std::chrono::sys_seconds now,
                                      KeyOwner owner = KeyOwner::kThisUser);

}  // namespace gyrod::bus
