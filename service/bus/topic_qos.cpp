#include "bus/bus_options.hpp"

namespace gyrod::bus {
namespace {

void apply(const TopicQos& qos, QosProfile& profile) {
  profile.deadline_s = qos.deadline_s.value_or(profile.deadline_s);
  profile.liveliness = qos.liveliness.value_or(profile.liveliness);
  profile.lease_s = qos.lease_s.value_or(profile.lease_s);
  if (qos.partitions) profile.partitions = *qos.partitions;
}

void apply_depth(std::size_t depth, BusOptions& options) {
  options.input_history = depth == 0 ? History::kKeepAll : History::kKeepLast;
  if (depth == 0) return;  // the other groups always keep a number
  options.input_depth = depth;
  options.output_depth = depth;
  options.ros2.depth = depth;
}

void apply_reliability(InputReliability reliability, BusOptions& options) {
  options.input_reliability = reliability;
  options.ros2.input_reliability = reliability;
  if (reliability == InputReliability::kAuto) return;  // only readers can adapt
  const bool reliable = reliability == InputReliability::kReliable;
  options.output_reliability = reliable ? Reliability::kReliable : Reliability::kBestEffort;
  options.ros2.output_reliability = options.output_reliability;
}

}  // namespace

BusOptions for_topic(BusOptions options, std::string_view topic) {
  // Reports come once a hop and health now and then: of what the denoised samples promise, theirs are the partitions alone.
  if (topic == options.topics.noise || topic == options.topics.health)
    options.output = {.partitions = options.output.partitions};
  const std::vector<TopicQos> all = options.topic_qos;
  for (const TopicQos& qos : all) {
    if (qos.topic != topic && !(ros2::is_pattern(qos.topic) && ros2::matches(qos.topic, topic))) continue;
    if (qos.reliability) apply_reliability(*qos.reliability, options);
    if (qos.depth) apply_depth(*qos.depth, options);
    for (QosProfile* profile : {&options.input, &options.output, &options.ros2.input, &options.ros2.output})
      apply(qos, *profile);
  }
  return options;
}

}  // namespace gyrod::bus
