#include "monitor/event_stream.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <string_view>
#include <utility>

namespace gyrod::monitor {
namespace {

constexpr std::string_view kKeepAlive = ": keep-alive\n\n";
/// A client of an event stream has nothing to say.
constexpr std::size_t kMaxUnaskedBytes = std::size_t{16} * 1024;

}  // namespace

EventStream::EventStream(std::shared_ptr<const void> place, Transport transport, std::string text,
                         std::unique_ptr<EventSource> source)
    : place_(std::move(place)),
      transport_(std::move(transport)),
      source_(std::move(source)),
      text_(std::move(text)) {
  transport_.limit_unsent();
}

pollfd EventStream::waits_for() const noexcept {
  return transport_.waits_for(all_sent() ? POLLIN : POLLIN | POLLOUT);
}

bool EventStream::step(const StreamOptions& options, Deadline now) {
  if (!client_listens() || !send_on(now)) return false;
  if (!all_sent()) {
    next_ = last_progress_ + options.patience;
    return now < next_;
  }
  if (now < next_) return true;
  next_ = now + options.ask_every;
  if (!transport_.is_writable()) return now - last_progress_ < options.patience;
  return ask(options, now) && send_on(now);
}

void EventStream::finish(const StreamOptions& options) noexcept {
  try {
    const Deadline now = std::chrono::steady_clock::now();
    if (send_on(now) && all_sent() && ask(options, now)) (void)send_on(now);
  } catch (const std::exception&) {
    return;  // the source has failed
  }
  transport_.end_writing();
}

/// Takes what the client sends, which nobody reads, so that its end is seen.
bool EventStream::client_listens() noexcept {
  std::array<char, 1024> unread{};
  const Transfer transfer = transport_.read(unread);
  unasked_bytes_ += transfer.bytes;
  return !transfer.ended && unasked_bytes_ <= kMaxUnaskedBytes;
}

bool EventStream::send_on(Deadline now) noexcept {
  while (!all_sent()) {
    const Transfer transfer = transport_.write(std::string_view(text_).substr(sent_));
    if (transfer.ended) return false;
    if (transfer.bytes == 0) return true;
    sent_ += transfer.bytes;
    last_progress_ = now;
  }
  return true;
}

bool EventStream::ask(const StreamOptions& options, Deadline now) {
  last_progress_ = now;
  text_ = {};  // gives a large frame's memory back
  sent_ = 0;
  source_->append(text_);
  if (text_.empty() && now - last_text_ >= options.keep_alive) text_ = kKeepAlive;
  if (!text_.empty()) last_text_ = now;
  return text_.size() <= options.max_event_bytes;
}

}  // namespace gyrod::monitor
