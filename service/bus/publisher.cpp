#include "bus/publisher.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <optional>
#include <string>
#include <vector>

#include "bus/topic_writer.hpp"

namespace gyrod::bus {
namespace {

/// Fills a thread's own buffer with the samples in wire form. Kept by the thread, so that it allocates the
/// first time only.
std::span<gyrod_DenoisedElement> elements_of(std::span<const stream::DenoisedSample> samples) {
  static thread_local std::vector<gyrod_DenoisedElement> elements;
  elements.resize(std::max(elements.size(), samples.size()));
  for (std::size_t i = 0; i < samples.size(); ++i) to_wire(samples[i], elements[i]);
  return {elements.data(), samples.size()};
}

}  // namespace

class Publisher::Impl {
 public:
  Impl(const Domain& domain, const BusOptions& options)
      : domain_(domain),
        names_(options.topics),
        max_batch_samples_(options.max_batch_samples),
        denoised_(domain, options.topics.denoised, options.topics.denoised_batch, options),
        reports_(domain.participant(), options.topics.noise,
                 report_writer_qos(for_topic(options, options.topics.noise))),
        health_(domain.participant(), options.topics.health,
                report_writer_qos(for_topic(options, options.topics.health))) {
    if (options.realtime)
      realtime_.emplace(domain, options.topics.realtime, options.topics.realtime_batch, options);
  }

