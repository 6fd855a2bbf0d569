#include "bus/log.hpp"

#include <cstdio>
#include <mutex>
#include <utility>

#include <dds/dds.h>

namespace gyrod::bus {
namespace {

// Process-wide, because the middleware's sink is.
std::mutex handler_mutex;
LogHandler current_handler;
thread_local std::string* captured = nullptr;

LogLevel level_of(std::uint32_t priority) noexcept {
  if ((priority & (DDS_LC_FATAL | DDS_LC_ERROR)) != 0) return LogLevel::kError;
  return (priority & DDS_LC_WARNING) != 0 ? LogLevel::kWarning : LogLevel::kInfo;
}

void on_message(void*, const dds_log_data_t* data) {
  std::string_view message(data->message, data->size);
  while (message.ends_with('\n')) message.remove_suffix(1);
  const LogLevel level = level_of(data->priority);
  if (captured != nullptr && level != LogLevel::kInfo) {
    if (!captured->empty()) *captured += "; ";
    *captured += message;
  }
  const std::lock_guard lock(handler_mutex);
  if (current_handler) {
    current_handler(level, message);
  } else {
    std::fprintf(stderr, "cyclonedds: %.*s\n", static_cast<int>(message.size()), message.data());
  }
}

}  // namespace

void set_log_handler(LogHandler handler) {
  {
    const std::lock_guard lock(handler_mutex);
    current_handler = std::move(handler);
  }
  dds_set_log_sink(on_message, nullptr);
}

LogCapture::LogCapture() {
  captured = &text_;
  dds_set_log_sink(on_message, nullptr);
}

LogCapture::~LogCapture() { captured = nullptr; }

}  // namespace gyrod::bus
