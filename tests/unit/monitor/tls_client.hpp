/// A certificate to serve with, and a client that speaks TLS.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <openssl/bio.h>
#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <stdexcept>
#include <string>

#include "monitor/tls.hpp"
#include "unit/monitor/http_client.hpp"

namespace gyrod::monitor::test {

struct PemPair {
  std::string certificate;
  std::string key;
};

/// Self-signed. @param days until it ends; below 0: it has
inline PemPair make_certificate(const std::string& name, int days = 1) {
  EVP_PKEY* key = EVP_EC_gen("P-256");
  X509* certificate = X509_new();
  X509_set_version(certificate, 2);
  ASN1_INTEGER_set(X509_get_serialNumber(certificate), 1);
  X509_gmtime_adj(X509_getm_notBefore(certificate), -7L * 86'400);
  X509_gmtime_adj(X509_getm_notAfter(certificate), days * 86'400L);
  X509_set_pubkey(certificate, key);
  X509_NAME* subject = X509_get_subject_name(certificate);
  X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_ASC,
                             reinterpret_cast<const unsigned char*>(name.c_str()), -1, -1, 0);
  X509_set_issuer_name(certificate, subject);
  X509_sign(certificate, key, EVP_sha256());
  const auto text_of = [](auto write) {
    BIO* out = BIO_new(BIO_s_mem());
    write(out);
    char* text = nullptr;
    const long size = BIO_get_mem_data(out, &text);
    std::string pem(text, static_cast<std::size_t>(size));
    BIO_free(out);
    return pem;
  };
  PemPair pair{text_of([&](BIO* out) { PEM_write_bio_X509(out, certificate); }), text_of([&](BIO* out) {
                 PEM_write_bio_PrivateKey(out, key, nullptr, nullptr, 0, nullptr, nullptr);
               })};
  X509_free(certificate);
  EVP_PKEY_free(key);
  return pair;
}

/// Believes any certificate, and says whose it was.
class TlsClient {
 public:
  explicit TlsClient(std::uint16_t port, int max_version = 0)
      : client_(port), context_(SSL_CTX_new(TLS_client_method())), ssl_(SSL_new(context_.get())) {
    if (max_version != 0) SSL_set_max_proto_version(ssl_.get(), max_version);
    SSL_set_min_proto_version(ssl_.get(), TLS1_VERSION);
    SSL_set_security_level(ssl_.get(), 0);
    SSL_set_fd(ssl_.get(), client_.descriptor());
    connected_ = SSL_connect(ssl_.get()) == 1;
  }

  [[nodiscard]] bool connected() const { return connected_; }
  /// CN of the server's certificate.
  [[nodiscard]] std::string server() const {
    std::string name(64, '\0');
    X509* certificate = SSL_get1_peer_certificate(ssl_.get());
    if (certificate == nullptr) return {};
    const int size = X509_NAME_get_text_by_NID(X509_get_subject_name(certificate), NID_commonName,
                                               name.data(), static_cast<int>(name.size()));
    X509_free(certificate);
    name.resize(static_cast<std::size_t>(std::max(size, 0)));
    return name;
  }

  bool send(const std::string& text) {
    return SSL_write(ssl_.get(), text.data(), static_cast<int>(text.size())) == static_cast<int>(text.size());
  }

  /// Until `mark`, or all of it.
  [[nodiscard]] std::string receive_until(const std::string& mark) {
    std::string received;
    std::string piece(16'384, '\0');
    int count = 0;
    while ((count = SSL_read(ssl_.get(), piece.data(), static_cast<int>(piece.size()))) > 0) {
      received.append(piece, 0, static_cast<std::size_t>(count));
      if (!mark.empty() && received.find(mark) != std::string::npos) break;
    }
    return received;
  }

  [[nodiscard]] std::string get(const std::string& path, const std::string& headers = {}) {
    (void)send("GET " + path + " HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n" + headers + "\r\n");
    return receive_until({});
  }

 private:
  HttpClient client_;
  SslContext context_;
  Ssl ssl_;
  bool connected_ = false;
};

}  // namespace gyrod::monitor::test
