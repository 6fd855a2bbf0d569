/// The Allan analysis in files: for programs, for spreadsheets, for Kalibr.
#pragma once

#include <string>

#include "app/allan_analysis.hpp"
#include "files/rate_unit.hpp"

namespace gyrod::app {

/// All numbers as JSON: keys with units, SI; coefficients in the units of data sheets besides. What is not
/// observable is null.
[[nodiscard]] std::string allan_json(const AllanAnalysis& analysis);

/// The curves as CSV: tau_s, cluster_samples, terms, and for each channel its deviation, the bounds, the degrees of
/// freedom, and the fitted model. All bits.
/// @param unit of a gyro's columns; accelerometers are in m/s^2
[[nodiscard]] std::string allan_csv(const AllanAnalysis& analysis, files::RateUnit unit);

/// Noise densities and random walks as Kalibr and its kin read them (imu.yaml), in their units: continuous time, SI,
/// one number for the three axes: that of the noisiest, so that no axis is trusted too much. What no axis shows is
/// left out, with a comment, never 0.
[[nodiscard]] std::string kalibr_imu_yaml(const AllanAnalysis& analysis, const std::string& ros_topic);

}  // namespace gyrod::app
