#include "monitor/gate.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <exception>
#include <openssl/evp.h>
#include <utility>

#include "monitor/failure.hpp"
#include "monitor/tls.hpp"

namespace gyrod::monitor {
namespace {

/// Wrong passwords of an address: ten at once, then one every two seconds.
constexpr RateLimit::Options kFailures{.burst = 10.0, .per_second = 0.5};
/// Of all addresses together; hashing must not become what gyrod does.
constexpr RateLimit::Options kAllFailures{.burst = 60.0, .per_second = 4.0};
constexpr const char* kAnyAddress = "*";
constexpr std::chrono::seconds kLookAgain{1};
constexpr std::chrono::minutes kTellAgain{1};
constexpr std::size_t kMaxCredentials = 1024;

bool same_letters(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// Without the port, and an IPv6 address without its brackets.
std::string_view name_in(std::string_view host) {
  if (host.starts_with('[')) return host.substr(1, host.find(']') - 1);
  return host.substr(0, host.find(':'));
}

/// What follows `scheme` and a space.
std::optional<std::string_view> after(std::string_view authorization, std::string_view scheme) {
  const std::string_view begin = authorization.substr(0, scheme.size());
  if (!same_letters(begin, scheme) || !authorization.substr(begin.size()).starts_with(' '))
    return std::nullopt;
  return authorization.substr(scheme.size() + 1);
}

std::optional<std::string> decode_base64(std::string_view text) {
  if (text.empty() || text.size() > kMaxCredentials || text.size() % 4 != 0) return std::nullopt;
  std::string bytes(text.size() / 4 * 3, '\0');
  const int size =
      EVP_DecodeBlock(reinterpret_cast<unsigned char*>(bytes.data()),
                      reinterpret_cast<const unsigned char*>(text.data()), static_cast<int>(text.size()));
  if (size < 0) return std::nullopt;
  const auto padding = text.size() - std::min(text.find('='), text.size());
  bytes.resize(bytes.size() - std::min<std::size_t>(padding, 2));
  return bytes;
}

Answer who_are_you(std::string_view path, const AccessOptions& options, Refusal why) {
  Answer answer =
      failure(401, path, "gyrod asks who you are: a token or a user of its configuration (monitor.auth)");
  if (!options.users_file.empty())
    answer.headers.emplace_back("WWW-Authenticate", R"(Basic realm="gyrod", charset="UTF-8")");
  else
    answer.headers.emplace_back("WWW-Authenticate", R"(Bearer realm="gyrod")");
  answer.refusal = why;
  return answer;
}

Answer wrong_name(std::string_view path) {
  Answer answer = failure(
      403, path,
      "gyrod asks nobody on this machine who they are, so it answers to the names localhost, 127.0.0.1 "
      "and [::1] alone: a page from elsewhere must not reach it by another; a proxy in front has to send "
      "one of them as Host");
  answer.refusal = Refusal::kHost;
  return answer;
}

Answer too_often(std::string_view path, std::string_view words) {
  Answer answer = failure(429, path, words);
  answer.headers.emplace_back("Retry-After", "2");
  answer.refusal = Refusal::kGuessing;
  return answer;
}

}  // namespace

Gate::Gate(const AccessOptions& options, std::string address, Tell tell)
    : options_(options),
      address_(std::move(address)),
      names_matter_(is_loopback(address_) && !options.asks_who()),
      tell_(std::move(tell)),
      token_watch_(options.token_file),
      users_watch_(options.users_file),
      failures_(kFailures),
      all_failures_(kAllFailures) {
  if (!options.token_file.empty())
    known_.tokens = std::make_shared<Tokens>(options.token_file, FileOwner::kThisUser);
  if (!options.users_file.empty())
    known_.users = std::make_shared<Users>(options.users_file, FileOwner::kThisUser);
}

std::optional<Answer> Gate::refuse(const Visit& visit, RateLimit::Time now) {
  if (names_matter_ && !may_call_us(visit.host)) return wrong_name(visit.path);
  // A supervisor knows no secrets, and "ok" is none.
  if (!options_.asks_who() || visit.path == "/healthz") return std::nullopt;
  switch (judge(visit.authorization, visit.address, now)) {
    case Verdict::kKnown:
      return std::nullopt;
    case Verdict::kNotNow:
      return too_often(visit.path, "too many wrong passwords: try again later");
    case Verdict::kUnnamed:
      return who_are_you(visit.path, options_, Refusal::kNoCredentials);
    case Verdict::kWrong:
      break;
  }
  return who_are_you(visit.path, options_, Refusal::kWrongCredentials);
}

/// Against pages of other sites that have their name resolved to this machine (DNS rebinding).
bool Gate::may_call_us(std::string_view host) const {
  if (host.empty()) return true;  // no browser
  const std::array<std::string_view, 4> names = {"localhost", "127.0.0.1", "::1", address_};
  return std::ranges::any_of(names, [&](std::string_view name) { return same_letters(name, name_in(host)); });
}

Gate::Verdict Gate::judge(std::string_view authorization, const std::string& address, RateLimit::Time now) {
  if (authorization.empty()) return Verdict::kUnnamed;  // how a browser begins
  const Known known = this->known(now);
  // Not counted: too long to be guessed, and a scrape must not suffer from whoever guesses beside it.
  const auto token = after(authorization, "Bearer");
  if (token && known.tokens && known.tokens->holds(*token)) return Verdict::kKnown;
  if (!failures_.allows(address, now)) return Verdict::kNotNow;
  const auto basic = after(authorization, "Basic");
  const auto name_and_password = basic ? decode_base64(*basic) : std::nullopt;
  if (name_and_password && known.users) {
    const std::optional<bool> holds =
        known.users->hold(*name_and_password, all_failures_.allows(kAnyAddress, now));
    if (!holds) return Verdict::kNotNow;
    if (*holds) return Verdict::kKnown;
  }
  failures_.take(address, now);
  all_failures_.take(kAnyAddress, now);
  tell_of_failure(address, now);
  return Verdict::kWrong;
}

Gate::Known Gate::known(RateLimit::Time now) {
  const std::scoped_lock lock(mutex_);
  if (now >= look_again_) {
    look_again_ = now + kLookAgain;
    reload();
  }
  return known_;
}

/// A file that is no good leaves what was known before in force.
void Gate::reload() noexcept {
  try {
    if (known_.tokens && token_watch_.changed()) {
      known_.tokens = std::make_shared<Tokens>(token_watch_.path(), FileOwner::kThisUser);
      tell_of_reading(token_watch_);
    }
    if (known_.users && users_watch_.changed()) {
      known_.users = std::make_shared<Users>(users_watch_.path(), FileOwner::kThisUser);
      tell_of_reading(users_watch_);
    }
  } catch (const std::exception& error) {
    tell_(Tone::kTrouble,
          std::string("monitor.auth: ") + error.what() + "; what was read before stays in force");
  }
}

void Gate::tell_of_reading(const FileWatch& file) {
  tell_(Tone::kNews, "monitor.auth: '" + file.path() + "' has changed and was read again");
}

void Gate::tell_of_failure(const std::string& address, RateLimit::Time now) {
  {
    const std::scoped_lock lock(mutex_);
    if (now < tell_again_) return;
    tell_again_ = now + kTellAgain;
  }
  tell_(Tone::kTrouble, "HTTP: wrong credentials from " + address + "; told once a minute");
}

void check_access(const AccessOptions& options, FileOwner owner) {
  if (options.uses_tls()) (void)make_tls(options.certificate_file, options.key_file, owner);
  if (!options.token_file.empty()) (void)Tokens(options.token_file, owner);
  if (!options.users_file.empty()) (void)Users(options.users_file, owner);
}

}  // namespace gyrod::monitor
