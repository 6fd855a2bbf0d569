#include <chrono>
#include <cstdlib>
#include <optional>
#include <utility>

#include <spdlog/fmt/chrono.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <systemd/sd-daemon.h>

#include "app/certificate_watch.hpp"
#include "app/command.hpp"
#include "app/exit_code.hpp"
#include "app/flags.hpp"
#include "app/options.hpp"
#include "app/service.hpp"
#include "app/status_log.hpp"
#include "app/version.hpp"
#include "bus/log.hpp"
#include "fleet/shard.hpp"
#include "ros2/names.hpp"
#include "settings/enum_names.hpp"
#include "settings/unused_keys.hpp"

namespace gyrod::app {
namespace {

spdlog::level::level_enum level_of(settings::LogLevel level) {
  switch (level) {
    case settings::LogLevel::kTrace:
      return spdlog::level::trace;
    case settings::LogLevel::kDebug:
      return spdlog::level::debug;
    case settings::LogLevel::kInfo:
      return spdlog::level::info;
    case settings::LogLevel::kWarning:
      return spdlog::level::warn;
    case settings::LogLevel::kError:
      return spdlog::level::err;
  }
  return spdlog::level::info;
}

void write_middleware_log(bus::LogLevel level, std::string_view message) {
  // Cyclone calls "info" what only its own developers want to know.
  const auto severity = level == bus::LogLevel::kError     ? spdlog::level::err
                        : level == bus::LogLevel::kWarning ? spdlog::level::warn
                                                           : spdlog::level::debug;
  spdlog::log(severity, "DDS: {}", message);
}

/// While it lives, the log is set up, and the middleware's messages are part of it.
class LogScope {
 public:
  explicit LogScope(settings::LogLevel level) {
    spdlog::set_default_logger(spdlog::stderr_logger_mt("gyrod"));
    // The journal stamps lines by itself.
    spdlog::set_pattern(std::getenv("JOURNAL_STREAM") != nullptr ? "%l: %v"
                                                                 : "%Y-%m-%dT%H:%M:%S.%e%z %l: %v");
    spdlog::set_level(level_of(level));
    bus::set_log_handler(write_middleware_log);
  }
  ~LogScope() {
    bus::set_log_handler({});
    spdlog::shutdown();
  }
  LogScope(const LogScope&) = delete;
  LogScope& operator=(const LogScope&) = delete;
};

void announce_ros2(const settings::Settings& settings) {
  const bus::BusOptions options = bus_options(settings.bus);
  const bus::Ros2Options& ros2 = options.ros2;
  for (const std::string& topic : ros2.topics) {
    if (options.shard && !ros2::is_pattern(topic) && !fleet::holds(*options.shard, topic)) {
      spdlog::info("ROS 2: {} is of shard {}/{}", topic, fleet::shard_of(topic, options.shard->count),
                   options.shard->count);
      continue;
    }
    const ros2::Outputs outputs = ros2::outputs_of(topic, ros2.outputs);
    spdlog::info("ROS 2: {} {}, writes {}{}", ros2::is_pattern(topic) ? "looks for" : "reads", topic,
                 outputs.denoised,
                 is_model_method(settings.denoise) ? " and " + outputs.realtime : std::string{});
  }
  if (!ros2.topics.empty() && settings.bus.network == "loopback") {
    spdlog::warn(
        "ROS 2: bus.network is \"loopback\", where nodes with ROS 2's own settings are not found; expected "
        "\"default\"");
  }
}

void announce_security(const std::optional<bus::Identity>& identity) {
  if (!identity) return;
  spdlog::info("DDS Security: we are '{}', certificates hold until {:%Y-%m-%d}", identity->subject,
               fmt::gmtime(std::chrono::system_clock::to_time_t(identity->expires_at)));
}

void announce_restart(const settings::Settings& settings, const Service& service) {
  const bool reads_past = settings.bus.input.durability == settings::Durability::kTransientLocal;
  const std::string& file = settings.restart.published_file;
  if (reads_past) {
    spdlog::info("reads what sensors keep; {} sensors were published before this start",
                 service.published().remembered());
  }
  if (reads_past && file.empty()) {
    spdlog::warn(
        "bus.input.durability is \"transient_local\" and restart.published_file is empty: what sensors "
        "keep is published again after a restart");
  }
  const auto& output = settings.bus.output;
  if (output.ownership_strength == 0) return;
  spdlog::info("one of several daemons: strength {}, takes over after {} s", output.ownership_strength,
               output.takeover_s);
}

void announce(const settings::Settings& settings, const Service& service) {
  const auto& topics = settings.bus.topics;
  spdlog::info("gyrod {}: domain {}, network {}, {} workers", version(), settings.bus.domain,
               settings.bus.network, service.workers());
  announce_security(service.identity());
  const bool realtime = is_model_method(settings.denoise);
  spdlog::info("reads {} and {}, writes {}, {}{}, {} and {}", topics.raw, topics.raw_batch, topics.denoised,
               topics.denoised_batch,
               realtime ? ", " + topics.realtime + ", " + topics.realtime_batch : std::string{}, topics.noise,
               topics.health);
  announce_ros2(settings);
  spdlog::info("method {}; noise: {}, {} calibrations, {} sensors remembered",
               settings::name_of(settings.denoise.method), settings::name_of(settings.noise.source),
               service.noise().calibrations(), service.noise().remembered());
  announce_restart(settings, service);
  for (const std::string& line : settings::unused_keys(settings)) spdlog::warn("unused: {}", line);
  if (service.monitor_port() == 0) return;
  const bool tls = !settings.monitor.tls.certificate_file.empty();
  spdlog::info("metrics at {}://{}:{}/metrics", tls ? "https" : "http", settings.monitor.address,
               service.monitor_port());
}

/// What DDS Security has to say: of peers that are kept out, and of our own certificate.
class SecurityLog {
 public:
  SecurityLog(const Service& service, const settings::SecuritySettings& settings) {
    if (service.identity()) watch_.emplace(*service.identity(), std::chrono::days(settings.warn_before_days));
  }

