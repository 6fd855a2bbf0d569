#include "bus/imu_output.hpp"

#include <algorithm>

#include "bus/held_messages.hpp"

namespace gyrod::bus {

ImuOutput::ImuOutput(const Domain& domain, const std::string& topic, const BusOptions& options)
    : writer_(domain.participant(), topic, imu_writer_qos(for_topic(options, topic))) {
  if (options.ownership_strength == 0) return;
  shared_.emplace(
      Shared{.reader = {domain.participant(), topic, imu_standby_reader_qos(for_topic(options, topic))},
             .others = {options.ownership_strength, options.takeover_s, steady_now_s()},
             .held = HeldSamples<ReadyImu>(
                 {.takeover_s = options.takeover_s, .most = options.ros2.depth, .exclusive = false}),
             .newest = {}});
}

void ImuOutput::publish(const Imu& message, const stream::DenoisedSample& sample) {
  if (!shared_ && !writer_.has_readers()) return;
  Imu changed = message;
  set_rates(changed, sample);
  if (!shared_) return write(changed);

  const double now_s = steady_now_s();
  heed_a_pause(now_s);
  ReadyImu& ready = shared_->newest;
  ready.stamp_ns = stamp_ns_of(changed);
  ready.frame_id = HeldMessages::frame_id_of(changed);
  ready.message = changed;
  shared_->held.release({&ready, 1}, now_s);
  settle(now_s);
}

void ImuOutput::tend() {
  if (!shared_) return;
  const double now_s = steady_now_s();
  heed_a_pause(now_s);
  shared_->others.look(shared_->reader.get(), now_s);
  listen(now_s);
  settle(now_s);
  flush();
}

void ImuOutput::heed_a_pause(double now_s) {
  if (shared_->others.was_stopped(now_s)) shared_->held.doubt();
}

void ImuOutput::listen(double now_s) {
  const auto hear = [this, now_s](const Imu& message, const dds_sample_info_t& info) {
    if (!info.valid_data) {
      shared_->held.hear_end(now_s);
    } else if (shared_->others.knows(info.publication_handle)) {
      shared_->held.hear({0, stamp_ns_of(message)}, shared_->others.is_stronger(info.publication_handle));
    }
  };
  while (shared_->reader.take(hear) > 0) {
  }
}

void ImuOutput::settle(double now_s) {
  shared_->held.take(now_s, shared_->others.now(now_s), [this](const ReadyImu& ready) {
    Imu message = ready.message;
    // Only read by the write; a C struct has no const pointers.
    message.header.frame_id = const_cast<char*>(ready.frame_id.c_str());
    write(message);
  });
}

void ImuOutput::write(const Imu& message) noexcept {
  if (writer_.write(message) < 0) ++write_errors_;
}

bool ImuOutput::wait_for_acknowledgements(dds_time_t deadline) const noexcept {
  return dds_wait_for_acks(writer_.get(), std::max<dds_duration_t>(0, deadline - dds_time())) ==
         DDS_RETCODE_OK;
}

}  // namespace gyrod::bus
