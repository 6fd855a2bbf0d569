/// Constant sensor errors found against a reference trajectory.
#pragma once

#include <cstddef>
#include <optional>

#include "core/inertial/alignment.hpp"
#include "core/inertial/dead_reckoning.hpp"
#include "core/inertial/truth.hpp"

namespace gyrod::core {

struct TruthCalibrationOptions {
  double leg_s = 1.0;      ///< length of one leg; long against the reference's noise, short against drift
  double max_gap_s = 0.1;  ///< of the truth, see truth_at()
};

struct TruthCalibration {
  SensorBias bias;
  std::size_t legs = 0;           ///< with known attitude at both ends
  std::size_t velocity_legs = 0;  ///< of them those with known velocity; 0: bias.accel_mps2 is 0
};

/// One gyro bias b_g and one accelerometer bias b_a for the whole recording, by least squares. On each leg the
/// strapdown solution starts at the truth; at its end the attitude is off by the rotation e = D b_g and, after
/// b_g is removed, the velocity by e = D b_a, with D the sum of C dt over the leg; over all legs
///   b = (sum D'D)^-1 sum D'e.
/// Where the truth has no position, `reference` gives latitude and height.
/// @return nothing where no leg has a known attitude at both ends. Allocates; pure
[[nodiscard]] std::optional<TruthCalibration> calibrated_on_truth(const InertialSeries& series,
                                                                  const Truth& truth,
                                                                  const GeodeticPosition& reference,
                                                                  const TruthCalibrationOptions& options);

}  // namespace gyrod::core
