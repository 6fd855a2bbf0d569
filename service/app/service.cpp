#include "app/service.hpp"

#include <algorithm>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <spdlog/spdlog.h>

#include "app/errors.hpp"
#include "app/options.hpp"
#include "bus/log.hpp"
#include "settings/dump.hpp"

namespace gyrod::app {
namespace {

/// How long readers may take in all to confirm what a stop releases.
constexpr std::chrono::seconds kLastWord{5};

/// One line a sensor, also where axes change one by one; warming up is told by metrics alone.
void log_health(std::string_view sensor, const stream::SensorHealth& before,
                const stream::SensorHealth& now) noexcept {
  if (before.state == now.state) return;
  const bool troubled = now.state > stream::Health::kWarmingUp;
  const bool was_troubled = before.state > stream::Health::kWarmingUp;
  if (!troubled && !was_troubled) return;
  const auto worst = std::ranges::find(now.axis, now.state, &stream::AxisHealth::state);
  spdlog::log(troubled ? spdlog::level::warn : spdlog::level::info,
              "{} is {}, before {} (axis {}, {:.4g} against {:.4g})", sensor, stream::name_of(now.state),
              stream::name_of(before.state),
              stream::kAxisNames[static_cast<std::size_t>(worst - now.axis.begin())], worst->value,
              worst->limit);
}

/// An event of what becomes of a sensor.
void tell(live::Live& live, std::string_view sensor, const char* what) noexcept {
  const std::chrono::duration<double> since_epoch = std::chrono::system_clock::now().time_since_epoch();
  try {
    live.events.add(since_epoch.count(), sensor, std::string(sensor) + " " + what + ".");
  } catch (const std::bad_alloc&) {
    return;  // an event less
  }
}

/// Time for readers to take one cache of messages: 50 000 samples a second at the default depth.
constexpr std::chrono::milliseconds kBreath{20};

}  // namespace

/// All at once, or, while there is patience, no more at a time than the writers keep.
template <class Publish>
void ReleaseToBus::in_parts(std::span<const stream::DenoisedSample> samples,
                            const Publish& publish) noexcept {
  while (patience_ns_ > 0 && !samples.empty()) {
    const auto part = samples.first(std::min(samples.size(), depth_));
    let_readers_catch_up(part.size());
    publish(part);
    samples = samples.subspan(part.size());
  }
  if (!samples.empty()) publish(samples);
}

void ReleaseToBus::on_samples(std::string_view sensor,
                              std::span<const stream::DenoisedSample> samples) noexcept {
  live_.tap.on_denoised(sensor, samples);
  if (imu_topics_.publish(sensor, samples)) return;
  if (standby_ != nullptr) return standby_->release(sensor, samples);
  publish(sensor, samples);
}

void ReleaseToBus::on_realtime(std::string_view sensor,
                               std::span<const stream::DenoisedSample> samples) noexcept {
  if (imu_topics_.publish_realtime(sensor, samples)) return;
  if (standby_ != nullptr) return standby_->release_realtime(sensor, samples);
  publish_realtime(sensor, samples);
}

void ReleaseToBus::publish(std::string_view sensor,
                           std::span<const stream::DenoisedSample> samples) noexcept {
  in_parts(samples, [&](const auto& part) { publisher_.publish(sensor, part); });
  if (!samples.empty()) published_.note(sensor, samples.back());
}

void ReleaseToBus::publish_realtime(std::string_view sensor,
                                    std::span<const stream::DenoisedSample> samples) noexcept {
  in_parts(samples, [&](const auto& part) { publisher_.publish_realtime(sensor, part); });
}

void ReleaseToBus::end(std::string_view sensor) noexcept {
  publisher_.unregister_sensor(sensor);
  published_.forget(sensor);
}

void ReleaseToBus::on_report(std::string_view sensor, const stream::NoiseReport& report) noexcept {
  live_.tap.on_report(sensor, report);
  if (standby_ == nullptr || standby_->publishes(sensor)) publisher_.publish_report(sensor, report);
}

void ReleaseToBus::on_end(std::string_view sensor) noexcept {
  tell(live_, sensor, "has ended");
  if (standby_ != nullptr) return standby_->end(sensor);
  end(sensor);
}

void ReleaseToBus::on_health(std::string_view sensor, const stream::SensorHealth& before,
                             const stream::SensorHealth& now) noexcept {
  const auto since_epoch = std::chrono::system_clock::now().time_since_epoch();
  publisher_.publish_health(sensor, before, now,
                            std::chrono::duration_cast<std::chrono::nanoseconds>(since_epoch).count());
  log_health(sensor, before, now);
  try {
    live_.events.add_health(std::chrono::duration<double>(since_epoch).count(), sensor, before, now);
  } catch (const std::bad_alloc&) {
    return;  // the log above and the topic have it
  }
}

void ReleaseToBus::on_forgotten(std::string_view sensor) noexcept {
  publisher_.unregister_health(sensor);
  tell(live_, sensor, "is forgotten: it has sent nothing for long");
}

/// Before so many more samples: gives readers the time to take or to ask again for what the writers are about
/// to let go. Their confirmation is asked for by a timer of the middleware, not at once, so it is not waited
/// for to the end.
void ReleaseToBus::let_readers_catch_up(std::size_t samples) noexcept {
  if ((unconfirmed_ += samples) <= depth_) return;
  unconfirmed_ = samples;
  const auto begin = std::chrono::steady_clock::now();
  publisher_.wait_for_acknowledgements(kBreath);
  patience_ns_ -= std::chrono::nanoseconds(std::chrono::steady_clock::now() - begin).count();
}

Service::Service(const settings::Settings& settings, std::string simulate_command)
    : stop_deadline_(static_cast<std::int64_t>(settings.stop_deadline_s * 1e3)),
      shard_(bus_options(settings.bus).shard.value_or(fleet::Shard{})),
      keeps_noise_(!settings.noise.state_file.empty()),
      noise_file_(settings.noise.state_file, [](const std::string& line) { spdlog::warn(line); }),
      noise_(settings.noise, noise_file_.load()),
      domain_(settings.bus.domain, settings.bus.network, settings.bus.security.folder),
      publisher_(domain_, live_bus_options(settings)),
      imu_topics_(domain_, live_bus_options(settings)),
      published_(settings.restart.published_file, settings.engine.max_channels,
                 [](const std::string& line) { spdlog::warn(line); }),
      release_(publisher_, imu_topics_, published_, live_, settings.bus.output.history_depth),
      engine_(live_engine_options(settings, noise_, published_), method(settings), release_),
      inlet_(engine_, live_.tap),
      feed_(inlet_, imu_topics_),
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
    monitor_.emplace(monitor_options(settings.monitor), view(settings, std::move(simulate_command)));
  } catch (const monitor::AccessError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw Unavailable(error.what());
  }
}

void Service::start() {
  if (monitor_) monitor_->start();
  fleet_.start();
  subscriber_.start();
  imu_subscriber_.start();
  ready_ = true;
}

bool Service::stop() {
  ready_ = false;
  release_.wait_for_readers(kLastWord);
  engine_.hurry_after(stop_deadline_);  // holds for what the subscriber still hands over, too
  imu_subscriber_.stop();
  subscriber_.stop();
  fleet_.leave();  // takes no more from here on: others may
  const bool denoised = engine_.stop(stop_deadline_);
  if (standby_) standby_->stop();
  keep_noise();
  publisher_.wait_for_acknowledgements(kLastWord);
  imu_topics_.wait_for_acknowledgements(kLastWord);
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
  live_.tick(now.count(), engine_);
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
  const bus::StandbySnapshot now = standby_->snapshot();
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
