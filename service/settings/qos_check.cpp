#include "settings/qos_check.hpp"

#include <algorithm>
#include <array>

#include "ros2/names.hpp"
#include "settings/enum_names.hpp"

namespace gyrod::settings {
namespace {

class Check {
 public:
  explicit Check(const BusSettings& bus) : bus_(bus) {}

  std::vector<Mistake> run() {
    check_liveliness("bus.input.liveliness", bus_.input.qos);
    check_liveliness("bus.output.liveliness", bus_.output.qos);
    check_liveliness("bus.ros2.input_liveliness", bus_.ros2.input_qos);
    check_liveliness("bus.ros2.output_liveliness", bus_.ros2.output_qos);
    check_written("bus.output.partitions", bus_.output.qos.partitions);
    check_written("bus.ros2.partitions", bus_.ros2.input_qos.partitions);
    for (std::size_t i = 0; i < bus_.topic_qos.size(); ++i)
      look_at("bus.topic_qos[" + std::to_string(i) + "]", bus_.topic_qos[i]);
    return std::move(mistakes_);
  }

 private:
  void look_at(const std::string& key, const TopicQosSettings& qos) {
    const bool is_read = reads(qos.topic);
    require(is_read || writes(qos.topic), key, qos.topic,
            "one of bus.topics, a topic of bus.ros2.topics or an output of one, or a pattern as there");
    require(is_read || qos.reliability != InputReliability::kAuto, key, "auto",
            "\"reliable\" or \"best_effort\", for gyrod writes " + qos.topic);
    require(is_raw(qos.topic) || qos.history_depth != 0U, key, "history_depth 0",
            "a depth above 0; only the raw topics keep all");
    require(qos.liveliness != Liveliness::kManualByTopic || qos.liveliness_lease_s.value_or(0.0) > 0.0, key,
            "manual_by_topic", "a liveliness_lease_s above 0 with it");
    if (!is_read && qos.partitions) check_written(key + ".partitions", *qos.partitions);
  }

  void check_liveliness(const std::string& key, const QosSettings& qos) {
    require(qos.liveliness == Liveliness::kAutomatic || qos.liveliness_lease_s > 0.0, key + "_lease_s",
            qos.liveliness_lease_s,
            "above 0, for " + key + " is \"" + std::string(name_of(qos.liveliness)) + "\"", {key});
  }

  void check_written(const std::string& key, const std::vector<std::string>& partitions) {
    for (std::size_t i = 0; i < partitions.size(); ++i) {
      require(partitions[i].find_first_of("*?") == std::string::npos, key + "[" + std::to_string(i) + "]",
              partitions[i], "a name without '*' and '?', for gyrod writes there", {key});
    }
  }

  /// @param others as of Mistake
  void require(bool holds, const std::string& key, const nlohmann::json& value, const std::string& expected,
               const std::vector<std::string>& others = {"bus.topics", "bus.ros2"}) {
    if (!holds) mistakes_.push_back({key, value, expected, others});
  }

  [[nodiscard]] bool is_raw(const std::string& topic) const {
    return topic == bus_.topics.raw || topic == bus_.topics.raw_batch;
  }

  [[nodiscard]] bool reads(const std::string& topic) const {
    if (is_raw(topic)) return true;
    if (!ros2::is_topic_or_pattern(topic) || is_ros2_output(topic)) return false;
    return ros2::is_pattern(topic) || std::ranges::any_of(bus_.ros2.topics, [&topic](const auto& input) {
             return ros2::matches(input, topic);
           });
  }

  [[nodiscard]] bool writes(const std::string& topic) const {
    const TopicSettings& topics = bus_.topics;
    const std::array own = {&topics.denoised, &topics.denoised_batch, &topics.noise,
                            &topics.health,   &topics.realtime,       &topics.realtime_batch};
    return std::ranges::any_of(own, [&topic](const std::string* name) { return *name == topic; }) ||
           (ros2::is_topic_or_pattern(topic) && is_ros2_output(topic));
  }

  [[nodiscard]] bool is_ros2_output(const std::string& topic) const {
    return ros2::is_output(topic, {bus_.ros2.denoised_suffix, bus_.ros2.realtime_suffix});
  }

  const BusSettings& bus_;
  std::vector<Mistake> mistakes_;
};

}  // namespace

std::vector<Mistake> qos_mistakes(const BusSettings& bus) { return Check(bus).run(); }

}  // namespace gyrod::settings
