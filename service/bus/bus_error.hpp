/// What is thrown when DDS refuses something at the start.
#pragma once

#include <stdexcept>
#include <string>

namespace gyrod::bus {

/// Names what was tried (topic, QoS, file), what DDS answered, and what was expected.
class BusError : public std::runtime_error {
 public:
  explicit BusError(const std::string& message) : std::runtime_error(message) {}
  /// @param attempt   e.g. "create a reader of topic 'gyro/raw' (reliable, keep last 8)"
  /// @param dds_code  a DDS_RETCODE_ value
  BusError(const std::string& attempt, int dds_code);
};

}  // namespace gyrod::bus
