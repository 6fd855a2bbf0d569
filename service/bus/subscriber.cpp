#include "bus/subscriber.hpp"

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "bus/hand_over.hpp"
#include "bus/input_reader.hpp"
#include "bus/log.hpp"
#include "bus/lost_writers.hpp"
#include "bus/sample_run.hpp"
#include "bus/sensor_states.hpp"

namespace gyrod::bus {
namespace {

enum Topic : std::size_t { kSingles, kBatches, kTopics };
/// A topic has two readers at the most.
constexpr std::size_t kReaders = InputReader<gyrod_GyroSample>::kSides;
/// Sensors whose last writer is known, the ended ones among them.
constexpr std::size_t kMostOrigins = 131072;
static_assert(kTopics * kReaders <= SensorStates::kMaxSources);

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
        book_(domain, {TopicType<gyrod_GyroSample>::kDescriptor->m_typename,
                       TopicType<gyrod_GyroBatch>::kDescriptor->m_typename}),
        promises_(domain),
        waitset_(create_waitset(domain)) {
    const Attendants attendants{waitset_->get(), &promises_};
    const auto open = [&](auto& reader, const std::string& topic, std::uint64_t mask) {
      const BusOptions own = for_topic(options, topic);
      reader.emplace(domain.participant(), topic, own.input_reliability,
                     [own](Reliability reliability) { return input_reader_qos(own, reliability); });
      reader->attend(attendants, own.input, mask);
    };
    open(singles_, options.topics.raw, kSingles * kReaders);
    open(batches_, options.topics.raw_batch, kBatches * kReaders);
    check(dds_waitset_attach(waitset_->get(), book_.condition(), 0), "wait for writers");
    check(dds_waitset_attach(waitset_->get(), promises_.condition(), 0), "wait for broken promises");
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

  [[nodiscard]] BrokenPromises broken_promises() const noexcept { return broken_promises_.counts(); }

 private:
  void work() noexcept {
    while (!stopping_.load(std::memory_order_relaxed)) {
      (void)dds_waitset_wait(waitset_->get(), nullptr, 0, DDS_INFINITY);
      serve_new_writers();
      heed_broken_promises();
      take();
      serve_new_writers();  // those that taking has heard of: nothing else may wake this thread for them
    }
  }

  /// Opens a reader for best-effort writers where one is needed. Where DDS refuses it, the first reader stays the only one.
  void serve_new_writers() noexcept {
    for (const WriterBook::Writer& writer : book_.take_news()) {
      try {
        singles_->serve(writer);
        batches_->serve(writer);
      } catch (const BusError& error) {
        log(LogLevel::kWarning, error.what());
      }
    }
  }

  void heed_broken_promises() noexcept {
    for (const PromiseWatch::Event& event : promises_.take()) {
      if (event.kind == PromiseWatch::Event::Kind::kDeadlineMissed) {
        heed_deadline(event);
      } else if (event.kind == PromiseWatch::Event::Kind::kLivelinessLost) {
        const std::vector<std::string> sensors = lost_writers_.lose(event.handle);
        broken_promises_.set_losses(lost_writers_.losses());
        for (const std::string& sensor : sensors)
          hand_over_.on_broken_promise(sensor, stream::ChannelState::kLivelinessLost);
      } else {
        lost_writers_.forget(event.handle);
      }
    }
  }

  /// A sensor that has changed to the other topic, or whose samples the other reader hands on, misses nothing.
  void heed_deadline(const PromiseWatch::Event& event) noexcept {
    const std::size_t side = event.source % kReaders;
    const bool single = event.source / kReaders == kSingles;
    const std::string sensor = single ? sensor_of<gyrod_GyroSample>(singles_->reader(side), event.handle)
                                      : sensor_of<gyrod_GyroBatch>(batches_->reader(side), event.handle);
    if (!states_.sends_by(sensor, event.source)) return;
    broken_promises_.count_deadline();
    hand_over_.on_broken_promise(sensor, stream::ChannelState::kDeadlineMissed);
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

  [[nodiscard]] auto receiver(Topic topic) {
    return [this, topic](std::size_t side, const auto& message, const auto& info) {
      receive(topic * kReaders + side, message, info);
    };
  }

  /// Takes once from both topics and settles what has ended. @return messages taken
  std::size_t take() noexcept {
    std::size_t taken = singles_->take(book_, receiver(kSingles));
    taken += batches_->take(book_, receiver(kBatches));
    run_.flush();
    for (const SensorStates::Ending& ending : states_.take_ending()) settle(ending);
    return taken;
  }

  template <class Message>
  void receive(std::size_t source, const Message& message, const dds_sample_info_t& info) {
    const std::string_view sensor(message.sensor);
    const std::span wire = info.valid_data ? samples_of(message) : decltype(samples_of(message)){};
    if (sensor.empty() || wire.size() > max_batch_samples_) {
      malformed_.fetch_add(1, std::memory_order_relaxed);
    } else {
      // What was cached before the writer was lost may come in the same go: it is of another generation.
      if (info.valid_data && info.view_state == DDS_NEW_VIEW_STATE && info.absolute_generation_rank == 0)
        heed_beginning(sensor, info.publication_handle);
      run_.add(sensor, wire);
    }
    // The end of a sensor that never sent a sample is no news.
    if (!sensor.empty() && (info.valid_data || states_.knows(sensor))) {
      states_.show(sensor, source, info.instance_state == DDS_ALIVE_INSTANCE_STATE, info.publication_handle);
    }
  }

  /// Samples of a sensor begin to come: those of a writer that had sent them before it was out of sight come once more.
  void heed_beginning(std::string_view sensor, dds_instance_handle_t writer) {
    const auto now = book_.last_sighting(writer);
    if (!now) return;
    if (origins_.size() >= kMostOrigins) origins_.clear();  // what they had sent is taken for new
    WriterBook::Sighting& before = origins_[std::string(sensor)];
    if (now->is_return_of(before)) {
      run_.flush();
      hand_over_.on_return(sensor);
    }
    before = *now;
  }

  /// A topic showed the sensor as ended: hands over the rest of it, then tells its end unless it came back to
  /// life.
  void settle(const SensorStates::Ending& ending) {
    singles_->take_sensor(book_, ending.sensor, receiver(kSingles));
    batches_->take_sensor(book_, ending.sensor, receiver(kBatches));
    run_.flush();
    if (!states_.forget_if_ended(ending.sensor)) return;
    hand_over_.on_end(ending.sensor);
    if (lost_writers_.end(ending.sensor, ending.writer))
      hand_over_.on_broken_promise(ending.sensor, stream::ChannelState::kLivelinessLost);
  }

  Domain domain_;
  std::size_t max_batch_samples_;
  HandOver hand_over_;
  SampleRun<stream::Sample, SampleHandler> run_;
  SensorStates states_;
  mutable std::mutex topics_mutex_;  ///< for those who only count; the readers go in leave()
  WriterBook book_;
  std::unordered_map<std::string, WriterBook::Sighting>
      origins_;  ///< of sensors, also of some that have ended
  PromiseWatch promises_;
  LostWriters lost_writers_;
  std::optional<InputReader<gyrod_GyroSample>> singles_;
  std::optional<InputReader<gyrod_GyroBatch>> batches_;
  std::optional<Entity> waitset_;
  std::uint64_t last_refusals_ = 0;
  std::atomic<bool> stopping_{false};
  std::atomic<std::uint64_t> malformed_{0};
  BrokenPromiseCounter broken_promises_;
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
BrokenPromises Subscriber::broken_promises() const noexcept { return impl_->broken_promises(); }

}  // namespace gyrod::bus
