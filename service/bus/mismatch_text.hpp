/// What is said of a writer and a reader that do not match. Internal to bus/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bus/qos_match.hpp"

namespace gyrod::bus {

enum class Direction : std::uint8_t {
  kInput,   ///< their writer, our reader
  kOutput,  ///< our writer, their reader
};
inline constexpr std::size_t kDirections = 2;
inline constexpr std::array<std::string_view, kDirections> kDirectionNames = {"input", "output"};

struct Mismatch {
  Direction direction;
  std::string_view topic;
  std::string_view peer;  ///< in words
  bool ros2;              ///< the topic is one of ROS 2
};

/// One line with the values of both sides and what to set, e.g.
///   topic 'gyro/raw': a writer of 'imu' (process 42 on car1) does not match: it offers reliability best effort, gyrod asks for
///   reliable; set bus.input.reliability to "auto"
/// @pre there are differences
[[nodiscard]] std::string mismatch_text(const Mismatch& mismatch, const std::vector<Difference>& differences);

}  // namespace gyrod::bus
