#include "bus/raw_writer.hpp"

#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "bus/topic_writer.hpp"

namespace gyrod::bus {
namespace {

using Singles = TopicWriter<gyrod_GyroSample>;
using Batches = TopicWriter<gyrod_GyroBatch>;
using Writer = std::variant<Singles, Batches>;

/// Two names with wildcards never meet.
void check_partitions(const std::vector<std::string>& names) {
  const auto is_pattern = [](const std::string& name) {
    return name.find_first_of("*?") != std::string::npos;
  };
  const auto found = std::ranges::find_if(names, is_pattern);
  if (found == names.end()) return;
  throw BusError("partition '" + *found + "': expected a name without '*' and '?' to write to");
}

Writer create(const Domain& domain, const BusOptions& all, std::size_t batch_samples, std::size_t past) {
  if (batch_samples < 1 || batch_samples > all.max_batch_samples) {
    throw BusError("batch of " + std::to_string(batch_samples) + " samples: expected 1.." +
                   std::to_string(all.max_batch_samples));
  }
  const BusOptions options = for_topic(all, batch_samples == 1 ? all.topics.raw : all.topics.raw_batch);
  check_partitions(options.input.partitions);
  const Qos qos = input_writer_qos(options, past);
  if (batch_samples == 1) return Singles(domain.participant(), options.topics.raw, qos);
  return Batches(domain.participant(), options.topics.raw_batch, qos);
}

void check_sensor(std::string_view sensor) {
  if (fits_wire(sensor)) return;
  throw BusError("sensor id '" + std::string(sensor) + "': expected 1.." +
                 std::to_string(kMaxSensorIdLength) + " characters");
}

}  // namespace

class RawWriter::Impl {
 public:
  Impl(const Domain& domain, const BusOptions& options, std::size_t batch_samples, std::size_t past)
      : domain_(domain),
        topic_(batch_samples == 1 ? options.topics.raw : options.topics.raw_batch),
        elements_(batch_samples),
        writer_(create(domain, options, batch_samples, past)),
        waitset_(dds_create_waitset(domain.participant()), "create a waitset") {
    check(dds_set_status_mask(handle(), DDS_PUBLICATION_MATCHED_STATUS),
          "watch the readers of topic '" + topic_ + "'");
    check(dds_waitset_attach(waitset_.get(), handle(), 0), "watch the readers of topic '" + topic_ + "'");
  }

  std::size_t publish(std::string_view sensor, std::span<const stream::Sample> samples) {
    check_sensor(sensor);
    const std::size_t written =
        std::visit([&](const auto& writer) { return publish_to(writer, sensor, samples); }, writer_);
    std::visit([](const auto& writer) { writer.flush(); }, writer_);
    return written;
  }

  bool end(std::string_view sensor) {
    check_sensor(sensor);
    return taken(std::visit([&](const auto& writer) { return writer.end(sensor); }, writer_));
  }

  bool wait_for_subscriber(std::chrono::milliseconds timeout) {
    const dds_time_t deadline = dds_time() + DDS_MSECS(timeout.count());
    while (!has_readers()) {
      if (dds_waitset_wait_until(waitset_.get(), nullptr, 0, deadline) <= 0) return has_readers();
    }
    return true;
  }

  bool wait_for_acknowledgements(std::chrono::milliseconds timeout) {
    return taken(dds_wait_for_acks(handle(), DDS_MSECS(timeout.count())));
  }

 private:
  std::size_t publish_to(const Singles& writer, std::string_view sensor,
                         std::span<const stream::Sample> samples) {
    gyrod_GyroSample message;
    set_sensor(message, sensor);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      to_wire(samples[i], message);
      if (!taken(writer.write(message))) return i;
    }
    return samples.size();
  }

  std::size_t publish_to(const Batches& writer, std::string_view sensor,
                         std::span<const stream::Sample> samples) {
    gyrod_GyroBatch message;
    set_sensor(message, sensor);
    for (std::size_t begin = 0; begin < samples.size();) {
      const auto part = samples.subspan(begin, std::min(elements_.size(), samples.size() - begin));
      for (std::size_t i = 0; i < part.size(); ++i) to_wire(part[i], elements_[i]);
      const auto size = static_cast<std::uint32_t>(part.size());
      message.samples = {size, size, elements_.data(), false};
      if (!taken(writer.write(message))) return begin;
      begin += part.size();
    }
    return samples.size();
  }

  /// @return false if the readers held back for too long. @throws BusError for anything else
  [[nodiscard]] bool taken(dds_return_t result) const {
    if (result == DDS_RETCODE_TIMEOUT) return false;
    check(result, "write to topic '" + topic_ + "'");
    return true;
  }

  [[nodiscard]] bool has_readers() const {
    return std::visit([](const auto& writer) { return writer.has_readers(); }, writer_);
  }

  [[nodiscard]] dds_entity_t handle() const {
    return std::visit([](const auto& writer) { return writer.get(); }, writer_);
  }

  Domain domain_;
  std::string topic_;
  std::vector<gyrod_GyroElement> elements_;  ///< one batch in wire form
  Writer writer_;
  Entity waitset_;
};

RawWriter::RawWriter(const Domain& domain, const BusOptions& options, std::size_t batch_samples,
                     std::size_t past)
    : impl_(std::make_unique<Impl>(domain, options, batch_samples, past)) {}
RawWriter::~RawWriter() = default;
RawWriter::RawWriter(RawWriter&&) noexcept = default;
RawWriter& RawWriter::operator=(RawWriter&&) noexcept = default;

std::size_t RawWriter::publish(std::string_view sensor, std::span<const stream::Sample> samples) {
  return impl_->publish(sensor, samples);
}
bool RawWriter::end(std::string_view sensor) { return impl_->end(sensor); }
bool RawWriter::wait_for_subscriber(std::chrono::milliseconds timeout) {
  return impl_->wait_for_subscriber(timeout);
}
bool RawWriter::wait_for_acknowledgements(std::chrono::milliseconds timeout) {
  return impl_->wait_for_acknowledgements(timeout);
}

}  // namespace gyrod::bus
