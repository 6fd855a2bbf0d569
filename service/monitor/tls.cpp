#include "monitor/tls.hpp"

#include <csignal>
#include <openssl/bio.h>
#include <openssl/crypto.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <utility>

namespace gyrod::monitor {
namespace {

struct Free {
  void operator()(BIO* bio) const noexcept { BIO_free(bio); }
  void operator()(X509* certificate) const noexcept { X509_free(certificate); }
  void operator()(EVP_PKEY* key) const noexcept { EVP_PKEY_free(key); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

/// Nobody is there to be asked.
int no_passphrase(char*, int, int, void*) { return 0; }

std::string openssl_reason() {
  const char* words = ERR_reason_error_string(ERR_peek_last_error());
  ERR_clear_error();
  return words == nullptr ? "no reason given" : words;
}

/// @param text outlives it
Owned<BIO> bio_of(std::string&& text) = delete;
Owned<BIO> bio_of(const std::string& text) {
  return Owned<BIO>(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

SslContext new_context() {
  SslContext context(SSL_CTX_new(TLS_server_method()));
  if (context == nullptr) throw std::runtime_error("TLS: " + openssl_reason());
  SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION);
  // With forward secrecy and authenticated encryption only; TLS 1.3 has no others.
  SSL_CTX_set_cipher_list(context.get(), "ECDHE+AESGCM:ECDHE+CHACHA20");
  SSL_CTX_set_options(context.get(),
                      SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION | SSL_OP_IGNORE_UNEXPECTED_EOF);
  SSL_CTX_set_session_cache_mode(context.get(), SSL_SESS_CACHE_OFF);
  SSL_CTX_set_mode(context.get(), SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER |
                                      SSL_MODE_RELEASE_BUFFERS);
  return context;
}

void check_time(const std::string& file, const X509* certificate) {
  if (X509_cmp_time(X509_get0_notAfter(certificate), nullptr) < 0)
    throw AccessError(file, "the certificate has expired; expected one that holds now");
  if (X509_cmp_time(X509_get0_notBefore(certificate), nullptr) > 0)
    throw AccessError(file, "the certificate does not hold yet: is this machine's clock right?");
}

void use_certificates(SSL_CTX* context, const std::string& file) {
  const std::string text = read_file(file);
  const Owned<BIO> bio = bio_of(text);
  const Owned<X509> ours(PEM_read_bio_X509(bio.get(), nullptr, no_passphrase, nullptr));
  if (ours == nullptr)
    throw AccessError(file, "no certificate (" + openssl_reason() + "); expected one in PEM");
  check_time(file, ours.get());
  if (SSL_CTX_use_certificate(context, ours.get()) != 1)
    throw AccessError(file, "the certificate cannot be used: " + openssl_reason());
  while (X509* next = PEM_read_bio_X509(bio.get(), nullptr, no_passphrase, nullptr)) {
    if (SSL_CTX_add0_chain_cert(context, next) != 1) X509_free(next);
  }
  ERR_clear_error();  // the end of the file is one
}

void use_key(SSL_CTX* context, const std::string& file, const std::string& certificate_file,
             FileOwner owner) {
  std::string text = read_secret_file(file, owner);
  const Owned<EVP_PKEY> key(PEM_read_bio_PrivateKey(bio_of(text).get(), nullptr, no_passphrase, nullptr));
  OPENSSL_cleanse(text.data(), text.size());
  if (key == nullptr)
    throw AccessError(file,
                      "no private key (" + openssl_reason() + "); expected one in PEM, without a passphrase");
  const bool fits =
      SSL_CTX_use_PrivateKey(context, key.get()) == 1 && SSL_CTX_check_private_key(context) == 1;
  ERR_clear_error();
  if (!fits) throw AccessError(file, "does not belong to the certificate in '" + certificate_file + "'");
}

}  // namespace

SslContext make_tls(const std::string& certificate_file, const std::string& key_file, FileOwner owner) {
  SslContext context = new_context();
  use_certificates(context.get(), certificate_file);
  use_key(context.get(), key_file, certificate_file, owner);
  return context;
}

Tls::Tls(const std::string& certificate_file, const std::string& key_file)
    : certificate_(certificate_file),
      key_(key_file),
      context_(make_tls(certificate_file, key_file, FileOwner::kThisUser)) {
  // OpenSSL writes to sockets without MSG_NOSIGNAL.
  (void)std::signal(SIGPIPE, SIG_IGN);
}

Ssl Tls::serve(int descriptor) {
  const std::scoped_lock lock(mutex_);
  Ssl ssl(SSL_new(context_.get()));
  if (ssl == nullptr || SSL_set_fd(ssl.get(), descriptor) != 1) return nullptr;
  SSL_set_accept_state(ssl.get());
  return ssl;
}

bool Tls::renew() {
  const bool certificate = certificate_.changed();
  const bool key = key_.changed();
  if (!certificate && !key) return false;
  SslContext context = make_tls(certificate_.path(), key_.path(), FileOwner::kThisUser);
  const std::scoped_lock lock(mutex_);
  context_ = std::move(context);
  return true;
}

}  // namespace gyrod::monitor
