/// One client of an event stream.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>

#include "monitor/answer.hpp"
#include "monitor/polling.hpp"
#include "monitor/transport.hpp"

namespace gyrod::monitor {

struct StreamOptions {
  std::size_t max_streams = 64;
  /// Between two questions to a source for what is new.
  std::chrono::milliseconds ask_every{100};
  /// After so long without anything new a comment is sent: proxies end connections that say nothing.
  std::chrono::milliseconds keep_alive{15'000};
  /// A client that takes nothing of what waits for it is disconnected.
  std::chrono::milliseconds patience{30'000};
  /// What a source may append at once; a source with more is broken, and its stream ends.
  std::size_t max_event_bytes = std::size_t{16} * 1024 * 1024;
};

class EventStream {
 public:
  /// @param place given back with the stream
  /// @param text what is sent before the source is asked
  EventStream(std::shared_ptr<const void> place, Transport transport, std::string text,
              std::unique_ptr<EventSource> source);

  /// Moves what can be moved, and asks the source if it is time.
  /// @return false once the stream is over
  [[nodiscard]] bool step(const StreamOptions& options, Deadline now);

  /// What the source has still to say, as far as the client takes it at once.
  void finish(const StreamOptions& options) noexcept;

  /// What step() waits for.
  [[nodiscard]] pollfd waits_for() const noexcept;
  /// When step() has something to do even if the client does nothing.
  [[nodiscard]] Deadline next() const noexcept { return next_; }

 private:
  [[nodiscard]] bool client_listens() noexcept;
  [[nodiscard]] bool send_on(Deadline now) noexcept;
  [[nodiscard]] bool ask(const StreamOptions& options, Deadline now);
  [[nodiscard]] bool all_sent() const noexcept { return sent_ == text_.size(); }

  std::shared_ptr<const void> place_;
  Transport transport_;
  std::unique_ptr<EventSource> source_;
  std::string text_;  ///< what waits for the client, from sent_ on
  std::size_t sent_ = 0;
  std::size_t unasked_bytes_ = 0;  ///< what the client has sent since the stream began
  Deadline last_progress_ = std::chrono::steady_clock::now();
  Deadline last_text_ = last_progress_;
  Deadline next_ = last_progress_;
};

}  // namespace gyrod::monitor
