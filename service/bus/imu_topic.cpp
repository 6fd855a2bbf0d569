#include "bus/imu_topic.hpp"

#include <utility>

namespace gyrod::bus {

ImuTopic::ImuTopic(const Domain& domain, std::string name, const BusOptions& options)
    : name_(std::move(name)),
      outputs_(ros2::outputs_of(name_, options.ros2.outputs)),
      reader_(domain.participant(), name_, for_topic(options, name_).ros2.input_reliability,
              [ros2 = for_topic(options, name_).ros2](Reliability reliability) {
                return imu_reader_qos(ros2, reliability);
              }),
      denoised_(domain, outputs_.denoised, options),
      held_(options.ros2.max_held_messages) {
  if (options.realtime) realtime_.emplace(domain, outputs_.realtime, options);
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
  if (held_.full() && held_.oldest_may_stay()) held_.drop_oldest();
  if (held_.full()) {
    ++counts_.dropped;
    return false;
  }
  held_.push(message);
  return true;
}

void ImuTopic::give_up(std::int64_t stamp_ns) noexcept {
  const std::lock_guard lock(mutex_);
  if (held_.size() > 0 && stamp_ns_of(held_.newest()) == stamp_ns) held_.drop_newest();
}

void ImuTopic::let_stay(std::int64_t stamp_ns) noexcept {
  const std::lock_guard lock(mutex_);
  held_.let_stay(stamp_ns);
}

void ImuTopic::publish(std::span<const stream::DenoisedSample> samples) noexcept {
  const std::lock_guard lock(mutex_);
  for (const stream::DenoisedSample& sample : samples) {
    const bool next = held_.size() > 0 && stamp_ns_of(held_.oldest()) == sample.stamp_ns;
    if (!next && held_.find(sample.stamp_ns) == nullptr) {
      ++counts_.dropped;
      continue;
    }
    while (stamp_ns_of(held_.oldest()) != sample.stamp_ns) {
      if (!held_.oldest_may_stay()) ++counts_.dropped;
      held_.drop_oldest();
    }
    denoised_.publish(held_.oldest(), sample);
    held_.drop_oldest();
  }
  denoised_.flush();
}

void ImuTopic::publish_realtime(std::span<const stream::DenoisedSample> samples) noexcept {
  const std::lock_guard lock(mutex_);
  for (const stream::DenoisedSample& sample : samples) {
    if (const Imu* message = held_.find(sample.stamp_ns)) {
      realtime_->publish(*message, sample);
    } else {
      ++counts_.dropped;
    }
  }
  realtime_->flush();
}

void ImuTopic::tend() noexcept {
  const std::lock_guard lock(mutex_);
  denoised_.tend();
  if (realtime_) realtime_->tend();
}

bool ImuTopic::publishes() const noexcept {
  const std::lock_guard lock(mutex_);
  return denoised_.active();
}

void ImuTopic::add_to(StandbySnapshot& standby) const noexcept {
  const std::lock_guard lock(mutex_);
  standby.sensors += denoised_.active() ? 1U : 0U;
  standby.held += denoised_.held() + (realtime_ ? realtime_->held() : 0);
  standby.let_go += denoised_.let_go();
  standby.takeovers += denoised_.takeovers();
}

bool ImuTopic::wait_for_acknowledgements(dds_time_t deadline) const noexcept {
  return denoised_.wait_for_acknowledgements(deadline) &&
         (!realtime_ || realtime_->wait_for_acknowledgements(deadline));
}

ImuCounts ImuTopic::counts() const noexcept {
  const std::lock_guard lock(mutex_);
  ImuCounts counts = counts_;
  counts.write_errors = denoised_.write_errors() + (realtime_ ? realtime_->write_errors() : 0);
  return counts;
}

}  // namespace gyrod::bus
