#include "bus/qos.hpp"

#include <cstdint>

namespace gyrod::bus {
namespace {

/// How long one write of `replay` waits for a slow reader before it reports back.
constexpr dds_duration_t kInputMaxBlocking = DDS_SECS(1);
/// Readers of the output on the network never make a write wait (keep last); one in the same process might,
/// this long.
constexpr dds_duration_t kOutputMaxBlocking = DDS_MSECS(100);

void set_reliability(Qos& qos, Reliability reliability, dds_duration_t max_blocking) {
  if (reliability == Reliability::kReliable) {
    qos.reliable(max_blocking);
  } else {
    qos.best_effort();
  }
}

/// What ROS 2 (from its release Iron on) wants to hear of an Imu: the hash of the message's definition, REP-2011. Without it nodes
/// connect, too, but those on Cyclone DDS log a warning.
constexpr std::string_view kImuTypeHash =
    "typehash=RIHS01_7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b;";

}  // namespace

Qos::Qos() : qos_(dds_create_qos()) {
  // Every entity of one topic in a process then offers the same set, whatever later releases make the
  // default.
  dds_qset_destination_order(qos_.get(), DDS_DESTINATIONORDER_BY_RECEPTION_TIMESTAMP);
}

Qos& Qos::say(const std::string& words) {
  text_ += (text_.empty() ? "" : ", ") + words;
  return *this;
}

Qos& Qos::reliable(dds_duration_t max_blocking) {
  dds_qset_reliability(qos_.get(), DDS_RELIABILITY_RELIABLE, max_blocking);
  return say("reliable");
}

Qos& Qos::best_effort() {
  dds_qset_reliability(qos_.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  return say("best effort");
}

Qos& Qos::keep_all() {
  dds_qset_history(qos_.get(), DDS_HISTORY_KEEP_ALL, DDS_LENGTH_UNLIMITED);
  return say("keep all");
}

Qos& Qos::keep_last(std::size_t depth) {
  dds_qset_history(qos_.get(), DDS_HISTORY_KEEP_LAST, static_cast<std::int32_t>(depth));
  return say("keep last " + std::to_string(depth));
}

Qos& Qos::limits(std::size_t max_messages, std::size_t max_instances) {
  const std::int32_t messages =
      max_messages == 0 ? DDS_LENGTH_UNLIMITED : static_cast<std::int32_t>(max_messages);
  dds_qset_resource_limits(qos_.get(), messages, static_cast<std::int32_t>(max_instances),
                           DDS_LENGTH_UNLIMITED);
  if (max_messages != 0) say("at most " + std::to_string(max_messages) + " messages");
  return say("at most " + std::to_string(max_instances) + " sensors");
}

Qos& Qos::latest_for_late_joiners() {
  dds_qset_durability(qos_.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  dds_qset_durability_service(qos_.get(), 0, DDS_HISTORY_KEEP_LAST, 1, DDS_LENGTH_UNLIMITED,
                              DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  return say("transient local");
}

Qos& Qos::no_autodispose() {
  dds_qset_writer_data_lifecycle(qos_.get(), false);
  return *this;
}

Qos& Qos::user_data(std::string_view text) {
  dds_qset_userdata(qos_.get(), text.data(), text.size());
  return *this;
}

Qos input_reader_qos(const BusOptions& options) {
  Qos qos;
  set_reliability(qos, options.input_reliability, 0);
  if (options.input_history == History::kKeepAll) {
    qos.keep_all().limits(options.input_max_messages, options.max_instances);
  } else {
    qos.keep_last(options.input_depth).limits(0, options.max_instances);
  }
  return qos;
}

Qos input_writer_qos() {
  Qos qos;
  qos.reliable(kInputMaxBlocking).keep_all().no_autodispose();
  return qos;
}

Qos output_writer_qos(const BusOptions& options) {
  Qos qos;
  set_reliability(qos, options.output_reliability, kOutputMaxBlocking);
  qos.keep_last(options.output_depth).no_autodispose();
  return qos;
}

Qos report_writer_qos(const BusOptions& options) {
  Qos qos = output_writer_qos(options);
  qos.latest_for_late_joiners();
  return qos;
}

Qos recorder_qos(Reliability reliability, const BusOptions& options) {
  Qos qos;
  set_reliability(qos, reliability, 0);
  qos.keep_all().limits(0, options.max_instances);
  return qos;
}

Qos imu_reader_qos(const Ros2Options& options) {
  Qos qos;
  qos.best_effort().keep_last(options.depth).user_data(kImuTypeHash);
  return qos;
}

Qos imu_writer_qos(const Ros2Options& options) {
  Qos qos;
  set_reliability(qos, options.output_reliability, kOutputMaxBlocking);
  qos.keep_last(options.depth).no_autodispose().user_data(kImuTypeHash);
  return qos;
}

}  // namespace gyrod::bus
