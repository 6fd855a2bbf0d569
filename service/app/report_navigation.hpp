/// Figures 11 to 13 and Tables 7 to 9 of a report.
#pragma once

#include "app/navigation_comparison.hpp"
#include "app/report_axes.hpp"
#include "files/record.hpp"
#include "report/json.hpp"

namespace gyrod::app {

struct ReportNavigation {
  report::Json section;                    ///< or {"absent": why}
  std::optional<NavigationResult> result;  ///< with the errors sample by sample, for their CSV file
};

/// Navigates with all schemes' outputs from the starts that compare_navigation() chooses. The truth is the record's own reference,
/// or, for a still record without one, rest. Never throws for what the record lacks: the section says it.
[[nodiscard]] ReportNavigation report_navigation(const files::Record& record, const ReportedAxes& axes,
                                                 bool still);

}  // namespace gyrod::app
