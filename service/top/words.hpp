/// Numbers and states as people read them.
#pragma once

#include <string>
#include <string_view>

#include "top/answers.hpp"

namespace gyrod::top {

/// What a state of health looks like. The letter says it without colour.
struct StateLook {
  char letter;
  int colour;  ///< of the 256 of a terminal
};

/// Of a state's name; of one that is not known, '?'.
[[nodiscard]] StateLook look_of(std::string_view health) noexcept;
/// Whether somebody should look at it: any state but ok and warming_up.
[[nodiscard]] bool is_troubled(std::string_view health) noexcept;

enum class RateUnit { kDegPerS, kRadPerS };
[[nodiscard]] std::string_view name_of(RateUnit unit) noexcept;
[[nodiscard]] Figure in_unit(Figure radps, RateUnit unit) noexcept;

/// So many digits that count, or "-" where it is not known.
[[nodiscard]] std::string significant(Figure value, int digits = 3);
/// So many decimals, or "-".
[[nodiscard]] std::string fixed(Figure value, int decimals);
/// "12.3 k/s", or "-".
[[nodiscard]] std::string per_second(Figure value);
/// "1.20 ms", or "-".
[[nodiscard]] std::string duration(Figure seconds);
/// "3 d 4 h", "4 h 12 min", "12 min", "40 s".
[[nodiscard]] std::string age(double seconds);
/// "04:05:06Z", of seconds since 1970.
[[nodiscard]] std::string clock(double time_s);

}  // namespace gyrod::top