  void tick(Service& service) {
    for (const std::string& line : service.look_at_peers()) spdlog::warn("DDS Security: {}", line);
    if (!watch_) return;
    const auto news =
        watch_->look(std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()));
    if (news) spdlog::log(news->expired ? spdlog::level::err : spdlog::level::warn, "{}", news->line);
  }

 private:
  std::optional<CertificateWatch> watch_;
};

void serve(Service& service, SecurityLog& security, Interrupt& interrupt) {
  constexpr std::chrono::seconds kTick{1};  // far below any sensible WatchdogSec
  constexpr unsigned kTicksPerSave = 60;
  StatusLog status;
  unsigned ticks = 0;
  auto ticked = std::chrono::steady_clock::now();
  while (!interrupt.wait_for(kTick)) {
    (void)sd_notify(0, "WATCHDOG=1");
    const auto before = std::exchange(ticked, std::chrono::steady_clock::now());
    // Who was stopped for a while has heard nobody; what came meanwhile is pushed before the next tick.
    if (ticked - before < 2 * kTick) service.tend();
    service.judge();
    status.tick(service.snapshot(), service.matched_writers());
    security.tick(service);
    if (++ticks % kTicksPerSave == 0) service.keep_noise();
  }
}

int run(const BusFlags& flags, Interrupt& interrupt) {
  const settings::Settings settings = flags.load();
  const LogScope log(settings.log_level);
  Service service(settings, "gyrod simulate --motion drive" + flags.text());
  service.start();
  announce(settings, service);
  (void)sd_notify(0, "READY=1\nSTATUS=denoising");

  SecurityLog security(service, settings.bus.security);
  security.tick(service);
  serve(service, security, interrupt);

  spdlog::info("stopping: draining what is in flight, {} s at the most", settings.stop_deadline_s);
  (void)sd_notify(0, "STOPPING=1");
  const bool denoised = service.stop();
  const stream::Counts totals = service.snapshot().totals;
  spdlog::info("stopped: {} samples received, {} published, {} rejected, {} in flight", totals.received,
               totals.published, totals.rejected_total(), totals.in_flight);
  if (denoised) return kDone;
  spdlog::warn("the stop's deadline passed: the rest was {}", is_model_method(settings.denoise)
                                                                  ? "denoised with older models"
                                                                  : "passed through undenoised");
  return kIncomplete;
}

}  // namespace

void add_run(CLI::App& parser, Action& chosen) {
  CLI::App* command = parser.add_subcommand("run", "Denoise live: the daemon");
  const auto flags = std::make_shared<BusFlags>();
  flags->add_to(*command);
  command->footer(
      "Reads raw samples from DDS topics, publishes denoised samples and noise reports, serves metrics\n"
      "over HTTP. Needs no configuration; config/gyrod.json shows what can be set. Logs to standard\n"
      "error. SIGTERM or Ctrl-C drains what is in flight and ends: exit code 0, or 6 if the drain\n"
      "met stop.deadline_s. Tells systemd when it is ready (Type=notify) and feeds its watchdog.\n\n"
      "Examples:\n"
      "  gyrod run\n"
      "  gyrod run --config /etc/gyrod/gyrod.json\n"
      "  gyrod run & gyrod simulate --motion drive     # a first look, on this machine alone");
  command->callback(
      [&chosen, flags] { chosen = [flags](Interrupt& interrupt) { return run(*flags, interrupt); }; });
}

}  // namespace gyrod::app
