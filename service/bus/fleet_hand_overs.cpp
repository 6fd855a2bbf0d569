#include "bus/fleet_hand_overs.hpp"

#include <algorithm>
#include <cstdio>

#include "bus/log.hpp"
#include "bus/wire.hpp"

namespace gyrod::bus {
namespace {

std::string topic_of(const BusOptions& options) { return options.topics.denoised + "_hand_over"; }

}  // namespace

FleetHandOvers::FleetHandOvers(const Domain& domain, const BusOptions& options, const std::string& id,
                               dds_duration_t patience)
    : id_(id.substr(0, sizeof(gyrod_HandOver::daemon) - 1)),
      writer_(domain.participant(), topic_of(options), hand_over_qos(options)),
      reader_(domain.participant(), topic_of(options), hand_over_qos(options)),
      patience_(patience) {}

bool FleetHandOvers::tell(std::span<const GivenUp> given, bool leaves) noexcept {
  std::vector<gyrod_HandedSensor> sensors;
  sensors.reserve(given.size());
  for (const GivenUp& one : given) {
    if (!fits_wire(one.sensor)) continue;
    gyrod_HandedSensor& handed = sensors.emplace_back();
    set_sensor(handed, one.sensor);
    handed.last_sequence_number = one.taken.sequence;
    handed.last_stamp_ns = one.taken.stamp_ns;
  }
  gyrod_HandOver message{};
  *std::ranges::copy(id_, message.daemon).out = '\0';
  message.number = told_ + 1;
  message.leaves = leaves;
  message.sensors._buffer = sensors.data();
  message.sensors._length = message.sensors._maximum = static_cast<std::uint32_t>(sensors.size());
  const dds_return_t written = writer_.write(message);
  if (written != DDS_RETCODE_OK) {
    log(LogLevel::kWarning,
        std::string("cannot tell other daemons how far sensors were served: ") + dds_strretcode(written));
    return false;
  }
  writer_.flush();
  ++told_;
  return true;
}

bool FleetHandOvers::must_wait(dds_time_t now) {
  if (!book_.owes()) {
    waits_until_ = DDS_NEVER;
    return false;
  }
  if (waits_until_ == DDS_NEVER) waits_until_ = now + patience_;
  if (now < waits_until_) return true;
  waits_until_ = DDS_NEVER;
  book_.write_off();
  all_have_told_ = false;
  char patience[32];
  std::snprintf(patience, sizeof patience, "%g s", static_cast<double>(patience_) / DDS_NSECS_IN_SEC);
  log(LogLevel::kWarning, std::string("a daemon that gave up sensors has not told within ") + patience +
                              " how far it was: samples around that moment may be missing");
  return false;
}

void FleetHandOvers::wait_for_acknowledgements(std::chrono::milliseconds timeout) const noexcept {
  (void)dds_wait_for_acks(writer_.get(), DDS_MSECS(timeout.count()));
}

std::span<const GivenUp> FleetHandOvers::given_in(const gyrod_HandOver& message) {
  given_.clear();
  for (const gyrod_HandedSensor& handed :
       std::span(message.sensors._buffer, static_cast<std::size_t>(message.sensors._length)))
    given_.push_back({handed.sensor, {handed.last_sequence_number, handed.last_stamp_ns}});
  return given_;
}

}  // namespace gyrod::bus
