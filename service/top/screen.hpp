/// The whole screen of `gyrod top`, from what is known: a pure function, line by line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "top/answers.hpp"
#include "top/line.hpp"
#include "top/view.hpp"

namespace gyrod::top {

/// What is known of a gyrod now.
struct Picture {
  std::string url;
  std::optional<Status> status;
  std::optional<SensorPage> page;
  std::vector<Event> events;  ///< the newest, the last one last
  std::string trouble;        ///< why nothing newer is known; empty: all is well
};

struct Size {
  std::size_t columns = 80;
  std::size_t rows = 24;
};

/// Events on a screen that is large enough.
inline constexpr std::size_t kEventsShown = 4;

/// Sensors that find room on a screen of that size.
[[nodiscard]] std::uint64_t sensor_rows(Size size) noexcept;

/// At most size.rows lines.
[[nodiscard]] std::vector<Line> screen(const Picture& picture, const View& view, Size size);

/// The lines as bytes for a terminal: each in its place, with nothing of an older picture left.
[[nodiscard]] std::string painted(const std::vector<Line>& lines, Size size, bool coloured);

}  // namespace gyrod::top
