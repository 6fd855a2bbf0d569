/// Where the middleware's own log messages go.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace gyrod::bus {

enum class LogLevel { kInfo, kWarning, kError };

/// Called by any thread, by one at a time. Must not throw and must not call into bus/.
using LogHandler = std::function<void(LogLevel, std::string_view message)>;

/// Leads the messages of Cyclone DDS to `handler`, for the whole process. Call it before the first Domain is
/// made, and with an empty handler before what it refers to dies; without a handler messages go to standard
/// error. A warning or error that repeats comes once a minute, with how often; one of DDS Security about a peer begins with what it means.
void set_log_handler(LogHandler handler);

/// Hands a message of bus/ itself to the handler, as the middleware's.
void log(LogLevel level, std::string_view message);

/// Messages that the middleware could not read as what their type says, in this process, since set_log_handler(): it tells of them in its
/// log alone, and drops them. Of such lines the handler gets the 1st, 2nd, 4th, 8th ..., so that nobody floods the log. Any thread.
[[nodiscard]] std::uint64_t unreadable_messages() noexcept;

/// While it lives, also keeps the warnings and errors that this thread causes: the reason behind a failed
/// call. One a thread at a time.
class LogCapture {
 public:
  LogCapture();
  ~LogCapture();
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;

  /// The messages so far, separated by "; ".
  [[nodiscard]] const std::string& text() const noexcept { return text_; }

 private:
  std::string text_;
};

}  // namespace gyrod::bus
