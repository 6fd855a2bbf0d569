#include "support/security_folder.hpp"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <stdexcept>

#include "support/process.hpp"

namespace gyrod::testing {
namespace {

namespace fs = std::filesystem;

std::string source_dir() {
  const char* dir = std::getenv("GYROD_SOURCE_DIR");
  return dir == nullptr ? "." : dir;
}

struct Close {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

File open(const std::string& path, const char* mode) {
  File file(std::fopen(path.c_str(), mode));
  if (file == nullptr) throw std::runtime_error("cannot open " + path);
  return file;
}

}  // namespace

SecurityFolder::SecurityFolder(const std::vector<std::string>& arguments) { make(arguments); }

std::string SecurityFolder::make(const std::vector<std::string>& arguments) const {
  std::vector<std::string> command = {"/bin/bash", source_dir() + "/deploy/security/make.sh",
                                      scratch_.path("made")};
  command.insert(command.end(), arguments.begin(), arguments.end());
  Process script(command, scratch_.path(), "make");
  if (script.wait() != 0) throw std::runtime_error("make.sh: " + script.err());
  return script.out();
}

std::string SecurityFolder::copy(const std::string& program, const std::string& name) const {
  fs::copy(of(program), of(name), fs::copy_options::recursive);
  return of(name);
}

void SecurityFolder::reissue(const std::string& folder, std::chrono::seconds from_now,
                             std::chrono::seconds until) const {
  const std::string file = folder + "/cert.pem";
  X509* certificate = PEM_read_X509(open(file, "r").get(), nullptr, nullptr, nullptr);
  EVP_PKEY* authority = PEM_read_PrivateKey(open(of("ca/key.pem"), "r").get(), nullptr, nullptr, nullptr);
  X509_gmtime_adj(X509_getm_notBefore(certificate), from_now.count());
  X509_gmtime_adj(X509_getm_notAfter(certificate), until.count());
  const bool done = X509_sign(certificate, authority, EVP_sha256()) > 0 &&
                    PEM_write_X509(open(file, "w").get(), certificate) == 1;
  EVP_PKEY_free(authority);
  X509_free(certificate);
  if (!done) throw std::runtime_error("cannot sign " + file);
}

void SecurityFolder::sign(const std::string& xml, const std::string& file) const {
  const std::string text = scratch_.write("unsigned.xml", xml);
  Process openssl({"/usr/bin/openssl", "smime", "-sign", "-text", "-in", text, "-signer", of("ca/cert.pem"),
                   "-inkey", of("ca/key.pem"), "-out", file},
                  scratch_.path(), "sign");
  if (openssl.wait() != 0) throw std::runtime_error("openssl: " + openssl.err());
}

std::string security_template(const std::string& name) {
  std::ifstream file(source_dir() + "/deploy/security/templates/" + name);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (text.empty()) throw std::runtime_error("no template " + name);
  return text;
}

}  // namespace gyrod::testing
