#include "app/service.hpp"

#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <spdlog/spdlog.h>

#include "app/errors.hpp"
#include "app/options.hpp"
#include "app/version.hpp"
#include "app/wall_clock.hpp"
#include "bus/log.hpp"
#include "settings/dump.hpp"

namespace gyrod::app {
namespace {

/// Time for programs that run already to be found.
constexpr std::chrono::milliseconds kDiscovery{500};

/// How long readers may take in all to confirm what a stop releases.
constexpr std::chrono::seconds kLastWord{5};

}  // namespace

Service::Service(const settings::Settings& settings, std::string simulate_command)
    : stop_deadline_(static_cast<std::int64_t>(settings.stop_deadline_s * 1e3)),
      shard_(bus_options(settings.bus).shard.value_or(fleet::Shard{})),
      keeps_noise_(!settings.noise.state_file.empty()),
      noise_file_(settings.noise.state_file, [](const std::string& line) { spdlog::warn(line); }),
      noise_(settings.noise, noise_file_.load()),
      domain_(settings.bus.domain, settings.bus.network, settings.bus.security.folder, bus::Calling::kOften),
      publisher_(domain_, live_bus_options(settings)),
      imu_topics_(domain_, live_bus_options(settings)),
      published_(settings.restart.published_file, settings.engine.max_channels,
                 [](const std::string& line) { spdlog::warn(line); }),
      release_(publisher_, imu_topics_, published_, live_, settings.bus.output.history_depth),
      engine_(live_engine_options(settings, noise_, published_), method(settings), release_),
      inlet_(engine_, live_.tap),
      feed_(inlet_, imu_topics_,
            bus_options(settings.bus).input_past ? kDiscovery : std::chrono::milliseconds{0}),
      imu_feed_(inlet_),
      subscriber_(domain_, bus_options(settings.bus), feed_),
      imu_subscriber_(imu_topics_, imu_feed_),
      fleet_link_(inlet_),
      fleet_(domain_, publisher_, live_bus_options(settings), fleet_link_),
      mismatch_watch_(domain_, live_bus_options(settings)) {
  if (domain_.identity()) peers_.emplace(domain_);
  if (settings.bus.output.ownership_strength > 0) {
    standby_.emplace(domain_, live_bus_options(settings), release_);
    release_.go_through(&*standby_);
  }
  if (!settings.monitor.enabled) return;
  try {
    monitor::MonitorOptions options = monitor_options(settings.monitor);
    options.tell = [this](monitor::Tone tone, const std::string& line) { hear(tone, line); };
    monitor_.emplace(options, view(settings, std::move(simulate_command)));
  } catch (const monitor::AccessError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw Unavailable(error.what());
  }
}

void Service::start() {
  if (monitor_) {
    live_.events.add(seconds_since_1970(), "",
                     std::string("gyrod ") + version() + " has started, epoch " + monitor_->epoch() + ".");
    monitor_->start();
  }
  fleet_.start();
  // Readers that were there before a restart: what leaves before they are found is not theirs, and counts as published.
  if (published_.remembered() > 0) std::this_thread::sleep_for(kDiscovery);
  subscriber_.start();
  imu_subscriber_.start();
  ready_ = true;
}

bool Service::stop() {
  ready_ = false;
  live_.events.add(seconds_since_1970(), "", "gyrod stops: what is in flight is drained.");
  release_.wait_for_readers(kLastWord);
  engine_.hurry_after(stop_deadline_);  // holds for what the subscriber still hands over, too
  imu_subscriber_.stop();
  subscriber_.stop();
  fleet_.leave();  // takes no more from here on: others may
  const bool denoised = engine_.stop(stop_deadline_);
  if (standby_) standby_->stop();
  imu_topics_.stop_holding();
  keep_noise();
  publisher_.wait_for_acknowledgements(kLastWord);
  imu_topics_.wait_for_acknowledgements(kLastWord);
  fleet_.wait_for_acknowledgements(kLastWord);
  if (monitor_) monitor_->stop();
  return denoised;
}

std::vector<std::string> Service::look_at_peers() {
  return peers_ ? peers_->look(bus::PeerWatch::Clock::now()) : std::vector<std::string>{};
}

void Service::keep_noise() {
  const std::uint64_t revision = noise_.revision();
  if (revision == noise_kept_) return;
  if (noise_file_.save(noise_.learned())) noise_kept_ = revision;
}

void Service::judge() {
  engine_.judge_health();
  engine_.fit_curves();
  const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
  for (const auto& news : live_.tick(now.count(), seconds_since_1970(), engine_))
    spdlog::log(news.trouble ? spdlog::level::warn : spdlog::level::info, news.text);
}

void Service::hear(monitor::Tone tone, const std::string& line) {
  spdlog::log(tone == monitor::Tone::kTrouble ? spdlog::level::warn : spdlog::level::info, line);
  live_.events.add(seconds_since_1970(), "", line + ".");
}

monitor::View Service::view(const settings::Settings& settings, std::string simulate_command) {
  const settings::TopicSettings& topics = settings.bus.topics;
  std::vector<std::string> inputs = {topics.raw, topics.raw_batch};
  inputs.insert(inputs.end(), settings.bus.ros2.topics.begin(), settings.bus.ros2.topics.end());
  monitor::View view{.engine = [this] { return engine_.snapshot(); },
                     .visit_channels = [this](std::size_t limit,
                                              const auto& visit) { engine_.visit_channels(limit, visit); },
                     .channel = [this](std::string_view sensor) { return engine_.channel(sensor); },
                     .bus = [this] { return bus_snapshot(); },
                     .fleet = [this] { return fleet_snapshot(); },
                     .readiness = [this] { return readiness(); },
                     .config = [text = settings::text_of(settings)] { return text; },
                     .input = {.domain = settings.bus.domain,
                               .topics = std::move(inputs),
                               .simulate_command = std::move(simulate_command)},
                     .live = &live_};
  if (keeps_noise_) view.state_file_errors = [this] { return noise_file_.errors(); };
  return view;
}

monitor::Readiness Service::readiness() const {
  if (!ready_) return {false, "starting or stopping"};
  const auto& identity = domain_.identity();
  if (identity && std::chrono::system_clock::now() >= identity->expires_at)
    return {false, "a certificate has expired"};
  if (!fleet_.standing().active) return {false, "joining the daemons of the other shards"};
  return {true, ""};
}

monitor::FleetSnapshot Service::fleet_snapshot() const {
  const fleet::Standing standing = fleet_.standing();
  return {.shard = text_of(shard_),
          .active = standing.active,
          .peers = standing.peers,
          .twins = standing.twins,
          .overlapping = standing.overlapping,
          .missing = standing.missing,
          .disputes = standing.disputes,
          .foreign_samples = inlet_.foreign()};
}

std::optional<monitor::StandbySnapshot> Service::standby_snapshot() const {
  if (!standby_) return std::nullopt;
  const bus::StandbySnapshot now = standby_->snapshot() + imu_topics_.snapshot().standby;
  return monitor::StandbySnapshot{now.others, now.sensors, now.held, now.let_go, now.takeovers};
}

monitor::BusSnapshot Service::bus_snapshot() const {
  const bus::ImuTopicsSnapshot ros2 = imu_topics_.snapshot();
  const auto& identity = domain_.identity();
  const bus::BrokenPromises broken = subscriber_.broken_promises();
  std::vector<monitor::IncompatiblePeers> incompatible;
  for (const bus::PeerMismatch& kind : mismatch_watch_.mismatches())
    incompatible.push_back({std::string(kind.direction), std::string(kind.policy), kind.peers});
  std::vector<monitor::TopicReaders> readers;
  for (const auto& topics : {publisher_.matched_readers(), ros2.matched_readers}) {
    for (const bus::TopicReaders& topic : topics) readers.push_back({topic.topic, topic.readers});
  }
  return {.matched_writers = subscriber_.matched_writers() + ros2.matched_writers,
          .malformed_messages =
              subscriber_.malformed_messages() + ros2.malformed_messages + bus::unreadable_messages(),
          .refusals = subscriber_.refusals(),
          .write_errors = publisher_.write_errors() + ros2.write_errors,
          .ros2_topics = ros2.topics,
          .ros2_refused_topics = ros2.refused_topics,
          .ros2_dropped_messages = ros2.dropped_messages,
          .certificate_expiry_s =
              identity ? std::optional(static_cast<double>(identity->expires_at.time_since_epoch().count()))
                       : std::nullopt,
          .refused_peers = peers_ ? std::optional(peers_->refused()) : std::nullopt,
          .deadlines_missed = broken.deadlines_missed + ros2.broken_promises.deadlines_missed,
          .liveliness_lost = broken.liveliness_lost + ros2.broken_promises.liveliness_lost,
          .incompatible_peers = std::move(incompatible),
          .matched_readers = std::move(readers),
          .standby = standby_snapshot()};
}

}  // namespace gyrod::app
