/// The one HTTP port of the daemon: metrics for Prometheus, health for the supervisor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "monitor/access_options.hpp"
#include "monitor/gate.hpp"
#include "monitor/view.hpp"

namespace gyrod::monitor {

struct MonitorOptions {
  /// Address or host name to listen on. The default is not reachable from outside.
  std::string address = "127.0.0.1";
  /// TCP port, 0..65535; 0 takes a free one, port() tells which.
  std::uint16_t port = 9464;
  /// Sensors that get series of their own at the most, in the order of opening. A sensor has at most 40
  /// series.
  std::size_t max_channel_series = 200;
  AccessOptions access = {};
  /// A line for the log: of wrong credentials, of files that are read again or cannot be.
  Tell tell = [](Tone, const std::string&) {};
  /// What gyrod_build_info says.
  std::string version = "unknown";
};

/// Answers GET and HEAD of
///   /         the list of what is here
///   /metrics  Prometheus text format 0.0.4, described in docs/metrics.md
///   /healthz  200 while the process answers
///   /readyz   200 when work can be done, else 503 with the reason
/// from threads of its own, none of which a client can hold: there are limits on its bytes and its seconds. start()
/// and stop() belong to one thread; port() may be called from any.
class Monitor {
 public:
  /// Takes the port; clients wait from then on, and are answered after start().
  /// @throws std::runtime_error naming address, port and reason, e.g. "port 9464 on 127.0.0.1 is in use"; AccessError
  /// for a certificate, key, token or users that are no good
  Monitor(const MonitorOptions& options, View view);
  /// Stops.
  ~Monitor();
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  /// Begins to answer. The view is called from now until stop() returns.
  void start();
  /// Closes the port and every connection; returns within a second, whatever the clients do. Can be called
  /// twice.
  void stop();

  [[nodiscard]] std::uint16_t port() const noexcept;
  /// Another text after every start of the process.
  [[nodiscard]] std::string epoch() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::monitor
