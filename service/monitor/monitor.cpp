#include "monitor/monitor.hpp"

#include <cassert>
#include <chrono>
#include <functional>
#include <utility>

#include "monitor/api.hpp"
#include "monitor/collector.hpp"
#include "monitor/http_server.hpp"
#include "monitor/live_page.hpp"
#include "monitor/socket.hpp"

namespace gyrod::monitor {
namespace {

constexpr const char* kPrometheusText = "text/plain; version=0.0.4; charset=utf-8";
CollectorOptions collector_options(const MonitorOptions& options, std::function<HttpSnapshot()> http) {
  using std::chrono::duration;
  const auto start = std::chrono::steady_clock::now();
  return {.max_channel_series = options.max_channel_series,
          .version = options.version,
          .start_time_s = duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(),
          .uptime_s = [start] { return duration<double>(std::chrono::steady_clock::now() - start).count(); },
          .http = std::move(http)};
}

/// Of the same process, with the same clock.
ApiOptions api_options(const CollectorOptions& options) {
  using std::chrono::duration;
  return {
      .version = options.version,
      .start_time_s = options.start_time_s,
      .uptime_s = options.uptime_s,
      .steady_s =
          [] { return duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); },
      .time_s = [] { return duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(); }};
}

}  // namespace

class Monitor::Impl {
 public:
  Impl(const MonitorOptions& options, View view)
      : Impl(options, std::move(view), listen_on(options.address, options.port)) {}

  void start() { server_.start(); }
  void stop() noexcept { server_.stop(); }
  [[nodiscard]] std::uint16_t port() const noexcept { return port_; }
  [[nodiscard]] std::string epoch() const { return epoch_of(collector_.options().start_time_s); }

 private:
  Impl(const MonitorOptions& options, View view, Socket listener)
      : readiness_(view.readiness),
        collector_(collector_options(options, [this] { return server_.counts(); }), view),
        api_(api_options(collector_.options()), std::move(view)),
        port_(port_of(listener)),
        server_(std::move(listener), [this](const Request& request) { return answer(request); },
                {.address = options.address, .access = options.access, .tell = options.tell}) {}

  [[nodiscard]] Answer answer(const Request& request) const {
    const std::string& path = request.path;
    if (Api::is_for(path)) return api_.answer(request);
    if (path == "/metrics") {
      return {.content_type = kPrometheusText, .body = collector_.text()};
    }
    if (path == "/healthz") return {.body = "ok\n"};
    if (path == "/readyz") return ready();
    if (path == "/") return live_page();
    return {.status = 404, .body = "not here; see /\n"};
  }

  [[nodiscard]] Answer ready() const {
    const Readiness readiness = readiness_();
    if (readiness.ready) return {.body = "ready\n"};
    return {.status = 503, .body = "not ready: " + readiness.reason + "\n"};
  }

  std::function<Readiness()> readiness_;
  Collector collector_;
  Api api_;
  std::uint16_t port_;
  HttpServer server_;  // last: its threads use the others
};

Monitor::Monitor(const MonitorOptions& options, View view)
    : impl_(std::make_unique<Impl>(options, std::move(view))) {}
Monitor::~Monitor() = default;
void Monitor::start() { impl_->start(); }
void Monitor::stop() { impl_->stop(); }
std::uint16_t Monitor::port() const noexcept { return impl_->port(); }
std::string Monitor::epoch() const { return impl_->epoch(); }

}  // namespace gyrod::monitor
