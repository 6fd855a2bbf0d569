/// X.509 certificates and private keys, as far as DDS Security needs them checked. Internal to bus/: includes OpenSSL's headers.
#pragma once

#include <chrono>
#include <memory>
#include <openssl/evp.h>
#include <openssl/x509.h>
#include <string>

namespace gyrod::bus {

/// Calls one of OpenSSL's free functions.
template <auto free>
struct FreeWith {
  template <class T>
  void operator()(T* object) const noexcept {
    free(object);
  }
};

using PrivateKey = std::unique_ptr<EVP_PKEY, FreeWith<EVP_PKEY_free>>;

/// A file's text. @throws SecurityError naming it
[[nodiscard]] std::string read_security_file(const std::string& path);

/// What OpenSSL says about what failed last, e.g. "digest failure". Empties its list.
[[nodiscard]] std::string openssl_reason();

/// UTC, e.g. "2026-11-21T23:30:00Z".
[[nodiscard]] std::string utc_text(std::chrono::sys_seconds time);

/// @throws SecurityError naming the file, if it holds no key, or one behind a passphrase
[[nodiscard]] PrivateKey read_private_key(const std::string& path);

/// The first certificate of a PEM file.
class Certificate {
 public:
  /// @throws SecurityError naming the file
  explicit Certificate(const std::string& path);

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  /// As DDS Security compares it: RFC 2253, e.g. "CN=imu1,O=Fleet".
  [[nodiscard]] std::string subject() const;
  [[nodiscard]] std::chrono::sys_seconds not_before() const;
  [[nodiscard]] std::chrono::sys_seconds not_after() const;

  /// Whether it holds at this time. @throws SecurityError naming the file, both times and what to do
  void check_time(std::chrono::sys_seconds now) const;
  /// @throws SecurityError naming both files, if that authority has not signed it
  void check_issuer(const Certificate& authority) const;
  /// @throws SecurityError naming both files, if that is not its private key
  void check_key(const PrivateKey& key, const std::string& key_path) const;

  [[nodiscard]] X509* get() const noexcept { return certificate_.get(); }

 private:
  std::string path_;
  std::unique_ptr<X509, FreeWith<X509_free>> certificate_;
};

/// A store that trusts one authority, whatever the time. @throws SecurityError
[[nodiscard]] std::unique_ptr<X509_STORE, FreeWith<X509_STORE_free>> trust_in(const Certificate& authority);

}  // namespace gyrod::bus
