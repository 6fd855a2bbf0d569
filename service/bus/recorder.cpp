#include "bus/recorder.hpp"

#include "bus/input_reader.hpp"
#include "bus/sample_run.hpp"
#include "bus/sensor_states.hpp"
#include "bus/topic_discovery.hpp"

namespace gyrod::bus {
namespace {

template <class Message>
constexpr const char* type_name_of() noexcept {
  return TopicType<Message>::kDescriptor->m_typename;
}

/// What the configuration says about a topic under one of its names.
std::optional<TopicFound> configured_topic(const BusOptions& options, const std::string& topic) {
  const TopicNames& names = options.topics;
  const auto input = [&](const char* type) { return TopicFound{type, options.input.partitions}; };
  const auto output = [&](const char* type) {
    return TopicFound{type, options.output.partitions, options.ownership_strength > 0};
  };
  if (topic == names.raw) return input(type_name_of<gyrod_GyroSample>());
  if (topic == names.raw_batch) return input(type_name_of<gyrod_GyroBatch>());
  if (topic == names.denoised || topic == names.realtime) return output(type_name_of<gyrod_DenoisedSample>());
  if (topic == names.denoised_batch || topic == names.realtime_batch)
    return output(type_name_of<gyrod_DenoisedBatch>());
  return std::nullopt;
}

}  // namespace

/// The recorder without the type of its topic.
class Recorder::Source {
 public:
  virtual ~Source() = default;
  virtual Poll poll(std::chrono::milliseconds timeout, RecordHandler& handler) = 0;
  [[nodiscard]] virtual std::string_view type_name() const noexcept = 0;
  [[nodiscard]] virtual std::size_t matched_writers() const noexcept = 0;
};

template <class Message>
class Recorder::TypedSource final : public Source {
 public:
  /// @param make_qos gives the reader's QoS for a Reliability
  template <class MakeQos>
  TypedSource(const Domain& domain, const std::string& topic, const MakeQos& make_qos)
      : domain_(domain),
        book_(domain, {type_name_of<Message>()}),
        waitset_(dds_create_waitset(domain.participant()), "create a waitset"),
        reader_(domain.participant(), topic, InputReliability::kAuto, make_qos) {
    reader_.attend({.waitset = waitset_.get()}, {}, 0);
    await_matches(0);
    check(dds_waitset_attach(waitset_.get(), book_.condition(), 0), "wait for writers");
  }

  Poll poll(std::chrono::milliseconds timeout, RecordHandler& handler) override {
    const dds_time_t deadline = dds_time() + DDS_MSECS(timeout.count());
    while (true) {
      for (const WriterBook::Writer& writer : book_.take_news()) {
        if (reader_.serve(writer)) await_matches(1);
      }
      // Asked before the cache: what the last writer wrote is in the cache by the time it counts as gone.
      const dds_subscription_matched_status_t writers = reader_.matched();
      if (take(handler)) return Poll::kSamples;
      if (writers.total_count > 0 && writers.current_count == 0) return Poll::kEnded;
      if (dds_waitset_wait_until(waitset_.get(), nullptr, 0, deadline) <= 0) return Poll::kNothing;
    }
  }

  [[nodiscard]] std::string_view type_name() const noexcept override { return type_name_of<Message>(); }
  [[nodiscard]] std::size_t matched_writers() const noexcept override {
    return reader_.matched().current_count;
  }

 private:
  void await_matches(std::size_t side) const {
    const std::string attempt = "wait for writers of topic '" + reader_.name() + "'";
    check(dds_set_status_mask(reader_.reader(side), DDS_SUBSCRIPTION_MATCHED_STATUS), attempt);
    check(dds_waitset_attach(waitset_.get(), reader_.reader(side), 0), attempt);
  }

  /// @return whether samples or ends were handed over
  bool take(RecordHandler& handler) {
    SampleRun<stream::DenoisedSample, RecordHandler> run(handler);
    const auto receive = [&](std::size_t side, const Message& message, const dds_sample_info_t& info) {
      const std::string_view sensor(message.sensor);
      if (!fits_wire(sensor) || !(info.valid_data || states_.knows(sensor))) return;
      if (info.valid_data) run.add(sensor, samples_of(message));
      states_.show(sensor, side, info.instance_state == DDS_ALIVE_INSTANCE_STATE, info.publication_handle);
    };
    const bool taken = reader_.take(book_, receive) > 0;
    run.flush();
    for (const SensorStates::Ending& ending : states_.take_ending()) {
      reader_.take_sensor(book_, ending.sensor, receive);
      run.flush();
      if (states_.forget_if_ended(ending.sensor)) handler.on_end(ending.sensor);
    }
    return taken;
  }

  Domain domain_;
  WriterBook book_;
  SensorStates states_;
  Entity waitset_;
  InputReader<Message> reader_;
};

std::unique_ptr<Recorder::Source> Recorder::create(const Domain& domain, const BusOptions& options,
                                                   const std::string& topic,
                                                   std::chrono::milliseconds discovery_timeout) {
  auto found = configured_topic(options, topic);
  if (!found) found = find_topic(domain, topic, discovery_timeout);
  if (!found) {
    throw BusError("topic '" + topic + "': no writer within " + std::to_string(discovery_timeout.count()) +
                   " ms; expected one, or a topic of the configuration");
  }
  const auto qos = [&](Reliability reliability) {
    return recorder_qos(reliability, found->partitions, found->exclusive, options);
  };
  std::unique_ptr<Source> source;
  const auto try_type = [&]<class Message>(const Message*) {
    if (found->type_name == type_name_of<Message>())
      source = std::make_unique<TypedSource<Message>>(domain, topic, qos);
  };
  try_type(static_cast<const gyrod_GyroSample*>(nullptr));
  try_type(static_cast<const gyrod_GyroBatch*>(nullptr));
  try_type(static_cast<const gyrod_DenoisedSample*>(nullptr));
  try_type(static_cast<const gyrod_DenoisedBatch*>(nullptr));
  if (source == nullptr) {
    throw BusError(
        "topic '" + topic + "' has type '" + found->type_name +
        "'; expected gyrod::GyroSample, gyrod::GyroBatch, gyrod::DenoisedSample or gyrod::DenoisedBatch");
  }
  return source;
}

Recorder::Recorder(const Domain& domain, const BusOptions& options, const std::string& topic,
                   std::chrono::milliseconds discovery_timeout)
    : source_(create(domain, options, topic, discovery_timeout)) {}
Recorder::~Recorder() = default;
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;

Recorder::Poll Recorder::poll(std::chrono::milliseconds timeout, RecordHandler& handler) {
  return source_->poll(timeout, handler);
}
std::string_view Recorder::type_name() const noexcept { return source_->type_name(); }
std::size_t Recorder::matched_writers() const noexcept { return source_->matched_writers(); }

}  // namespace gyrod::bus
