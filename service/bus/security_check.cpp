#include "bus/security_check.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pkcs7.h>
#include <sys/stat.h>
#include <vector>

#include "bus/certificate.hpp"
#include "bus/security_error.hpp"

namespace gyrod::bus {
namespace {

namespace fs = std::filesystem;
using Bio = std::unique_ptr<BIO, FreeWith<BIO_free>>;

void check_present(const SecurityFiles& files) {
  std::string missing;
  for (const std::string& file : {files.identity_ca, files.certificate, files.private_key,
                                  files.permissions_ca, files.governance, files.permissions}) {
    struct stat status {};
    if (stat(file.c_str(), &status) != 0) {
      missing += (missing.empty() ? "" : ", ") + fs::path(file).filename().string() + " (" +
                 std::strerror(errno) + ")";
      continue;
    }
    if ((status.st_mode & S_IWOTH) != 0) {
      throw SecurityError(file, "its mode is " + secrets::octal(status.st_mode) +
                                    ": anybody may change it; expected one that only its owner may write");
    }
  }
  if (missing.empty()) return;
  throw SecurityError(fs::path(files.certificate).parent_path().string(),
                      "cannot read " + missing +
                          "; expected a folder as deploy/security/make.sh or ROS 2 (an enclave) makes it");
}

/// The text of a signed document, if that authority has signed it as it stands.
std::string signed_text(const std::string& file, const Certificate& authority) {
  const std::string document = read_security_file(file);
  const Bio in(BIO_new_mem_buf(document.data(), static_cast<int>(document.size())));
  BIO* content = nullptr;
  const std::unique_ptr<PKCS7, FreeWith<PKCS7_free>> message(SMIME_read_PKCS7(in.get(), &content));
  const Bio owned_content(content);
  if (message == nullptr) {
    throw SecurityError(file, "no signed document (" + openssl_reason() +
                                  "); expected S/MIME, as of openssl smime -sign -text");
  }
  const Bio out(BIO_new(BIO_s_mem()));
  const auto store = trust_in(authority);
  if (PKCS7_verify(message.get(), nullptr, store.get(), content, out.get(), PKCS7_TEXT) != 1) {
    throw SecurityError(file, "the signature does not hold (" + openssl_reason() + "); expected that of '" +
                                  authority.subject() + "' in '" + authority.path() + "'");
  }
  char* text = nullptr;
  const long size = BIO_get_mem_data(out.get(), &text);
  return {text, static_cast<std::size_t>(size)};
}

/// Parts of a name in an order of their own: DDS does not mind theirs.
std::vector<std::string> parts_of(std::string name) {
  std::vector<std::string> parts;
  while (!name.empty()) {
    const std::size_t comma = std::min(name.find(','), name.size());
    std::string part = name.substr(0, comma);
    name.erase(0, comma + 1);
    const std::size_t first = part.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) continue;
    parts.push_back(part.substr(first, part.find_last_not_of(" \t\r\n") - first + 1));
  }
  std::ranges::sort(parts);
  return parts;
}

/// What stands in the document as <subject_name>.
std::vector<std::string> subjects_of(const std::string& permissions) {
  constexpr std::string_view kBegin = "<subject_name>";
  std::vector<std::string> subjects;
  for (std::size_t at = permissions.find(kBegin); at != std::string::npos;
       at = permissions.find(kBegin, at)) {
    at += kBegin.size();
    subjects.push_back(permissions.substr(at, permissions.find('<', at) - at));
  }
  return subjects;
}

void check_grant(const std::string& file, const std::string& permissions, const Certificate& certificate) {
  const std::string subject = certificate.subject();
  const std::vector<std::string> granted = subjects_of(permissions);
  const auto fits = [parts = parts_of(subject)](const std::string& other) {
    // A character that XML escapes is for DDS to understand.
    return parts_of(other) == parts || other.find('&') != std::string::npos;
  };
  if (std::ranges::any_of(granted, fits)) return;
  std::string others;
  for (const std::string& other : granted) others += (others.empty() ? "'" : ", '") + other + "'";
  throw SecurityError(file, "has a grant for " + (others.empty() ? "nobody" : others) +
                                "; expected one with <subject_name>" + subject +
                                "</subject_name>, who is in '" + certificate.path() + "'");
}

Identity identity_of(const std::array<const Certificate*, 3>& certificates) {
  const Certificate* first = *std::ranges::min_element(certificates, {}, &Certificate::not_after);
  return {.subject = certificates.front()->subject(),
          .expires_at = first->not_after(),
          .expiring_file = first->path()};
}

}  // namespace

Identity check_security(const SecurityFiles& files, std::chrono::sys_seconds now, KeyOwner owner) {
  ERR_clear_error();
  check_present(files);
  if (const std::string trouble = secrets::access_trouble(files.private_key, owner); !trouble.empty())
    throw SecurityError(files.private_key, trouble);
  const Certificate certificate(files.certificate);
  const Certificate identity_ca(files.identity_ca);
  const Certificate permissions_ca(files.permissions_ca);
  const std::array all{&certificate, &identity_ca, &permissions_ca};
  for (const Certificate* one : all) one->check_time(now);
  certificate.check_issuer(identity_ca);
  certificate.check_key(read_private_key(files.private_key), files.private_key);
  (void)signed_text(files.governance, permissions_ca);
  check_grant(files.permissions, signed_text(files.permissions, permissions_ca), certificate);
  return identity_of(all);
}

}  // namespace gyrod::bus
