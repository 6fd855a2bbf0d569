/// Units of the Allan analysis, in words and numbers, for all its outputs.
#pragma once

#include <array>
#include <string>

#include "app/allan_analysis.hpp"
#include "files/rate_unit.hpp"

namespace gyrod::app {

/// One coefficient's names and units for one kind of sensor.
struct CoefficientUnit {
  core::NoiseTerm term;
  const char* letter;  ///< Q, N, B, K, R
  const char* key;     ///< "angle_random_walk"
  const char* title;   ///< "angle random walk"
  const char* si;      ///< "rad/s/sqrt(Hz)"
  const char* sheet;   ///< as data sheets give it: "deg/sqrt(h)"
};

/// In the order of core::NoiseTerm.
[[nodiscard]] const std::array<CoefficientUnit, core::kNoiseTerms>& coefficient_units(
    SensorKind sensor) noexcept;

/// A coefficient in the unit of data sheets. @param value in SI
[[nodiscard]] double in_sheet_unit(SensorKind sensor, core::NoiseTerm term, double value) noexcept;

/// In what the deviation of a channel is shown: gyros in the unit chosen, accelerometers in m/s^2.
struct DeviationUnit {
  double si = 1.0;     ///< one unit in SI
  std::string suffix;  ///< for names: "dps"
  std::string title;   ///< for people: "deg/s"
};
[[nodiscard]] DeviationUnit deviation_unit(SensorKind sensor, files::RateUnit unit);

}  // namespace gyrod::app
