/// How accelerometer columns are spelt: accel_x_UNIT, accel_y_UNIT, accel_z_UNIT, one UNIT for all three.
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace gyrod::files {

inline constexpr double kStandardGravity_mps2 = 9.80665;  ///< 3rd CGPM 1901, exact

struct AccelUnit {
  std::string_view spelling;
  double mps2;
};
inline constexpr std::array<AccelUnit, 5> kAccelUnits = {{{"mps2", 1.0},
                                                          {"m_s2", 1.0},
                                                          {"m/s2", 1.0},
                                                          {"g", kStandardGravity_mps2},
                                                          {"mg", 1e-3 * kStandardGravity_mps2}}};

/// @param axis 0..2
[[nodiscard]] inline std::string accel_column(std::size_t axis, const AccelUnit& unit) {
  return std::string("accel_") + "xyz"[axis] + "_" + std::string(unit.spelling);
}

/// For messages, after the file's name.
inline constexpr std::string_view kNoAccelerometer =
    ": no accelerometer; expected the columns accel_x_UNIT, accel_y_UNIT, accel_z_UNIT with one UNIT of "
    "mps2, g, mg; found ";

}  // namespace gyrod::files
