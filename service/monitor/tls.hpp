/// TLS for the HTTP port, by OpenSSL.
#pragma once

#include <memory>
#include <mutex>
#include <openssl/ssl.h>
#include <string>

#include "monitor/secret_file.hpp"

namespace gyrod::monitor {

struct FreeSsl {
  void operator()(SSL* ssl) const noexcept { SSL_free(ssl); }
  void operator()(SSL_CTX* context) const noexcept { SSL_CTX_free(context); }
};
using Ssl = std::unique_ptr<SSL, FreeSsl>;
using SslContext = std::unique_ptr<SSL_CTX, FreeSsl>;

/// TLS 1.2 and 1.3 with one certificate.
/// @throws AccessError naming the file that is no good
[[nodiscard]] SslContext make_tls(const std::string& certificate_file, const std::string& key_file,
                                  FileOwner owner);

/// Gives each connection its TLS, with the certificate that is in the files then. Thread-safe.
class Tls {
 public:
  /// @throws AccessError
  Tls(const std::string& certificate_file, const std::string& key_file);

  /// @return for a connected socket; none if there is no memory
  [[nodiscard]] Ssl serve(int descriptor);
  /// Looks whether there is a new certificate; connections that are open keep theirs.
  /// @return whether there was
  /// @throws AccessError where it is no good: the one before stays
  bool renew();

 private:
  FileWatch certificate_;
  FileWatch key_;
  std::mutex mutex_;
  SslContext context_;  ///< guarded by the mutex
};

}  // namespace gyrod::monitor
