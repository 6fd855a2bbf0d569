/// Who is let in, and by what name they may call us.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "monitor/access_options.hpp"
#include "monitor/answer.hpp"
#include "monitor/credentials.hpp"
#include "monitor/rate_limit.hpp"
#include "monitor/secret_file.hpp"

namespace gyrod::monitor {

/// What of a request decides.
struct Visit {
  std::string_view path;
  std::string_view host;           ///< header Host; may be empty
  std::string_view authorization;  ///< header Authorization; may be empty
  std::string address;             ///< of the client
};

/// How what is told is meant.
enum class Tone { kNews, kTrouble };
/// A line for the log.
using Tell = std::function<void(Tone tone, const std::string& line)>;

/// Thread-safe.
class Gate {
 public:
  /// @param address what gyrod listens on
  /// @param tell hears of wrong credentials, and of files that are read again or cannot be; never of a secret
  /// @throws AccessError
  Gate(const AccessOptions& options, std::string address, Tell tell);

  /// @return the answer to one that is not let in
  [[nodiscard]] std::optional<Answer> refuse(const Visit& visit, RateLimit::Time now);

 private:
  struct Known {
    std::shared_ptr<const Tokens> tokens;
    std::shared_ptr<Users> users;
  };
  enum class Verdict { kKnown, kUnnamed, kWrong, kNotNow };

  [[nodiscard]] bool may_call_us(std::string_view host) const;
  [[nodiscard]] Verdict judge(std::string_view authorization, const std::string& address,
                              RateLimit::Time now);
  [[nodiscard]] Known known(RateLimit::Time now);
  void reload() noexcept;
  void tell_of_reading(const FileWatch& file);
  void tell_of_failure(const std::string& address, RateLimit::Time now);

  AccessOptions options_;
  std::string address_;
  bool names_matter_;
  Tell tell_;
  FileWatch token_watch_;
  FileWatch users_watch_;
  RateLimit failures_;      ///< wrong passwords of each address
  RateLimit all_failures_;  ///< and of all
  std::mutex mutex_;
  Known known_;  ///< guarded by the mutex, as what follows
  RateLimit::Time look_again_{};
  RateLimit::Time tell_again_{};
};

/// For a check before the start: reads all files.
/// @throws AccessError
void check_access(const AccessOptions& options, FileOwner owner);

}  // namespace gyrod::monitor
