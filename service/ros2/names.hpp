/// Names of ROS 2 topics as they are in DDS, and how gyrod names what it publishes for them. Text in, text out: settings judge by
/// it, the bus acts by it.
#pragma once

#include <string>
#include <string_view>

namespace gyrod::ros2 {

/// What is put behind the name of an input topic to name its two outputs; a "_raw" at its end goes first.
struct OutputRule {
  std::string denoised_suffix = "_denoised";
  std::string realtime_suffix = "_realtime";
};

struct Outputs {
  std::string denoised;  ///< e.g. "rt/car/imu/data_denoised" for "rt/car/imu/data_raw"
  std::string realtime;
};

/// Whether ROS 2 can have made this DDS topic name: "rt/", then names with '/' between them, each of letters, digits and '_', not
/// beginning with a digit and without "__".
[[nodiscard]] bool is_topic(std::string_view text) noexcept;

/// Whether this is a topic, or becomes one when each '*' in it is replaced by a letter.
[[nodiscard]] bool is_topic_or_pattern(std::string_view text);

/// Whether this stands for more than one topic. @pre is_topic_or_pattern(text)
[[nodiscard]] bool is_pattern(std::string_view text) noexcept;

/// Whether the topic is the pattern with each '*' replaced by one or more characters that are no '/'. A topic matches itself.
[[nodiscard]] bool matches(std::string_view pattern, std::string_view topic) noexcept;

/// Whether this can be an OutputRule's suffix: behind a topic it makes another topic, which does not end in "_raw".
[[nodiscard]] bool is_suffix(std::string_view text);

[[nodiscard]] Outputs outputs_of(std::string_view topic, const OutputRule& rule);

/// Whether a topic, or every topic that matches a pattern, is named as an output: never read, so that nobody denoises what was
/// denoised.
[[nodiscard]] bool is_output(std::string_view topic, const OutputRule& rule) noexcept;

}  // namespace gyrod::ros2
