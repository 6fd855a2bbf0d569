/// The time of day, for what people read.
#pragma once

#include <chrono>

namespace gyrod::app {

[[nodiscard]] inline double seconds_since_1970() noexcept {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

}  // namespace gyrod::app
