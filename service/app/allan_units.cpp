#include "app/allan_units.hpp"

namespace gyrod::app {
namespace {

using core::NoiseTerm;
using Units = std::array<CoefficientUnit, core::kNoiseTerms>;

constexpr Units kGyroUnits = {{
    {NoiseTerm::kQuantization, "Q", "quantization", "quantization", "rad", "deg"},
    {NoiseTerm::kAngleRandomWalk, "N", "angle_random_walk", "angle random walk", "rad/s/sqrt(Hz)",
     "deg/sqrt(h)"},
    {NoiseTerm::kBiasInstability, "B", "bias_instability", "bias instability", "rad/s", "deg/h"},
    {NoiseTerm::kRateRandomWalk, "K", "rate_random_walk", "rate random walk", "rad/s^2/sqrt(Hz)",
     "deg/h^1.5"},
    {NoiseTerm::kRateRamp, "R", "rate_ramp", "rate ramp", "rad/s^2", "deg/h^2"},
}};

constexpr Units kAccelerometerUnits = {{
    {NoiseTerm::kQuantization, "Q", "quantization", "quantization", "m/s", "ug s"},
    {NoiseTerm::kAngleRandomWalk, "N", "velocity_random_walk", "velocity random walk", "m/s^2/sqrt(Hz)",
     "ug/sqrt(Hz)"},
    {NoiseTerm::kBiasInstability, "B", "bias_instability", "bias instability", "m/s^2", "ug"},
    {NoiseTerm::kRateRandomWalk, "K", "acceleration_random_walk", "acceleration r. walk", "m/s^3/sqrt(Hz)",
     "ug/s/sqrt(Hz)"},
    {NoiseTerm::kRateRamp, "R", "acceleration_ramp", "acceleration ramp", "m/s^3", "ug/s"},
}};

constexpr double kMicroG = 9.80665e-6;

const char* title_of(files::RateUnit unit) noexcept {
  switch (unit) {
    case files::RateUnit::kRadps:
      return "rad/s";
    case files::RateUnit::kMradps:
      return "mrad/s";
    case files::RateUnit::kDps:
      return "deg/s";
    case files::RateUnit::kMdps:
      return "mdeg/s";
    case files::RateUnit::kDph:
      return "deg/h";
  }
  return "rad/s";
}

}  // namespace

const Units& coefficient_units(SensorKind sensor) noexcept {
  return sensor == SensorKind::kGyro ? kGyroUnits : kAccelerometerUnits;
}

double in_sheet_unit(SensorKind sensor, NoiseTerm term, double value) noexcept {
  return sensor == SensorKind::kGyro ? core::in_degrees_and_hours(term, value) : value / kMicroG;
}

DeviationUnit deviation_unit(SensorKind sensor, files::RateUnit unit) {
  if (sensor == SensorKind::kAccelerometer) return {1.0, "mps2", "m/s^2"};
  return {files::radps_per(unit), std::string(files::spelling_of(unit)), title_of(unit)};
}

}  // namespace gyrod::app
