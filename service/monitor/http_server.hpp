/// A small HTTP server for GET and HEAD on a listening socket: cpp-httplib speaks HTTP, the sockets, threads and
/// limits are ours.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "monitor/access_options.hpp"
#include "monitor/answer.hpp"
#include "monitor/answer_pool.hpp"
#include "monitor/client.hpp"
#include "monitor/gate.hpp"
#include "monitor/http_counts.hpp"
#include "monitor/polling.hpp"
#include "monitor/rate_limit.hpp"
#include "monitor/socket.hpp"
#include "monitor/stream_hub.hpp"
#include "monitor/tls.hpp"

namespace gyrod::monitor {

struct HttpOptions {
  /// What the listener listens on, as it was asked for.
  std::string address = "127.0.0.1";
  AccessOptions access = {};
  StreamOptions streams = {};
  /// Requests of an address: far more than any page or scraper.
  RateLimit::Options requests = {.burst = 1000.0, .per_second = 200.0};
  Tell tell = [](Tone, const std::string&) {};
};

/// One thread moves the bytes of all clients and never waits for one of them; a few make answers; one more
/// serves event streams. What clients can take is bounded: their number, their bytes, their time. Where all
/// places are taken, a new client gets that of the one that has been idle longest.
class HttpServer {
 public:
  /// @throws AccessError
  HttpServer(Socket listener, Answerer answer, const HttpOptions& options = {});
  /// Stops.
  ~HttpServer() { stop(); }
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  void start();
  /// Wakes the threads from whatever they wait for, and joins them. Can be called twice.
  void stop() noexcept;

  /// What became of requests so far. Thread-safe.
  [[nodiscard]] HttpSnapshot counts() const noexcept { return counts_.snapshot(); }

 private:
  using Clients = std::map<std::uint64_t, Client>;  ///< in the order of their connection

  void serve() noexcept;
  void serve_once();
  void wait();
  void accept_clients(Deadline now);
  void take_answers();
  void step(Deadline now);
  void hand_out_requests(Deadline now);
  void go_on(std::uint64_t number, Reply reply);
  [[nodiscard]] bool drop_longest_idle();
  [[nodiscard]] Ssl new_tls(int descriptor, Deadline now);
  void drop_deaf_ones(Deadline now);
  [[nodiscard]] std::size_t unsent_bytes() const;

  Socket listener_;
  Answerer answer_;
  Tell tell_;
  Gate gate_;
  HttpCounts counts_;
  std::optional<Tls> tls_;
  RateLimit requests_;
  WakeSignal wake_;
  std::atomic<bool> stopping_{false};
  StreamHub streams_;
  AnswerPool pool_{answer_, gate_, streams_, wake_};
  // Of the one thread alone:
  Clients clients_;
  std::vector<pollfd> descriptors_;  ///< what wait() has found: wake, listener, clients
  std::uint64_t next_number_ = 0;
  std::size_t jobs_ = 0;
  Deadline accept_again_{};
  Deadline look_for_certificate_{};
  bool holds_back_ = false;  ///< requests, until clients have taken what waits for them
  std::thread thread_;
};

}  // namespace gyrod::monitor
