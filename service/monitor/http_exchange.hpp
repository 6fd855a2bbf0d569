/// From the bytes of one request to the bytes of its answer.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <httplib.h>

#include "monitor/answer.hpp"
#include "monitor/gate.hpp"
#include "monitor/http_counts.hpp"
#include "monitor/stream_hub.hpp"

namespace gyrod::monitor {

/// How long a connection is kept for the next request, e.g. that of a scraper once a minute, and for how many.
inline constexpr std::chrono::seconds kKeepOpenTime{65};
inline constexpr std::size_t kMaxRequests = 1000;

/// What a client gets.
struct Reply {
  std::string bytes;
  /// Of the answer in `bytes`; 0: it is none.
  int status = 0;
  /// Where set, the client is turned away.
  std::optional<Refusal> refusal = {};
  /// Whether the client may ask more on the same connection.
  bool keep_open = false;
  /// Where set, `bytes` is the begin of an event stream.
  std::unique_ptr<EventSource> events = {};
  StreamHub::Place place = {};
};

/// For requests that are answered without being understood.
[[nodiscard]] Reply refusal(int status, Refusal why, std::string_view words);

/// cpp-httplib reads requests and writes answers, in memory: it never sees a socket, so no client can hold it up.
/// One thread.
class HttpExchange final : private httplib::Server {
 public:
  /// @param answer, gate, streams outlive the exchange
  HttpExchange(const Answerer& answer, Gate& gate, StreamHub& streams);

  /// @param head request line and headers with the empty line at their end; a body is not looked at
  /// @param address of the client
  [[nodiscard]] Reply reply_to(std::string_view head, const std::string& address);

 private:
  void respond(const httplib::Request& request, httplib::Response& response);
  [[nodiscard]] Answer answer_to(const httplib::Request& request);

  const Answerer& answer_;
  Gate& gate_;
  StreamHub& streams_;
  std::string address_;         ///< of who asks now
  bool understood_ = false;     ///< what is asked
  Reply reply_;                 ///< to that
  std::optional<Answer> held_;  ///< what the client has already, without its body
};

}  // namespace gyrod::monitor
