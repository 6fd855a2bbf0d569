#include "bus/qos.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>

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

dds_duration_t duration(double seconds) noexcept {
  return static_cast<dds_duration_t>(std::llround(seconds * 1e9));
}

/// "0.25 s".
std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%g s", seconds);
  return text;
}

/// What ROS 2 (from its release Iron on) wants to hear of an Imu: the hash of the message's definition, REP-2011. Without it nodes
/// connect, too, but those on Cyclone DDS log a warning.
constexpr std::string_view kImuTypeHash =
    "typehash=RIHS01_7d9a00ff131080897a5ec7e26e315954b8eae3353c3f995c55faf71574000b5b;";

Qos plain_output_writer_qos(const BusOptions& options) {
  Qos qos;
  set_reliability(qos, options.output_reliability, kOutputMaxBlocking);
  qos.keep_last(options.output_depth).no_autodispose();
  return qos;
}

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

Qos& Qos::keep_for_late_joiners(std::size_t depth) {
  dds_qset_durability_service(qos_.get(), 0, DDS_HISTORY_KEEP_LAST, static_cast<std::int32_t>(depth),
                              DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  return with_the_past();
}

Qos& Qos::with_the_past() {
  dds_qset_durability(qos_.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  return say("transient local");
}

Qos& Qos::no_autodispose() {
  dds_qset_writer_data_lifecycle(qos_.get(), false);
  return *this;
}

Qos& Qos::deadline(double seconds) {
  if (!(seconds > 0.0)) return *this;
  dds_qset_deadline(qos_.get(), duration(seconds));
  return say("deadline " + seconds_text(seconds));
}

Qos& Qos::liveliness(Liveliness kind, double lease_s) {
  if (!(lease_s > 0.0)) return *this;
  const bool manual = kind == Liveliness::kManualByTopic;
  dds_qset_liveliness(qos_.get(), manual ? DDS_LIVELINESS_MANUAL_BY_TOPIC : DDS_LIVELINESS_AUTOMATIC,
                      duration(lease_s));
  return say((manual ? "liveliness by topic within " : "liveliness within ") + seconds_text(lease_s));
}

Qos& Qos::partitions(const std::vector<std::string>& names) {
  if (names.empty()) return *this;
  std::vector<const char*> pointers;
  for (const std::string& name : names) {
    pointers.push_back(name.c_str());
    say("partition '" + name + "'");
  }
  dds_qset_partition(qos_.get(), static_cast<std::uint32_t>(pointers.size()), pointers.data());
  return *this;
}

Qos& Qos::promise(const QosProfile& profile) {
  return deadline(profile.deadline_s)
      .liveliness(profile.liveliness, profile.lease_s)
      .partitions(profile.partitions);
}

Qos& Qos::exclusive() {
  dds_qset_ownership(qos_.get(), DDS_OWNERSHIP_EXCLUSIVE);
  return say("exclusive");
}

Qos& Qos::strength(std::uint32_t strength) {
  dds_qset_ownership_strength(qos_.get(), static_cast<std::int32_t>(strength));
  return say("strength " + std::to_string(strength));
}

Qos& Qos::lease(double seconds) {
  dds_qset_liveliness(qos_.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, static_cast<dds_duration_t>(seconds * 1e9));
  return *this;
}

Qos& Qos::ignore_own_process() {
  dds_qset_ignorelocal(qos_.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return *this;
}

Qos& Qos::user_data(std::string_view text) {
  dds_qset_userdata(qos_.get(), text.data(), text.size());
  return *this;
}

Qos input_reader_qos(const BusOptions& options, Reliability reliability) {
  Qos qos;
  set_reliability(qos, reliability, 0);
  if (options.input_history == History::kKeepAll) {
    qos.keep_all().limits(options.input_max_messages, options.max_instances);
  } else {
    qos.keep_last(options.input_depth).limits(0, options.max_instances);
  }
  qos.promise(options.input);
  if (options.input_past) qos.with_the_past();
  return qos;
}

Qos input_writer_qos(const BusOptions& options, std::size_t past) {
  Qos qos;
  qos.reliable(kInputMaxBlocking).keep_all().no_autodispose().promise(options.input);
  if (past > 0) qos.keep_for_late_joiners(past);
  return qos;
}

Qos output_writer_qos(const BusOptions& options) {
  Qos qos = plain_output_writer_qos(options);
  qos.promise(options.output);
  if (options.ownership_strength == 0) return qos;
  // The lease of a standby's writer, whatever is promised to readers, so that these know an owner's death in time.
  qos.exclusive().strength(options.ownership_strength).lease(0.5 * options.takeover_s);
  return qos;
}

Qos report_writer_qos(const BusOptions& options) {
  Qos qos = plain_output_writer_qos(options);
  qos.keep_for_late_joiners(1).promise(options.output);
  if (options.ownership_strength > 0)
    qos.exclusive().strength(options.ownership_strength).lease(0.5 * options.takeover_s);
  return qos;
}

Qos standby_reader_qos(const BusOptions& options) {
  Qos qos;
  set_reliability(qos, options.output_reliability, 0);
  qos.keep_last(1).limits(0, options.max_instances).exclusive().ignore_own_process();
  qos.partitions(options.output.partitions);
  return qos;
}

Qos hand_over_qos(const BusOptions& options) {
  constexpr std::size_t kNewest = 16;  // of each daemon
  Qos qos;
  qos.reliable(kOutputMaxBlocking).keep_last(kNewest).keep_for_late_joiners(kNewest).no_autodispose();
  qos.partitions(options.output.partitions);
  return qos;
}

Qos recorder_qos(Reliability reliability, const std::vector<std::string>& partitions, bool exclusive,
                 const BusOptions& options) {
  Qos qos;
  set_reliability(qos, reliability, 0);
  qos.keep_all().limits(0, options.max_instances).partitions(partitions);
  if (exclusive) qos.exclusive();
  return qos;
}

Qos imu_reader_qos(const Ros2Options& options, Reliability reliability) {
  Qos qos;
  set_reliability(qos, reliability, 0);
  qos.keep_last(options.depth).user_data(kImuTypeHash).promise(options.input);
  return qos;
}

Qos imu_writer_qos(const BusOptions& options) {
  const Ros2Options& ros2 = options.ros2;
  Qos qos;
  set_reliability(qos, ros2.output_reliability, kOutputMaxBlocking);
  qos.keep_last(ros2.depth).no_autodispose().user_data(kImuTypeHash).promise(ros2.output);
  // Ownership stays shared, as ROS 2 has it: the strength is for the other daemons.
  if (options.ownership_strength > 0) qos.strength(options.ownership_strength);
  return qos;
}

Qos imu_standby_reader_qos(const BusOptions& options) {
  constexpr std::size_t kWriters = 16;  // the newest of each, however they mix
  Qos qos;
  set_reliability(qos, options.ros2.output_reliability, 0);
  qos.keep_last(kWriters).user_data(kImuTypeHash).ignore_own_process();
  qos.partitions(options.ros2.output.partitions);
  return qos;
}

}  // namespace gyrod::bus
