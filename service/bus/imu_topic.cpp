#include "bus/imu_topic.hpp"

#include <algorithm>
#include <utility>

namespace gyrod::bus {

ImuTopic::ImuTopic(const Domain& domain, std::string name, const BusOptions& options)
    : name_(std::move(name)),
      outputs_(ros2::outputs_of(name_, options.ros2.outputs)),
      reader_(domain.participant(), name_, for_topic(options, name_).ros2.input_reliability,
              [ros2 = for_topic(options, name_).ros2](Reliability reliability) {
                return imu_reader_qos(ros2, reliability);
              }),
      denoised_(domain.participant(), outputs_.denoised,
                imu_writer_qos(for_topic(options, outputs_.denoised).ros2)),
      held_(options.ros2.max_held_messages) {
  if (options.realtime)
    realtime_.emplace(domain.participant(), outputs_.realtime,
                      imu_writer_qos(for_topic(options, outputs_.realtime).ros2));
}

void ImuTopic::add_matched_readers(std::vector<TopicReaders>& all) const {
  all.push_back({outputs_.denoised, denoised_.matched_readers()});
  if (realtime_) all.push_back({outputs_.realtime, realtime_->matched_readers()});
}

bool ImuTopic::hold(const Imu& message) noexcept {
  const std::lock_guard lock(mutex_);
  if (HeldMessages::frame_id_of(message).size() > HeldMessages::kMaxFrameIdLength) {
    ++counts_.malformed;
    return false;
  }
  if (held_.full()) {
    ++counts_.dropped;
    return false;
  }
  held_.push(message);
  return true;
}

void ImuTopic::give_up_newest() noexcept {
  const std::lock_guard lock(mutex_);
  held_.drop_newest();
}

void ImuTopic::publish(std::span<const stream::DenoisedSample> samples) noexcept {
  const std::lock_guard lock(mutex_);
  for (const stream::DenoisedSample& sample : samples) {
    while (held_.size() > 0 && stamp_ns_of(held_.oldest()) != sample.stamp_ns) {
      held_.drop_oldest();
      ++counts_.dropped;
    }
    if (held_.size() == 0) continue;
    write(denoised_, held_.oldest(), sample);
    held_.drop_oldest();
  }
  denoised_.flush();
}

void ImuTopic::publish_realtime(std::span<const stream::DenoisedSample> samples) noexcept {
  const std::lock_guard lock(mutex_);
  for (const stream::DenoisedSample& sample : samples) {
    if (held_.size() == 0 || stamp_ns_of(held_.newest()) != sample.stamp_ns) {
      ++counts_.dropped;
    } else {
      write(*realtime_, held_.newest(), sample);
    }
  }
  realtime_->flush();
}

void ImuTopic::write(const TopicWriter<Imu>& writer, const Imu& message,
                     const stream::DenoisedSample& sample) {
  if (!writer.has_readers()) return;
  Imu changed = message;
  set_rates(changed, sample);
  if (writer.write(changed) < 0) ++counts_.write_errors;
}

bool ImuTopic::wait_for_acknowledgements(dds_time_t deadline) const noexcept {
  const auto confirmed = [deadline](const TopicWriter<Imu>& writer) {
    return dds_wait_for_acks(writer.get(), std::max<dds_duration_t>(0, deadline - dds_time())) ==
           DDS_RETCODE_OK;
  };
  return confirmed(denoised_) && (!realtime_ || confirmed(*realtime_));
}

ImuCounts ImuTopic::counts() const noexcept {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace gyrod::bus
