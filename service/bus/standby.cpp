#include "bus/standby.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "bus/held_samples.hpp"
#include "bus/other_daemons.hpp"
#include "bus/promise_watch.hpp"
#include "bus/ticker.hpp"
#include "bus/topic_reader.hpp"

namespace gyrod::bus {
namespace {

/// One sensor's output.
struct Sensor {
  explicit Sensor(const HoldRules& rules) : denoised(rules), realtime(rules) {}
  HeldSamples<stream::DenoisedSample> denoised;
  HeldSamples<stream::DenoisedSample> realtime;
  bool here = false;   ///< this daemon releases samples of it; else it was only heard
  bool ended = false;  ///< it did, and the sensor has ended
  [[nodiscard]] bool is_active() const noexcept { return denoised.active() || realtime.active(); }
};
using Kind = HeldSamples<stream::DenoisedSample> Sensor::*;

}  // namespace

class Standby::Impl {
 public:
  Impl(const Domain& domain, const BusOptions& options, Sink& sink)
      : domain_(domain),
        sink_(sink),
        signs_(domain),
        rules_{.takeover_s = options.takeover_s, .most = options.output_depth},
        denoised_(domain.participant(), options.topics.denoised_batch,
                  standby_reader_qos(for_topic(options, options.topics.denoised_batch))),
        others_(options.ownership_strength, options.takeover_s, steady_now_s()) {
    if (options.realtime)
      realtime_.emplace(domain.participant(), options.topics.realtime_batch,
                        standby_reader_qos(for_topic(options, options.topics.realtime_batch)));
    QosProfile signs_of_life;
    signs_of_life.lease_s = 0.5 * options.takeover_s;
    signs_.watch(denoised_.get(), signs_of_life, 0);
    ticker_.emplace(tick_s(options.takeover_s), [this] { tick(); });
  }

  ~Impl() { stop(); }

  void release(std::string_view sensor, std::span<const stream::DenoisedSample> samples, Kind kind) {
    const std::lock_guard lock(mutex_);
    const double now = steady_now_s();
    heed_a_pause(now);
    auto& [name, state] = sensor_of(sensor);
    // Beside a stronger one that has begun not one more: readers would drop it.
    if (state.is_active() && others_.now(now).stronger) listen_all(now);
    state.here = true;
    state.ended = false;
    (state.*kind).release(samples, now);
    settle(name, state, now);
  }

  void end(std::string_view sensor) {
    const std::lock_guard lock(mutex_);
    const auto found = sensors_.find(sensor);
    if (found == sensors_.end()) return sink_.end(sensor);
    found->second.here = false;
    found->second.ended = true;
    found->second.denoised.complete();
    found->second.realtime.complete();
    if (is_over(found->second)) finish(found);
  }

  [[nodiscard]] bool publishes(std::string_view sensor) const {
    const std::lock_guard lock(mutex_);
    const auto found = sensors_.find(sensor);
    return found != sensors_.end() && found->second.denoised.active();
  }

  void stop() noexcept {
    if (!ticker_) return;
    constexpr std::chrono::milliseconds kLook{5};
    const double give_up = steady_now_s() + kTimeToLook_s + rules_.takeover_s;
    while (snapshot().held > 0 && steady_now_s() < give_up) std::this_thread::sleep_for(kLook);
    ticker_.reset();
  }

  [[nodiscard]] StandbySnapshot snapshot() const {
    const std::lock_guard lock(mutex_);
    StandbySnapshot snapshot = ended_;
    snapshot.others = others_.size();
    for (const auto& [name, sensor] : sensors_) add(sensor, snapshot);
    return snapshot;
  }

 private:
  using Sensors = std::map<std::string, Sensor, std::less<>>;

  static void add(const Sensor& sensor, StandbySnapshot& snapshot) noexcept {
    snapshot.sensors += sensor.denoised.active() ? 1U : 0U;
    snapshot.held += sensor.denoised.size() + sensor.realtime.size();
    snapshot.let_go += sensor.denoised.let_go();
    snapshot.takeovers += sensor.denoised.takeovers();
  }

  void tick() {
    const std::lock_guard lock(mutex_);
    const double now = steady_now_s();
    heed_a_pause(now);
    others_.heed(signs_.take());
    others_.look(denoised_.get(), now);
    listen_all(now);
    settle_all(now);
    if (std::ranges::any_of(sensors_, [](const auto& sensor) { return sensor.second.is_active(); }))
      sink_.assert_liveliness();
  }

