/// The numbers of a report, axis by axis on two threads.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "app/report_writer.hpp"
#include "core/denoise/scheme.hpp"
#include "files/record.hpp"
#include "report/json.hpp"
#include "stream/sample.hpp"

namespace gyrod::app {

/// What is kept of one axis.
struct ReportedAxis {
  report::Json sections;
  std::array<std::vector<double>, core::kSchemes> outputs_radps;  ///< every scheme's, for navigation
};

/// Axes that the record has, in the order x, y, z; nothing for the others.
using ReportedAxes = std::array<std::optional<ReportedAxis>, stream::kAxes>;

/// Decomposes and denoises the axes, makes their sections and writes their series; at most two at a time.
/// @param look  called every tenth of a second with the part that is done; false ends the work at once; an analysis in hand is left alone
/// @return nothing if it was ended
[[nodiscard]] std::optional<ReportedAxes> report_axes(const std::shared_ptr<const files::Record>& record,
                                                      bool still, const ReportWriter& writer,
                                                      const std::function<bool(double)>& look);

}  // namespace gyrod::app
