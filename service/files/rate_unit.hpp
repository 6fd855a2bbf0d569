/// Units of angular rate as they stand in column names. The only place of the project that converts them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gyrod::files {

enum class RateUnit {
  kRadps,   ///< radian per second: radps, rad_s, rad/s
  kMradps,  ///< milliradian per second: mradps, mrad_s, mrad/s
  kDps,     ///< degree per second: dps, degps, deg_s, deg/s
  kMdps,    ///< millidegree per second: mdps, mdegps, mdeg_s, mdeg/s
  kDph,     ///< degree per hour: dph, degph, deg_h, deg/h
};

/// The unit with this spelling (lower case, see RateUnit), or nothing.
[[nodiscard]] std::optional<RateUnit> rate_unit_of(std::string_view spelling) noexcept;

/// The spelling that gyrod writes: the first in RateUnit's list.
[[nodiscard]] std::string_view spelling_of(RateUnit unit) noexcept;

/// All first spellings, for messages: "radps, mradps, dps, mdps, dph".
[[nodiscard]] std::string known_rate_units();

/// One `unit` in rad/s, correctly rounded to a double.
[[nodiscard]] double radps_per(RateUnit unit) noexcept;

/// value * radps_per(unit). Exact for kRadps; else off by half a unit in the last place at the most.
[[nodiscard]] double to_radps(double value, RateUnit unit) noexcept;

/// rate / radps_per(unit). Exact for kRadps; else from_radps(to_radps(x)) is x to two units in the last
/// place.
[[nodiscard]] double from_radps(double rate_radps, RateUnit unit) noexcept;

}  // namespace gyrod::files
