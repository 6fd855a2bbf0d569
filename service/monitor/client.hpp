/// One client of the HTTP server, from its connection to its answer.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "monitor/http_exchange.hpp"
#include "monitor/polling.hpp"
#include "monitor/transport.hpp"

namespace gyrod::monitor {

/// Reads one request, waits for its answer, writes it, closes. Limits on bytes and on time in total (not per
/// byte, so that one that trickles gains nothing) hold for each. One thread.
class Client {
 public:
  Client(Transport transport, Deadline now);

  /// Moves what can be moved.
  /// @param revents as poll() has found them
  /// @return false once the client is to be disconnected
  [[nodiscard]] bool step(Deadline now, short revents);

  /// What step() waits for, and until when.
  [[nodiscard]] pollfd waits_for() const noexcept;
  [[nodiscard]] Deadline deadline() const noexcept { return deadline_; }

  /// Whether a whole request is here that nobody has taken yet.
  [[nodiscard]] bool has_request() const noexcept { return state_ == State::kAsking; }
  [[nodiscard]] std::string take_request();
  void answer(Reply reply);
  /// Once the answer is an event stream: the client goes on there.
  [[nodiscard]] std::optional<EventStream> take_stream();

  /// Since when the client keeps gyrod waiting; none while gyrod keeps it waiting.
  [[nodiscard]] std::optional<Deadline> idle_since() const noexcept;
  [[nodiscard]] std::size_t unsent_bytes() const noexcept { return reply_.bytes.size() - sent_; }

 private:
  enum class State { kReading, kAsking, kAnswering, kWriting, kClosing };

  [[nodiscard]] bool read(Deadline now);
  [[nodiscard]] bool write(Deadline now);
  [[nodiscard]] bool drain();
  [[nodiscard]] bool times_out(Deadline now);

  State state_ = State::kReading;
  Transport transport_;
  Deadline begin_;
  Deadline deadline_;
  Deadline last_progress_;
  std::string request_;
  Reply reply_;
  std::size_t sent_ = 0;
};

}  // namespace gyrod::monitor
