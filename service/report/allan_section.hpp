/// Figure 10 and Table 6: Allan deviation and noise coefficients of every scheme's output.
#pragma once

#include "report/axis_input.hpp"
#include "report/json.hpp"

namespace gyrod::report {

/// Curves, coefficients by three methods with standard errors, and the deviation at 0.1, 1, 10 and 100 s (as far as the record
/// goes). "absent" where the record is too short for a curve.
[[nodiscard]] Json allan_section(const AxisInput& input);

}  // namespace gyrod::report
