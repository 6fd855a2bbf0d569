#include "bus/subscriber.hpp"

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "bus/sample_run.hpp"
#include "bus/sensor_states.hpp"
#include "bus/topic_reader.hpp"

namespace gyrod::bus {
namespace {

enum Topic : std::size_t { kSingles, kBatches, kTopics };
static_assert(kTopics <= SensorStates::kMaxTopics);

/// Hands over at once, or keeps for later.
class HandOver final : public SampleHandler {
 public:
  explicit HandOver(SampleHandler& handler) : handler_(handler) {}

  void on_samples(std::string_view sensor, std::span<const stream::Sample> samples) noexcept override {
    if (!keeping_) return handler_.on_samples(sensor, samples);
    kept_.push_back({std::string(sensor), {samples.begin(), samples.end()}});
  }
  void on_end(std::string_view sensor) noexcept override {
    if (!keeping_) return handler_.on_end(sensor);
    kept_.push_back({std::string(sensor), {}});
  }

  void keep() noexcept { keeping_ = true; }
  void hand_over_kept() noexcept {
    keeping_ = false;
    for (const Kept& kept : kept_) {
      if (kept.samples.empty()) {
        handler_.on_end(kept.sensor);
      } else {
        handler_.on_samples(kept.sensor, kept.samples);
      }
    }
    kept_.clear();
  }

 private:
  struct Kept {
    std::string sensor;
    std::vector<stream::Sample> samples;  ///< none: the sensor has ended
  };

  SampleHandler& handler_;
  bool keeping_ = false;
  std::vector<Kept> kept_;
};

Entity create_waitset(const Domain& domain) {
  return {dds_create_waitset(domain.participant()), "create a waitset"};
}

}  // namespace

class Subscriber::Impl {
 public:
  Impl(const Domain& domain, const BusOptions& options, SampleHandler& handler)
      : domain_(domain),
        max_batch_samples_(options.max_batch_samples),
        hand_over_(handler),
        run_(hand_over_),
        singles_(std::in_place, domain.participant(), options.topics.raw, input_reader_qos(options)),
        batches_(std::in_place, domain.participant(), options.topics.raw_batch, input_reader_qos(options)),
        waitset_(create_waitset(domain)) {
    check(dds_waitset_attach(waitset_->get(), singles_->data_condition(), 0),
          "wait for topic '" + options.topics.raw + "'");
    check(dds_waitset_attach(waitset_->get(), batches_->data_condition(), 0),
          "wait for topic '" + options.topics.raw_batch + "'");
    check(dds_waitset_attach(waitset_->get(), waitset_->get(), 0), "wait for the stop");
  }

  ~Impl() {
    stop();
    if (singles_) leave();  // never started
  }

  void start() {
    thread_ = std::thread([this] { work(); });
  }

  void stop() noexcept {
    if (!thread_.joinable()) return;
    stopping_.store(true, std::memory_order_relaxed);
    (void)dds_waitset_set_trigger(waitset_->get(), true);
    thread_.join();
    leave();
    hand_over_.hand_over_kept();
  }

  [[nodiscard]] std::size_t matched_writers() const noexcept {
    const std::lock_guard lock(topics_mutex_);
    if (!singles_) return 0;
    return std::size_t{singles_->matched().current_count} + batches_->matched().current_count;
  }

  [[nodiscard]] std::uint64_t malformed_messages() const noexcept {
    return malformed_.load(std::memory_order_relaxed);
  }

  [[nodiscard]] std::uint64_t refusals() const noexcept {
    const std::lock_guard lock(topics_mutex_);
    return singles_ ? singles_->refusals() + batches_->refusals() : last_refusals_;
  }

 private:
  void work() noexcept {
    while (!stopping_.load(std::memory_order_relaxed)) {
      (void)dds_waitset_wait(waitset_->get(), nullptr, 0, DDS_INFINITY);
      take();
    }
  }

