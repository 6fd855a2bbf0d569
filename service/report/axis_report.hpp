/// All sections of one axis, and its long series.
#pragma once

#include "report/axis_input.hpp"
#include "report/csv.hpp"
#include "report/json.hpp"

namespace gyrod::report {

/// The sections of one axis, in the page's order: record, decomposition, models, before_after, table5, allan.
[[nodiscard]] Json axis_report(const AxisInput& input);

/// "schemes_x.csv": record and all schemes' outputs, every sample, deg/s.
void write_schemes(const AxisInput& input, const Sink& sink);
/// "imfs_x.csv": IMFs and residue, deg/s. @param full every sample; else as drawn
void write_imfs(const AxisInput& input, bool full, const Sink& sink);
/// "acf_x.csv": the IMFs' autocorrelations by lag. @param full every lag; else as drawn
void write_acfs(const AxisInput& input, bool full, const Sink& sink);

}  // namespace gyrod::report
