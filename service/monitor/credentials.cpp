#include "monitor/credentials.hpp"

#include <algorithm>
#include <crypt.h>
#include <memory>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <openssl/rand.h>
#include <stdexcept>
#include <utility>

namespace gyrod::monitor {
namespace {

constexpr std::size_t kMinTokenSize = 16;
constexpr std::size_t kMaxVerified = 256;
/// Of crypt(3): SHA-256, SHA-512, bcrypt, scrypt, yescrypt.
constexpr std::array<std::string_view, 8> kSlowHashes = {"$5$",  "$6$", "$2a$", "$2b$",
                                                         "$2y$", "$7$", "$y$",  "$gy$"};
constexpr const char* kHowToHash =
    "; expected NAME:HASH with a hash by 'openssl passwd -6', mkpasswd or 'htpasswd -B'";

struct Line {
  std::size_t number = 0;
  std::string_view text;
};

/// Those that say something.
std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t'))
      line.remove_suffix(1);
    if (!line.empty() && line.front() != '#') lines.push_back({number, line});
  }
  return lines;
}

AccessError at_line(const std::string& file, const Line& line, const std::string& trouble) {
  return {file, "line " + std::to_string(line.number) + ": " + trouble};
}

/// Equal digests are equal texts; unequal ones tell nothing by the time that comparing them takes.
Digest digest_of(std::string_view text) {
  Digest digest{};
  if (EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("SHA-256 is not to be had");
  return digest;
}

Digest digest_of(const Digest& secret, std::string_view text) {
  Digest digest{};
  unsigned size = 0;
  if (HMAC(EVP_sha256(), secret.data(), static_cast<int>(secret.size()),
           reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest.data(), &size) == nullptr)
    throw std::runtime_error("HMAC is not to be had");
  return digest;
}

/// @return nothing for a setting or password that crypt(3) does not take
std::string hash_of(const std::string& password, const std::string& setting) {
  if (password.find('\0') != std::string::npos) return {};
  const auto work = std::make_unique<crypt_data>();  // 32 KiB
  const char* hash = crypt_r(password.c_str(), setting.c_str(), work.get());
  return hash == nullptr || *hash == '*' ? std::string() : std::string(hash);
}

}  // namespace

Tokens::Tokens(const std::string& file, FileOwner owner) {
  std::string text = read_secret_file(file, owner);
  for (const Line& line : lines_of(text)) {
    if (line.text.size() < kMinTokenSize || line.text.find(' ') != std::string_view::npos) {
      throw at_line(file, line,
                    "a token of less than 16 characters or with a space; expected one as "
                    "'openssl rand -hex 32' makes it");
    }
    digests_.push_back(digest_of(line.text));
  }
  OPENSSL_cleanse(text.data(), text.size());
  if (digests_.empty()) throw AccessError(file, "holds no token; expected one a line");
}

bool Tokens::holds(std::string_view token) const {
  const Digest digest = digest_of(token);
  bool found = false;
  for (const Digest& each : digests_) found |= CRYPTO_memcmp(each.data(), digest.data(), digest.size()) == 0;
  return found;
}

Users::Users(const std::string& file, FileOwner owner) {
  std::string text = read_secret_file(file, owner);
  for (const Line& line : lines_of(text)) {
    const std::size_t colon = line.text.find(':');
    if (colon == 0 || colon == std::string_view::npos)
      throw at_line(file, line, std::string("no user") + kHowToHash);
    User user{std::string(line.text.substr(0, colon)), std::string(line.text.substr(colon + 1))};
    const auto begins = [&user](std::string_view method) { return user.hash.starts_with(method); };
    if (std::ranges::none_of(kSlowHashes, begins) || hash_of("", user.hash).size() != user.hash.size())
      throw at_line(file, line, "user '" + user.name + "' has no salted slow hash" + kHowToHash);
    const auto same = [&user](const User& other) { return other.name == user.name; };
    if (std::ranges::any_of(users_, same))
      throw at_line(file, line, "user '" + user.name + "' is there twice; expected each once");
    users_.push_back(std::move(user));
  }
  OPENSSL_cleanse(text.data(), text.size());
  if (users_.empty()) throw AccessError(file, std::string("holds no user") + kHowToHash);
  if (RAND_bytes(secret_.data(), static_cast<int>(secret_.size())) != 1)
    throw std::runtime_error("random numbers are not to be had");
}

bool Users::has_held(const Digest& digest) {
  const std::scoped_lock lock(mutex_);
  return verified_.contains(digest);
}

std::optional<bool> Users::hold(std::string_view name_and_password, bool may_hash) {
  const Digest digest = digest_of(secret_, name_and_password);
  if (has_held(digest)) return true;
  if (!may_hash) return std::nullopt;
  const std::scoped_lock turn(hashing_);
  if (has_held(digest)) return true;  // a browser asks for many things at once
  const std::size_t colon = name_and_password.find(':');
  if (colon == std::string_view::npos) return false;
  if (!matches(name_and_password.substr(0, colon), std::string(name_and_password.substr(colon + 1))))
    return false;
  const std::scoped_lock lock(mutex_);
  if (verified_.size() >= kMaxVerified) verified_.clear();
  verified_.insert(digest);
  return true;
}

/// A name that is not there takes as long as one that is.
bool Users::matches(std::string_view name, const std::string& password) const {
  const auto found = std::ranges::find(users_, name, &User::name);
  const bool known = found != users_.end();
  const std::string& expected = known ? found->hash : users_.front().hash;
  const std::string hash = hash_of(password, expected);
  return hash.size() == expected.size() && CRYPTO_memcmp(hash.data(), expected.data(), hash.size()) == 0 &&
         known;
}

}  // namespace gyrod::monitor
