#include "bus/log.hpp"

#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include <dds/dds.h>

#include "bus/repeat_filter.hpp"

namespace gyrod::bus {
namespace {

// Process-wide, because the middleware's sink is.
std::mutex handler_mutex;
LogHandler current_handler;
RepeatFilter filter;  // a peer that is refused tries again each second
thread_local std::string* captured = nullptr;
std::atomic<std::uint64_t> unreadable{0};

/// What Cyclone DDS 0.10 says of a message that is not what its type says; tests/integration/faults_test.cpp holds it to that.
bool tells_of_unreadable(std::string_view message) noexcept {
  return message.find(": deserialization ") != std::string_view::npos;
}

LogLevel level_of(std::uint32_t priority) noexcept {
  if ((priority & (DDS_LC_FATAL | DDS_LC_ERROR)) != 0) return LogLevel::kError;
  return (priority & DDS_LC_WARNING) != 0 ? LogLevel::kWarning : LogLevel::kInfo;
}

/// What a message of DDS Security about a peer comes down to; empty for any other message.
std::string_view in_words(std::string_view message) noexcept {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kWords = {
      {{"unable to get local issuer",
        "a peer is refused: its certificate is not signed by our identity authority"},
       {"certificate has expired", "a peer is refused: its certificate has expired"},
       {"certificate is not yet valid",
        "a peer is refused: its certificate does not hold yet, or a clock is wrong"},
       {"certificate revoked", "a peer is refused: its certificate is revoked"},
       {"Subject name is invalid", "a peer is refused: its permissions have no grant for it"},
       {"PKCS7", "a peer is refused: its permissions are not signed by our permissions authority"},
       {"security_attributes mismatch",
        "a peer or topic is refused: its governance protects the domain in another way than ours"},
       {"dds_participant_delete: internal error",
        "our participant had gone before, most likely with its certificate"},
       {"Remote secure participant",
        "a peer is not let in; one that comes while gyrod itself is joining is tried again at once"},
       {"Access control does not allow", "a peer's topic is refused: its permissions have no rule for it"}}};
  for (const auto& [part, words] : kWords) {
    if (message.find(part) != std::string_view::npos) return words;
  }
  return {};
}

/// To the handler or standard error. @pre handler_mutex is held
void hand_over(LogLevel level, std::string_view message) {
  if (current_handler) {
    current_handler(level, message);
  } else {
    std::fprintf(stderr, "cyclonedds: %.*s\n", static_cast<int>(message.size()), message.data());
  }
}

/// The same, of repeated ones one a minute, and in words. @pre handler_mutex is held
void hand_over_trouble(LogLevel level, std::string_view message) {
  const std::optional<std::string> line = filter.pass(message, RepeatFilter::Clock::now());
  if (!line) return;
  const std::string_view words = in_words(message);
  hand_over(level, words.empty() ? *line : std::string(words) + ": " + *line);
}

void pass_on(LogLevel level, std::string_view message) {
  const std::lock_guard lock(handler_mutex);
  if (level == LogLevel::kInfo) {  // told only to who has asked for it
    hand_over(level, message);
  } else {
    hand_over_trouble(level, message);
  }
}

void on_message(void*, const dds_log_data_t* data) {
  std::string_view message(data->message, data->size);
  while (message.ends_with('\n')) message.remove_suffix(1);
  const LogLevel level = level_of(data->priority);
  if (captured != nullptr && level != LogLevel::kInfo) {
    if (!captured->empty()) *captured += "; ";
    *captured += message;
  }
  if (tells_of_unreadable(message) && !std::has_single_bit(unreadable.fetch_add(1) + 1)) return;
  pass_on(level, message);
}

}  // namespace

void log(LogLevel level, std::string_view message) {
  const std::lock_guard lock(handler_mutex);
  hand_over(level, message);
}

void set_log_handler(LogHandler handler) {
  {
    const std::lock_guard lock(handler_mutex);
    current_handler = std::move(handler);
    filter = {};
  }
  dds_set_log_sink(on_message, nullptr);
}

std::uint64_t unreadable_messages() noexcept { return unreadable.load(std::memory_order_relaxed); }

LogCapture::LogCapture() {
  captured = &text_;
  dds_set_log_sink(on_message, nullptr);
}

LogCapture::~LogCapture() { captured = nullptr; }

}  // namespace gyrod::bus
