/// Figures 3 to 7 and Table 4: the record, its decomposition, screening and models.
#pragma once

#include "report/axis_input.hpp"
#include "report/json.hpp"

namespace gyrod::report {

/// Figure 3 and the record's own figures.
[[nodiscard]] Json record_section(const AxisInput& input);

/// Figures 4 to 7: per IMF its trace, class, PCC and ACF; j and k. "absent" where nothing could be decomposed.
[[nodiscard]] Json decomposition_section(const AxisInput& input);

/// Table 4: the models of the mixed IMFs and of the record, with evidence and the test of the residuals.
[[nodiscard]] Json model_section(const AxisInput& input);

}  // namespace gyrod::report
