/// Series of many sensors as Prometheus text, written as the sensors come by.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "monitor/sensor_metrics.hpp"

namespace gyrod::monitor {

/// What prometheus::TextSerializer would make of the families, byte for byte, without making them: a thousand sensors have 67 000 series,
/// and a label for each of them cost more than all else. Holds a text a family; the sensors' snapshots can go.
class SensorExposition {
 public:
  /// @param groups families in their order
  SensorExposition(std::initializer_list<std::span<const SensorMetric>> groups);

  void add(const stream::ChannelSnapshot& sensor);
  [[nodiscard]] std::size_t sensors() const noexcept { return sensors_; }
  /// All families, those without a series, too.
  void append_to(std::string& text) const;

 private:
  struct Family {
    const SensorMetric* metric;
    std::string text;
  };
  std::vector<Family> families_;
  std::size_t sensors_ = 0;
};

}  // namespace gyrod::monitor
