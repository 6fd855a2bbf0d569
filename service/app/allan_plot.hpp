/// The Allan analysis as a picture.
#pragma once

#include <string>

#include "app/allan_analysis.hpp"
#include "files/rate_unit.hpp"

namespace gyrod::app {

/// An SVG file on its own: one log-log panel for gyros and one for accelerometers, with a curve, its confidence band
/// and the fitted model (dashed) for each axis. Follows the viewer's light or dark scheme.
/// @param unit of the gyros' deviation
[[nodiscard]] std::string allan_svg(const AllanAnalysis& analysis, files::RateUnit unit);

}  // namespace gyrod::app
