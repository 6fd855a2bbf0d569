/// `gyrod top --once`: a table for scripts.
#pragma once

#include <string>
#include <vector>

#include "top/answers.hpp"

namespace gyrod::top {

/// One line of names, then a line a sensor; columns in the order below, at least a space apart, "-" where a figure is not known:
///   health sensor rate_hz noise_in_dps noise_out_dps reduction_db lost_percent received published rejected missing axes
/// Noise is that of the loudest axis, deg/s. `axes` are the states of x, y and z, e.g. "ok,noisy,ok".
[[nodiscard]] std::string listing(const std::vector<Sensor>& sensors);

/// Whether gyrod is ready and none of the sensors is troubled.
[[nodiscard]] bool all_well(const Status& status, const std::vector<Sensor>& sensors);

}  // namespace gyrod::top
