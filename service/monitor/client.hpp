/// One client of the HTTP server, from its connection to its answer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "monitor/http_counts.hpp"
#include "monitor/http_exchange.hpp"
#include "monitor/polling.hpp"
#include "monitor/transport.hpp"

namespace gyrod::monitor {

/// Reads a request, waits for its answer, writes it; and so on, or closes. Limits on bytes and on time in total (not
/// per byte, so that one that trickles gains nothing) hold for each request. One thread.
class Client {
 public:
  /// @param counts outlives it
  Client(Transport transport, std::string address, Deadline now, HttpCounts& counts);

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
  [[nodiscard]] const std::string& address() const noexcept { return address_; }
  void answer(Reply reply);
  /// Answers, and counts it.
  void refuse(int status, Refusal why, std::string_view words);
  /// Once the answer is an event stream: the client goes on there.
  [[nodiscard]] std::optional<EventStream> take_stream();

  /// Since when the client keeps gyrod waiting; none while gyrod keeps it waiting.
  [[nodiscard]] std::optional<Deadline> idle_since() const noexcept;
  [[nodiscard]] std::size_t unsent_bytes() const noexcept { return reply_.bytes.size() - sent_; }

 private:
  enum class State { kReading, kAsking, kAnswering, kWriting, kClosing };

  [[nodiscard]] bool read(Deadline now);
  [[nodiscard]] bool find_request(std::size_t from);
  [[nodiscard]] bool gone() noexcept;
  void begin_next(Deadline now);
  [[nodiscard]] bool write(Deadline now);
  [[nodiscard]] bool drain();
  [[nodiscard]] bool times_out(Deadline now);

  State state_ = State::kReading;
  Transport transport_;
  std::string address_;
  Deadline begin_;                  ///< of this request
  Deadline deadline_;               ///< of this state
  Deadline last_progress_;          ///< of writing
  std::string received_;            ///< not taken yet; may hold the begin of the next request
  std::size_t request_bytes_ = 0;   ///< of those, the whole request; 0 while it is not
  std::uint64_t bytes_before_ = 0;  ///< that came before this request
  std::size_t requests_ = 0;        ///< answered
  HttpCounts& counts_;
  Reply reply_;
  std::size_t sent_ = 0;
};

}  // namespace gyrod::monitor
