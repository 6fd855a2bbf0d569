/// From the bytes of one request to the bytes of its answer.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <httplib.h>

#include "monitor/answer.hpp"
#include "monitor/stream_hub.hpp"

namespace gyrod::monitor {

/// What a client gets.
struct Reply {
  std::string bytes;
  /// Where set, `bytes` is the begin of an event stream.
  std::unique_ptr<EventSource> events = {};
  StreamHub::Place place = {};
};

/// For requests that are answered without being understood.
[[nodiscard]] Reply refusal(int status, std::string_view words);

/// cpp-httplib reads requests and writes answers, in memory: it never sees a socket, so no client can hold it up.
/// One thread.
class HttpExchange final : private httplib::Server {
 public:
  /// @param answer, streams outlive the exchange
  HttpExchange(const Answerer& answer, StreamHub& streams);

  /// @param head request line and headers with the empty line at their end; a body is not looked at
  [[nodiscard]] Reply reply_to(std::string_view head);

 private:
  void respond(const httplib::Request& request, httplib::Response& response);
  [[nodiscard]] Answer answer_to(const httplib::Request& request) const;

  const Answerer& answer_;
  StreamHub& streams_;
  Reply reply_;  ///< to the request at hand
};

}  // namespace gyrod::monitor