  void heed_a_pause(double now) {
    if (!others_.was_stopped(now)) return;
    for (auto& [name, sensor] : sensors_) {
      sensor.denoised.doubt();
      sensor.realtime.doubt();
    }
  }

  void listen_all(double now_s) {
    listen(denoised_, &Sensor::denoised, now_s);
    if (realtime_) listen(*realtime_, &Sensor::realtime, now_s);
  }

  void listen(const TopicReader<gyrod_DenoisedBatch>& reader, Kind kind, double now_s) {
    const auto hear = [&](const gyrod_DenoisedBatch& message, const dds_sample_info_t& info) {
      if (!fits_wire(message.sensor)) return;
      if (info.valid_data && message.samples._length > 0) {
        const gyrod_DenoisedElement& newest = message.samples._buffer[message.samples._length - 1];
        (sensor_of(message.sensor).second.*kind)
            .hear({newest.sequence_number, newest.stamp_ns}, others_.is_stronger(info.publication_handle));
      }
      if (info.instance_state != DDS_ALIVE_INSTANCE_STATE) hear_end(message.sensor, kind, now_s);
    };
    while (reader.take(hear) > 0) {
    }
  }

  /// The other is gone or silent, or the sensor has ended there. What it published stays known as long as the sensor is here.
  void hear_end(std::string_view name, Kind kind, double now_s) {
    const auto found = sensors_.find(name);
    if (found == sensors_.end()) return;
    Sensor& sensor = found->second;
    (sensor.*kind).hear_end(now_s);
    if (!sensor.here && !sensor.ended && !sensor.is_active()) count_and_erase(found);
  }

  Sensors::reference sensor_of(std::string_view name) {
    const auto found = sensors_.find(name);
    return found != sensors_.end() ? *found : *sensors_.emplace(name, Sensor(rules_)).first;
  }

  void settle_all(double now) {
    for (auto sensor = sensors_.begin(); sensor != sensors_.end();) {
      settle(sensor->first, sensor->second, now);
      const auto next = std::next(sensor);
      if (sensor->second.ended && is_over(sensor->second)) finish(sensor);
      sensor = next;
    }
  }

  /// Publishes what is to be published now.
  void settle(const std::string& name, Sensor& sensor, double now) {
    const Others others = others_.now(now);
    const auto keep = [this](const stream::DenoisedSample& sample) { outbox_.push_back(sample); };
    sensor.realtime.take(now, others, keep);
    if (!outbox_.empty()) sink_.publish_realtime(name, outbox_);
    outbox_.clear();
    sensor.denoised.take(now, others, keep);
    if (!outbox_.empty()) sink_.publish(name, outbox_);
    outbox_.clear();
  }

  static bool is_over(const Sensor& sensor) noexcept {
    return sensor.denoised.size() == 0 && sensor.realtime.size() == 0;
  }

  void finish(Sensors::iterator sensor) {
    sink_.end(sensor->first);
    count_and_erase(sensor);
  }

  void count_and_erase(Sensors::iterator sensor) {
    ended_.let_go += sensor->second.denoised.let_go();
    ended_.takeovers += sensor->second.denoised.takeovers();
    sensors_.erase(sensor);
  }

  Domain domain_;
  Sink& sink_;
  PromiseWatch signs_;  ///< outlives the reader it listens to
  HoldRules rules_;
  TopicReader<gyrod_DenoisedBatch> denoised_;
  std::optional<TopicReader<gyrod_DenoisedBatch>> realtime_;
  mutable std::mutex mutex_;  ///< for all that follows
  OtherDaemons others_;
  Sensors sensors_;
  StandbySnapshot ended_;  ///< counts of sensors that have ended
  std::vector<stream::DenoisedSample> outbox_;
  std::optional<Ticker> ticker_;  ///< ends before all it looks at
};

Standby::Standby(const Domain& domain, const BusOptions& options, Sink& sink)
    : impl_(std::make_unique<Impl>(domain, options, sink)) {}
Standby::~Standby() = default;
void Standby::release(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept {
  impl_->release(sensor, samples, &Sensor::denoised);
}
void Standby::release_realtime(std::string_view sensor,
                               std::span<const stream::DenoisedSample> samples) noexcept {
  impl_->release(sensor, samples, &Sensor::realtime);
}
void Standby::end(std::string_view sensor) noexcept { impl_->end(sensor); }
bool Standby::publishes(std::string_view sensor) const noexcept { return impl_->publishes(sensor); }
void Standby::stop() noexcept { impl_->stop(); }
StandbySnapshot Standby::snapshot() const { return impl_->snapshot(); }

}  // namespace gyrod::bus