  void publish(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept {
    publish_to(denoised_, sensor, samples);
  }

  void publish_realtime(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept {
    assert(realtime_.has_value());
    publish_to(*realtime_, sensor, samples);
  }

  void publish_report(std::string_view sensor, const stream::NoiseReport& report) noexcept {
    gyrod_NoiseReport message;
    ImfReports imfs;
    set_sensor(message, sensor);
    to_wire(report, imfs, message);
    count(reports_.write(message));
    reports_.flush();
  }

  void publish_health(std::string_view sensor, const stream::SensorHealth& before,
                      const stream::SensorHealth& now, std::int64_t stamp_ns) noexcept {
    gyrod_HealthReport message;
    set_sensor(message, sensor);
    to_wire(before, now, stamp_ns, message);
    count(health_.write(message));
    health_.flush();
  }

  void unregister_health(std::string_view sensor) noexcept { count(health_.end(sensor)); }

  void unregister_sensor(std::string_view sensor) noexcept {
    end(denoised_, sensor);
    if (realtime_) end(*realtime_, sensor);
    count(reports_.end(sensor));
  }

  [[nodiscard]] bool wait_for_acknowledgements(std::chrono::milliseconds timeout) const noexcept {
    const dds_time_t deadline = dds_time() + DDS_MSECS(timeout.count());
    const auto confirmed = [deadline](const auto& writer) {
      return dds_wait_for_acks(writer.get(), std::max<dds_duration_t>(0, deadline - dds_time())) ==
             DDS_RETCODE_OK;
    };
    const auto both_confirmed = [&confirmed](const Topics& topics) {
      return confirmed(topics.singles) && confirmed(topics.batches);
    };
    return both_confirmed(denoised_) && (!realtime_ || both_confirmed(*realtime_)) && confirmed(reports_) &&
           confirmed(health_);
  }

  void assert_liveliness() const noexcept {
    const auto assert_both = [](const Topics& topics) {
      (void)dds_assert_liveliness(topics.singles.get());
      (void)dds_assert_liveliness(topics.batches.get());
    };
    assert_both(denoised_);
    if (realtime_) assert_both(*realtime_);
    (void)dds_assert_liveliness(reports_.get());
  }

  [[nodiscard]] std::uint64_t write_errors() const noexcept {
    return write_errors_.load(std::memory_order_relaxed);
  }

  [[nodiscard]] std::vector<TopicReaders> matched_readers() const {
    std::vector<TopicReaders> all;
    const auto add = [&all](const std::string& topic, const auto& writer) {
      all.push_back({topic, writer.matched_readers()});
    };
    add(names_.denoised, denoised_.singles);
    add(names_.denoised_batch, denoised_.batches);
    if (realtime_) {
      add(names_.realtime, realtime_->singles);
      add(names_.realtime_batch, realtime_->batches);
    }
    add(names_.noise, reports_);
    add(names_.health, health_);
    return all;
  }

  [[nodiscard]] dds_entity_t denoised_writer() const noexcept { return denoised_.singles.get(); }

 private:
  /// The same samples one by one and in batches.
  struct Topics {
    Topics(const Domain& domain, const std::string& single, const std::string& batch,
           const BusOptions& options)
        : singles(domain.participant(), single, output_writer_qos(for_topic(options, single))),
          batches(domain.participant(), batch, output_writer_qos(for_topic(options, batch))) {}

    TopicWriter<gyrod_DenoisedSample> singles;
    TopicWriter<gyrod_DenoisedBatch> batches;
  };

  void publish_to(Topics& topics, std::string_view sensor,
                  std::span<const stream::DenoisedSample> samples) noexcept {
    if (topics.singles.has_readers()) publish_singles(topics.singles, sensor, samples);
    if (topics.batches.has_readers()) publish_batches(topics.batches, sensor, samples);
  }

  void publish_singles(TopicWriter<gyrod_DenoisedSample>& writer, std::string_view sensor,
                       std::span<const stream::DenoisedSample> samples) noexcept {
    gyrod_DenoisedSample message;
    set_sensor(message, sensor);
    for (const stream::DenoisedSample& sample : samples) {
      to_wire(sample, message);
      count(writer.write(message));
    }
    writer.flush();
  }

  void publish_batches(TopicWriter<gyrod_DenoisedBatch>& writer, std::string_view sensor,
                       std::span<const stream::DenoisedSample> samples) noexcept {
    gyrod_DenoisedBatch message;
    set_sensor(message, sensor);
    while (!samples.empty()) {
      const auto part = samples.first(std::min(samples.size(), max_batch_samples_));
      const auto elements = elements_of(part);
      const auto size = static_cast<std::uint32_t>(elements.size());
      message.samples = {size, size, elements.data(), false};
      count(writer.write(message));
      samples = samples.subspan(part.size());
    }
    writer.flush();
  }

  void end(Topics& topics, std::string_view sensor) noexcept {
    count(topics.singles.end(sensor));
    count(topics.batches.end(sensor));
  }

  void count(dds_return_t written) noexcept {
    if (written < 0) write_errors_.fetch_add(1, std::memory_order_relaxed);
  }

  Domain domain_;
  TopicNames names_;
  std::size_t max_batch_samples_;
  Topics denoised_;
  std::optional<Topics> realtime_;
  TopicWriter<gyrod_NoiseReport> reports_;
  TopicWriter<gyrod_HealthReport> health_;
  std::atomic<std::uint64_t> write_errors_{0};
};

Publisher::Publisher(const Domain& domain, const BusOptions& options)
    : impl_(std::make_unique<Impl>(domain, options)) {}
Publisher::~Publisher() = default;
Publisher::Publisher(Publisher&&) noexcept = default;
Publisher& Publisher::operator=(Publisher&&) noexcept = default;

void Publisher::publish(std::string_view sensor, std::span<const stream::DenoisedSample> samples) noexcept {
  impl_->publish(sensor, samples);
}

void Publisher::publish_realtime(std::string_view sensor,
                                 std::span<const stream::DenoisedSample> samples) noexcept {
  impl_->publish_realtime(sensor, samples);
}

void Publisher::publish_report(std::string_view sensor, const stream::NoiseReport& report) noexcept {
  impl_->publish_report(sensor, report);
}

void Publisher::publish_health(std::string_view sensor, const stream::SensorHealth& before,
                               const stream::SensorHealth& now, std::int64_t stamp_ns) noexcept {
  impl_->publish_health(sensor, before, now, stamp_ns);
}

void Publisher::unregister_health(std::string_view sensor) noexcept { impl_->unregister_health(sensor); }

void Publisher::unregister_sensor(std::string_view sensor) noexcept { impl_->unregister_sensor(sensor); }

bool Publisher::wait_for_acknowledgements(std::chrono::milliseconds timeout) noexcept {
  return impl_->wait_for_acknowledgements(timeout);
}

void Publisher::assert_liveliness() const noexcept { impl_->assert_liveliness(); }

std::uint64_t Publisher::write_errors() const noexcept { return impl_->write_errors(); }
std::vector<TopicReaders> Publisher::matched_readers() const { return impl_->matched_readers(); }
std::int32_t Publisher::denoised_writer() const noexcept { return impl_->denoised_writer(); }

}  // namespace gyrod::bus
