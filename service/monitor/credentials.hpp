/// Who may ask: tokens and users from their files.
#pragma once

#include <array>
#include <cstddef>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "monitor/secret_file.hpp"

namespace gyrod::monitor {

using Digest = std::array<unsigned char, 32>;

/// Bearer tokens, one a line; a line that begins with '#' is a comment. Several hold at once, so that one can be
/// replaced without a gap.
class Tokens {
 public:
  /// @throws AccessError, e.g. for a token of less than 16 characters, which could be guessed
  Tokens(const std::string& file, FileOwner owner);
  /// Takes the same time for every token of a length.
  [[nodiscard]] bool holds(std::string_view token) const;

 private:
  std::vector<Digest> digests_;
};

/// Users and the hashes of their passwords: `name:hash` a line, as htpasswd -B, mkpasswd and openssl passwd -6 make
/// them.
class Users {
 public:
  /// @throws AccessError naming the line, e.g. for a hash that is fast to try out or that crypt(3) does not know
  Users(const std::string& file, FileOwner owner);

  /// @param name_and_password with ':' between them
  /// @param may_hash hashing a password takes milliseconds on purpose; one is hashed at a time
  /// @return none where that would be needed
  [[nodiscard]] std::optional<bool> hold(std::string_view name_and_password, bool may_hash);

 private:
  struct User {
    std::string name;
    std::string hash;
  };

  [[nodiscard]] bool has_held(const Digest& digest);
  [[nodiscard]] bool matches(std::string_view name, const std::string& password) const;

  std::vector<User> users_;
  Digest secret_{};     ///< of this process, for what is below
  std::mutex hashing_;  ///< held while a password is hashed
  std::mutex mutex_;
  std::set<Digest>
      verified_;  ///< what held before, guarded by the mutex: a scrape must not hash anew each time
};

}  // namespace gyrod::monitor
