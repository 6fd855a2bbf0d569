/// Who may use a file that holds what nobody else may know: a private key, tokens, passwords.
#pragma once

#include <string>
#include <sys/types.h>

namespace gyrod::secrets {

/// Whose a secret file has to be.
enum class FileOwner {
  kThisUser,  ///< the user that this process runs as
  kAnyUser,   ///< for a check on behalf of a service that runs as another one
};

/// Whether others could read the file, or it is another user's. One that systemd hands over (LoadCredential=, in
/// $CREDENTIALS_DIRECTORY) may belong to root: systemd lets only the service read it.
/// @return what is wrong and what was expected, without the file's name; empty if nothing is
[[nodiscard]] std::string access_trouble(const std::string& path, FileOwner owner);

/// A mode as chmod takes it, "0640".
[[nodiscard]] std::string octal(mode_t mode);

}  // namespace gyrod::secrets
