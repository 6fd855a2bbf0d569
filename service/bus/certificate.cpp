#include "bus/certificate.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509_vfy.h>

#include "bus/security_error.hpp"

namespace gyrod::bus {
namespace {

using Bio = std::unique_ptr<BIO, FreeWith<BIO_free>>;

Bio bio_of(const std::string& text) {
  return Bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

/// Nobody is there to be asked.
int no_passphrase(char*, int, int, void*) { return 0; }

std::chrono::sys_seconds time_of(const ASN1_TIME* time) {
  std::tm fields{};
  if (ASN1_TIME_to_tm(time, &fields) != 1) return {};
  return std::chrono::sys_seconds(std::chrono::seconds(timegm(&fields)));
}

}  // namespace

std::string read_security_file(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file || errno == EISDIR)
    throw SecurityError(path, std::string("cannot be read: ") + std::strerror(errno));
  if (text.empty()) throw SecurityError(path, "is empty");
  return text;
}

std::string openssl_reason() {
  const char* reason = ERR_reason_error_string(ERR_peek_last_error());
  ERR_clear_error();
  return reason == nullptr ? "no reason given" : reason;
}

std::string utc_text(std::chrono::sys_seconds time) {
  const std::time_t seconds = time.time_since_epoch().count();
  std::tm fields{};
  gmtime_r(&seconds, &fields);
  std::array<char, 32> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &fields)};
}

PrivateKey read_private_key(const std::string& path) {
  std::string text = read_security_file(path);
  PrivateKey key(PEM_read_bio_PrivateKey(bio_of(text).get(), nullptr, no_passphrase, nullptr));
  OPENSSL_cleanse(text.data(), text.size());
  if (key == nullptr) {
    throw SecurityError(
        path, "no private key (" + openssl_reason() + "); expected one in PEM, without a passphrase");
  }
  return key;
}

Certificate::Certificate(const std::string& path)
    : path_(path),
      certificate_(PEM_read_bio_X509(bio_of(read_security_file(path)).get(), nullptr, nullptr, nullptr)) {
  if (certificate_ == nullptr)
    throw SecurityError(path, "no certificate (" + openssl_reason() + "); expected one in PEM");
}

std::string Certificate::subject() const {
  const Bio out(BIO_new(BIO_s_mem()));
  X509_NAME_print_ex(out.get(), X509_get_subject_name(get()), 0, XN_FLAG_RFC2253);
  char* text = nullptr;
  const long size = BIO_get_mem_data(out.get(), &text);
  return {text, static_cast<std::size_t>(size)};
}

std::chrono::sys_seconds Certificate::not_before() const { return time_of(X509_get0_notBefore(get())); }
std::chrono::sys_seconds Certificate::not_after() const { return time_of(X509_get0_notAfter(get())); }

void Certificate::check_time(std::chrono::sys_seconds now) const {
  const std::string expected = "; expected one that holds now, " + utc_text(now);
  if (now > not_after()) {
    throw SecurityError(path_, "the certificate of '" + subject() + "' expired at " + utc_text(not_after()) +
                                   expected + ": renew it");
  }
  if (now < not_before()) {
    throw SecurityError(path_, "the certificate of '" + subject() + "' holds only from " +
                                   utc_text(not_before()) + " on" + expected +
                                   ": is this machine's clock right?");
  }
}

void Certificate::check_issuer(const Certificate& authority) const {
  const auto store = trust_in(authority);
  const std::unique_ptr<X509_STORE_CTX, FreeWith<X509_STORE_CTX_free>> context(X509_STORE_CTX_new());
  const bool ready = X509_STORE_CTX_init(context.get(), store.get(), get(), nullptr) == 1;
  if (ready && X509_verify_cert(context.get()) == 1) return;
  const std::string reason = X509_verify_cert_error_string(X509_STORE_CTX_get_error(context.get()));
  ERR_clear_error();
  throw SecurityError(path_, "the certificate of '" + subject() + "' is not signed by '" +
                                 authority.subject() + "' (" + reason + "); expected the authority in '" +
                                 authority.path() + "'");
}

void Certificate::check_key(const PrivateKey& key, const std::string& key_path) const {
  const bool same = X509_check_private_key(get(), key.get()) == 1;
  ERR_clear_error();
  if (same) return;
  throw SecurityError(key_path, "does not belong to the certificate of '" + subject() +
                                    "'; expected the key of '" + path_ + "'");
}

std::unique_ptr<X509_STORE, FreeWith<X509_STORE_free>> trust_in(const Certificate& authority) {
  std::unique_ptr<X509_STORE, FreeWith<X509_STORE_free>> store(X509_STORE_new());
  if (store == nullptr || X509_STORE_add_cert(store.get(), authority.get()) != 1)
    throw SecurityError(authority.path(), "cannot be used: " + openssl_reason());
  // Times are checked one by one, where the message can name the file.
  X509_STORE_set_flags(store.get(), X509_V_FLAG_NO_CHECK_TIME);
  return store;
}

}  // namespace gyrod::bus
