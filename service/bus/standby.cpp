#include "bus/standby.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "bus/held_samples.hpp"
#include "bus/topic_reader.hpp"

namespace gyrod::bus {
namespace {

/// Time for one that starts, or was stopped for a while, to find those that run and to hear what they have published.
constexpr double kTimeToLook_s = 1.0;

/// How long what another daemon has published may wait to be looked at.
constexpr double kLongestTick_s = 0.02;

/// Other daemons that are looked at; more would be a mistake.
constexpr std::size_t kMostOthers = 16;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The writers of the same output in other processes.
class OtherWriters {
 public:
  explicit OtherWriters(std::uint32_t strength) : strength_(strength) {}

  void look(dds_entity_t reader) {
    std::array<dds_instance_handle_t, kMostOthers> handles{};
    const dds_return_t found = dds_get_matched_publications(reader, handles.data(), handles.size());
    stronger_.clear();
    for (std::size_t i = 0;
         i < std::min<std::size_t>(found > 0 ? static_cast<std::size_t>(found) : 0, kMostOthers); ++i)
      stronger_[handles[i]] = strength_of(reader, handles[i]) > strength_;
  }

  [[nodiscard]] std::size_t size() const noexcept { return stronger_.size(); }
  [[nodiscard]] bool is_stronger(dds_instance_handle_t writer) const {
    const auto found = stronger_.find(writer);
    return found != stronger_.end() && found->second;
  }
  [[nodiscard]] bool any_stronger() const {
    return std::ranges::any_of(stronger_, [](const auto& writer) { return writer.second; });
  }

 private:
  static std::uint32_t strength_of(dds_entity_t reader, dds_instance_handle_t writer) {
    dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader, writer);
    if (endpoint == nullptr) return 0;
    std::int32_t strength = 0;
    (void)dds_qget_ownership_strength(endpoint->qos, &strength);
    dds_builtintopic_free_endpoint(endpoint);
    return static_cast<std::uint32_t>(std::max(strength, 0));
  }

  std::uint32_t strength_;
  std::map<dds_instance_handle_t, bool> stronger_;
};

/// One sensor's output.
struct Sensor {
  Sensor(double takeover_s, std::size_t most) : denoised(takeover_s, most), realtime(takeover_s, most) {}
  HeldSamples denoised;
  HeldSamples realtime;
  bool ended = false;
  [[nodiscard]] bool is_active() const noexcept { return denoised.active() || realtime.active(); }
};

}  // namespace

class Standby::Impl {
 public:
  Impl(const Domain& domain, const BusOptions& options, Sink& sink)
      : domain_(domain),
        sink_(sink),
        takeover_s_(options.takeover_s),
        most_held_(options.output_depth),
        denoised_(domain.participant(), options.topics.denoised_batch,
                  standby_reader_qos(for_topic(options, options.topics.denoised_batch))),
        others_(options.ownership_strength),
        looking_since_s_(now_s()),
        ticked_s_(looking_since_s_) {
    if (options.realtime)
      realtime_.emplace(domain.participant(), options.topics.realtime_batch,
                        standby_reader_qos(for_topic(options, options.topics.realtime_batch)));
    thread_ = std::thread([this] { work(); });
  }

  ~Impl() { stop(); }

  void release(std::string_view sensor, std::span<const stream::DenoisedSample> samples,
               HeldSamples Sensor::*kind) {
    const std::lock_guard lock(mutex_);
    const double now = now_s();
    notice_a_pause(now);
    auto& [name, state] = sensor_of(sensor);
    state.ended = false;
    (state.*kind).release(samples, now);
    settle(name, state, now);
  }

  void end(std::string_view sensor) {
    const std::lock_guard lock(mutex_);
    const auto found = sensors_.find(sensor);
    if (found == sensors_.end()) return sink_.end(sensor);
    found->second.ended = true;
    if (is_over(found->second)) finish(found);
  }

  [[nodiscard]] bool publishes(std::string_view sensor) const {
    const std::lock_guard lock(mutex_);
    const auto found = sensors_.find(sensor);
    return found != sensors_.end() && found->second.denoised.active();
  }

  void stop() noexcept {
    if (!thread_.joinable()) return;
    constexpr std::chrono::milliseconds kLook{5};
    const double give_up = now_s() + kTimeToLook_s + takeover_s_;
    while (snapshot().held > 0 && now_s() < give_up) std::this_thread::sleep_for(kLook);
    stopping_.store(true, std::memory_order_relaxed);
    thread_.join();
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

  void work() {
    // Not a timed wait of the middleware: those go by the wall clock, which may be set.
    const std::chrono::duration<double> tick(std::min(kLongestTick_s, takeover_s_ / 20.0));
    while (!stopping_.load(std::memory_order_relaxed)) {
      std::this_thread::sleep_for(tick);
      const std::lock_guard lock(mutex_);
      const double now = now_s();
      notice_a_pause(now);
      ticked_s_ = now;
      others_.look(denoised_.get());
      listen(denoised_, &Sensor::denoised);
      if (realtime_) listen(*realtime_, &Sensor::realtime);
      settle_all(now);
      if (std::ranges::any_of(sensors_, [](const auto& sensor) { return sensor.second.is_active(); }))
        sink_.assert_liveliness();
    }
  }

  /// Who was stopped has been taken for dead: another daemon may publish by now.
  void notice_a_pause(double now) {
    if (now - ticked_s_ < 0.5 * takeover_s_) return;
    ticked_s_ = now;
    if (others_.size() == 0) return;
    looking_since_s_ = now;
    for (auto& [name, sensor] : sensors_) {
      sensor.denoised.doubt();
      sensor.realtime.doubt();
    }
  }

  void listen(const TopicReader<gyrod_DenoisedBatch>& reader, HeldSamples Sensor::*kind) {
    const auto hear = [&](const gyrod_DenoisedBatch& message, const dds_sample_info_t& info) {
      if (!fits_wire(message.sensor)) return;
      if (info.valid_data && message.samples._length > 0) {
        const gyrod_DenoisedElement& newest = message.samples._buffer[message.samples._length - 1];
        (sensor_of(message.sensor).second.*kind)
            .hear({newest.sequence_number, newest.stamp_ns}, others_.is_stronger(info.publication_handle));
      } else if (const auto found = sensors_.find(std::string_view(message.sensor));
                 found != sensors_.end()) {
        (found->second.*kind).hear_end();
        if (is_over(found->second) && !found->second.is_active()) count_and_erase(found);
      }
    };
    while (reader.take(hear) > 0) {
    }
  }

  Sensors::reference sensor_of(std::string_view name) {
    const auto found = sensors_.find(name);
    return found != sensors_.end() ? *found : *sensors_.emplace(name, Sensor(takeover_s_, most_held_)).first;
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
    const Others others{.any = others_.size() > 0,
                        .stronger = others_.any_stronger(),
                        .looked = now - looking_since_s_ >= kTimeToLook_s};
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
  double takeover_s_;
  std::size_t most_held_;
  TopicReader<gyrod_DenoisedBatch> denoised_;
  std::optional<TopicReader<gyrod_DenoisedBatch>> realtime_;
  mutable std::mutex mutex_;  ///< for all that follows
  OtherWriters others_;
  double looking_since_s_;
  double ticked_s_;
  Sensors sensors_;
  StandbySnapshot ended_;  ///< counts of sensors that have ended
  std::vector<stream::DenoisedSample> outbox_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
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
