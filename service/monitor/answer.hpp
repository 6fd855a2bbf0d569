/// What a client asks and what it is answered: the seam between the HTTP server and what it serves.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "monitor/http_counts.hpp"

namespace gyrod::monitor {

struct Request {
  /// Decoded, from '/' on, without the query.
  std::string path;
  /// As the client wrote it: what decoding would make ambiguous, such as a '/' within a sensor's id, is still apart.
  std::string raw_path;
  /// Decoded; a key may come twice.
  std::multimap<std::string, std::string> query;
  /// Of an event stream that comes back (Last-Event-ID); empty otherwise.
  std::string last_event_id;
};

/// Makes what a client of an event stream is sent. One thread calls it.
class EventSource {
 public:
  virtual ~EventSource() = default;
  /// Appends server-sent events, or nothing where there is nothing new. Called several times a second, and only once the client has taken
  /// all that was appended before: one that does not keep up is asked for less often, so what is appended must be the state at the call,
  /// not a backlog. What it throws ends the stream.
  virtual void append(std::string& text) = 0;
};

struct Answer {
  int status = 200;
  std::string content_type = "text/plain; charset=utf-8";
  std::string body = {};
  /// Beside those that every answer has.
  std::vector<std::pair<std::string, std::string>> headers = {};
  /// Where set, the answer is a stream of events and `body` its first part.
  std::unique_ptr<EventSource> events = {};
  /// Where set, the client is turned away.
  std::optional<Refusal> refusal = {};
};

/// Called by several threads at once. What it throws becomes status 500.
using Answerer = std::function<Answer(const Request& request)>;

}  // namespace gyrod::monitor