  /// Leaves both topics with empty caches and loses nothing of what was confirmed.
  ///
  /// Where a cache is full, the middleware's receiving thread waits in it, and a reader with a thread in it
  /// cannot be deleted: dds_delete() would wait for ever. So the domain stops listening first; then what is
  /// cached and what that thread still holds is taken, kept, and handed over once the domain listens again:
  /// our writers' readers wait for answers, too, and the engine may take its time.
  void leave() noexcept {
    (void)dds_domain_set_deafmute(domain_.participant(), true, false, DDS_INFINITY);
    hand_over_.keep();
    take_rest();
    {
      const std::lock_guard lock(topics_mutex_);
      last_refusals_ = singles_->refusals() + batches_->refusals();
      waitset_.reset();
      batches_.reset();
      singles_.reset();
    }
    (void)dds_domain_set_deafmute(domain_.participant(), false, false, DDS_INFINITY);
  }

  /// Takes until nothing has come for longer than the receiving thread pauses between two tries (10 ms).
  /// Writers of this process do not go through the network and may never pause: the time is bounded.
  void take_rest() noexcept {
    constexpr std::chrono::milliseconds kPause{5};
    constexpr int kQuietPauses = 6;
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds{2};
    for (int quiet = 0; quiet < kQuietPauses && std::chrono::steady_clock::now() < give_up; ++quiet) {
      if (take() > 0) {
        quiet = -1;
      } else {
        std::this_thread::sleep_for(kPause);
      }
    }
  }

  /// Takes once from both topics and settles what has ended. @return messages taken
  std::size_t take() noexcept {
    const std::size_t taken = singles_->take([this](const auto& message, const auto& info) {
      receive(kSingles, message, info);
    }) + batches_->take([this](const auto& message, const auto& info) { receive(kBatches, message, info); });
    run_.flush();
    for (const std::string& sensor : states_.take_ending()) settle(sensor);
    return taken;
  }

  template <class Message>
  void receive(Topic topic, const Message& message, const dds_sample_info_t& info) {
    const std::string_view sensor(message.sensor);
    const std::span wire = info.valid_data ? samples_of(message) : decltype(samples_of(message)){};
    if (sensor.empty() || wire.size() > max_batch_samples_) {
      malformed_.fetch_add(1, std::memory_order_relaxed);
    } else {
      run_.add(sensor, wire);
    }
    // The end of a sensor that never sent a sample is no news.
    if (!sensor.empty() && (info.valid_data || states_.knows(sensor))) {
      states_.show(sensor, topic, info.instance_state == DDS_ALIVE_INSTANCE_STATE);
    }
  }

  /// A topic showed the sensor as ended: hands over the rest of it, then tells its end unless it came back to
  /// life.
  void settle(const std::string& sensor) {
    singles_->take_sensor(
        sensor, [this](const auto& message, const auto& info) { receive(kSingles, message, info); });
    batches_->take_sensor(
        sensor, [this](const auto& message, const auto& info) { receive(kBatches, message, info); });
    run_.flush();
    if (states_.forget_if_ended(sensor)) hand_over_.on_end(sensor);
  }

  Domain domain_;
  std::size_t max_batch_samples_;
  HandOver hand_over_;
  SampleRun<stream::Sample, SampleHandler> run_;
  SensorStates states_;
  mutable std::mutex topics_mutex_;  ///< for those who only count; the readers go in leave()
  std::optional<TopicReader<gyrod_GyroSample>> singles_;
  std::optional<TopicReader<gyrod_GyroBatch>> batches_;
  std::optional<Entity> waitset_;
  std::uint64_t last_refusals_ = 0;
  std::atomic<bool> stopping_{false};
  std::atomic<std::uint64_t> malformed_{0};
  std::thread thread_;
};

Subscriber::Subscriber(const Domain& domain, const BusOptions& options, SampleHandler& handler)
    : impl_(std::make_unique<Impl>(domain, options, handler)) {}
Subscriber::~Subscriber() = default;

void Subscriber::start() { impl_->start(); }
void Subscriber::stop() noexcept { impl_->stop(); }
std::size_t Subscriber::matched_writers() const noexcept { return impl_->matched_writers(); }
std::uint64_t Subscriber::malformed_messages() const noexcept { return impl_->malformed_messages(); }
std::uint64_t Subscriber::refusals() const noexcept { return impl_->refusals(); }

}  // namespace gyrod::bus
