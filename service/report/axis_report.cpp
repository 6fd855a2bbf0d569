#include "report/axis_report.hpp"

#include <string>
#include <vector>

#include "core/signal/autocorrelation.hpp"
#include "report/allan_section.hpp"
#include "report/comparison_section.hpp"
#include "report/decomposition_section.hpp"
#include "report/trace.hpp"

namespace gyrod::report {
namespace {

/// Writes series of one length, all of them or as they are drawn.
void write_rows(const std::string& first, double period_s, std::vector<Column> columns, bool full,
                const Sink& sink) {
  if (columns.empty()) return;
  std::vector<Trace> traces;
  double step = period_s;
  if (!full) {
    for (const Column& column : columns) traces.push_back(min_max_trace(column.values, period_s, kRowPoints));
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i].values = traces[i].values;
    step = traces.front().step;
  }
  write_series(first, step, columns, sink);
}

std::string imf_name(std::size_t index) { return "imf_" + std::to_string(index + 1); }

}  // namespace

Json axis_report(const AxisInput& input) {
  return Json{{"record", record_section(input)}, {"decomposition", decomposition_section(input)},
              {"models", model_section(input)},  {"before_after", before_after_section(input)},
              {"table5", table5_section(input)}, {"allan", allan_section(input)}};
}

void write_schemes(const AxisInput& input, const Sink& sink) {
  std::vector<Column> columns;
  for (const core::Scheme scheme : core::kAllSchemes) {
    columns.push_back(
        {std::string(core::name_of(scheme)) + "_dps", input.analysis.output(scheme), kDegPerRad});
  }
  write_series("time_s", input.period_s(), columns, sink);
}

void write_imfs(const AxisInput& input, bool full, const Sink& sink) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < input.analysis.imfs.size(); ++i) {
    columns.push_back({imf_name(i) + "_dps", input.analysis.imfs[i], kDegPerRad});
  }
  columns.push_back({"residue_dps", input.analysis.residue, kDegPerRad});
  write_rows("time_s", input.period_s(), std::move(columns), full, sink);
}

void write_acfs(const AxisInput& input, bool full, const Sink& sink) {
  const std::size_t samples = input.record().size();
  core::Autocorrelation autocorrelation(samples);
  std::vector<std::vector<double>> acfs;
  std::vector<Column> columns;
  for (std::size_t i = 0; i < input.analysis.imfs.size(); ++i) {
    std::vector<double> acf(samples);
    autocorrelation.acf(input.analysis.imfs[i], acf);
    acfs.push_back(std::move(acf));
    columns.push_back({imf_name(i) + "_acf", acfs.back()});
  }
  write_rows("lag_s", input.period_s(), std::move(columns), full, sink);
}

}  // namespace gyrod::report
