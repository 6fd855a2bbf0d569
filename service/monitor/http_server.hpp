/// A small HTTP server for GET and HEAD on a listening socket: cpp-httplib speaks HTTP, the threads and
/// limits are ours.
#pragma once

#include <thread>
#include <vector>

#include <httplib.h>

#include "monitor/answer.hpp"
#include "monitor/socket.hpp"
#include "monitor/stop_signal.hpp"

namespace gyrod::monitor {

/// Every thread accepts and serves one client at a time, one request a connection. While all are busy,
/// clients wait in the listening socket's queue: nothing else grows. cpp-httplib's own accept loop is not
/// used because it shares the port with another process (SO_REUSEPORT), ends at the first failed accept(),
/// and a client can make its stop() wait.
class HttpServer : private httplib::Server {
 public:
  HttpServer(Socket listener, Answerer answer);
  /// Stops.
  ~HttpServer() override;

  void start();
  /// Wakes the threads from whatever they wait for, and joins them. Can be called twice.
  void stop() noexcept;

 private:
  void accept_clients() noexcept;
  void serve(Socket client) noexcept;
  void respond(const httplib::Request& request, httplib::Response& response) const;

  Socket listener_;
  Answerer answer_;
  StopSignal stop_;
  std::vector<std::thread> threads_;
};

}  // namespace gyrod::monitor
