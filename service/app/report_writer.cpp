#include "app/report_writer.hpp"

#include <system_error>
#include <utility>
#include <vector>

#include "app/navigation_report.hpp"
#include "files/file_error.hpp"
#include "files/output_file.hpp"
#include "report/axis_report.hpp"
#include "report/csv.hpp"
#include "report/page.hpp"

namespace gyrod::app {
namespace {

using report::Json;

/// Ends a file that nobody wants any more.
struct Unwanted {};

/// Rows of one table of all axes, each with its axis in front. `find` gives an axis' rows, or null where it has none.
template <typename Find>
Json all_axes(const Json& axes, Find&& find) {
  Json all = Json::array();
  for (const auto& [name, axis] : axes.items()) {
    for (const Json& row : find(axis)) {
      Json with_axis{{"axis", name}};
      for (const auto& [key, value] : row.items()) {
        const bool drawn = key == "trace" || key == "acf";  // in files of their own
        if (!drawn) with_axis[key] = value;
      }
      all.push_back(std::move(with_axis));
    }
  }
  return all;
}

Json rows_of(const Json& section, const char* key) {
  return section.contains("absent") ? Json::array() : section.at(key);
}

/// The Allan curves point by point: a row a cluster time and scheme.
Json allan_points(const Json& allan) {
  Json rows = Json::array();
  for (const Json& curve : rows_of(allan, "curves")) {
    for (std::size_t i = 0; i < curve.at("tau_s").size(); ++i) {
      Json row{{"scheme", curve.at("scheme")}};
      for (const auto& [key, values] : curve.items()) {
        if (values.is_array()) row[key] = values[i];
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

Json record_row(const Json& section) { return Json::array({section}); }

Json navigation_rows(const Json& navigation) {
  Json rows = rows_of(navigation, "runs");
  for (Json& row : rows) row.erase("series");
  return rows;
}

struct Table {
  std::string name;
  std::string holds;
  Json rows;
};

std::vector<Table> tables(const Json& report) {
  const Json& axes = report.at("axes");
  return {{"record.csv", "the record in numbers, per axis",
           all_axes(axes, [](const Json& axis) { return record_row(axis.at("record")); })},
          {"imf_figures.csv", "Figs 5 and 7: class, period, PCC and variance of the ACF of every IMF",
           all_axes(axes, [](const Json& axis) { return rows_of(axis.at("decomposition"), "imfs"); })},
          {"models.csv", "Table 4: models with evidence and test of the residuals",
           all_axes(axes, [](const Json& axis) { return rows_of(axis.at("models"), "rows"); })},
          {"table5.csv", "Table 5: comparison of the schemes",
           all_axes(axes, [](const Json& axis) { return axis.at("table5").at("rows"); })},
          {"allan.csv", "Fig. 10: Allan deviation of every scheme with confidence bounds",
           all_axes(axes, [](const Json& axis) { return allan_points(axis.at("allan")); })},
          {"table6.csv", "Table 6: noise coefficients by three methods, with standard errors",
           all_axes(axes, [](const Json& axis) { return rows_of(axis.at("allan"), "table6"); })},
          {"tables7to9.csv", "Tables 7 to 9: errors of attitude, velocity and position of every scheme",
           navigation_rows(report.at("navigation"))}};
}

Json file_entry(const std::string& name, const std::string& holds) {
  return Json{{"name", name}, {"holds", holds}};
}

}  // namespace

ReportWriter::ReportWriter(std::filesystem::path folder, bool full)
    : folder_(std::move(folder)), full_(full) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw files::FileError(folder_.string() + ": the folder cannot be made: " + error.message());
  // Where the page cannot be written, that is better known before the work than after.
  const files::OutputFile probe(folder_ / "index.html");
}

void ReportWriter::write(const std::string& name, const std::string& text) const {
  files::OutputFile file(folder_ / name);
  file.write(text);
  file.close();
}

bool ReportWriter::write_series(const report::AxisInput& input, const std::function<bool()>& wanted) const {
  const auto into = [&](const std::string& name, auto&& write) {
    files::OutputFile file(folder_ / name);
    write([&](std::string_view text) {
      if (!wanted()) throw Unwanted{};
      file.write(text);
    });
    file.close();
  };
  try {
    into("schemes_" + input.name + ".csv",
         [&](const report::Sink& sink) { report::write_schemes(input, sink); });
    if (input.analysis.imfs.empty()) return true;
    into("imfs_" + input.name + ".csv",
         [&](const report::Sink& sink) { report::write_imfs(input, full_, sink); });
    into("acf_" + input.name + ".csv",
         [&](const report::Sink& sink) { report::write_acfs(input, full_, sink); });
    return true;
  } catch (const Unwanted&) {
    return false;
  }
}

void ReportWriter::finish(Json& report, const std::optional<NavigationResult>& navigation) const {
  Json list = Json::array();
  list.push_back(file_entry("report.json", "all numbers of this page, as it holds them"));
  for (const Table& table : tables(report)) {
    if (table.rows.empty()) continue;
    write(table.name, report::table_csv(table.rows));
    list.push_back(file_entry(table.name, table.holds));
  }
  const std::string length = full_ ? ", every sample" : ", as drawn (every sample with --full)";
  for (const auto& [name, axis] : report.at("axes").items()) {
    list.push_back(
        file_entry("schemes_" + name + ".csv", "Figs 3, 8, 9: record and all schemes, every sample"));
    if (axis.at("decomposition").contains("absent")) continue;
    list.push_back(file_entry("imfs_" + name + ".csv", "Fig. 4: IMFs and residue" + length));
    list.push_back(file_entry("acf_" + name + ".csv", "Fig. 6: autocorrelation of the IMFs" + length));
  }
  if (navigation) {
    files::OutputFile file(folder_ / "navigation.csv");
    write_navigation_csv(*navigation, file);
    file.close();
    list.push_back(file_entry("navigation.csv",
                              "Figs 11 to 13: navigation errors sample by sample, all starts and schemes"));
  }
  report["files"] = std::move(list);
  write("report.json", report::file_text(report));
  write("index.html",
        report::report_page("Report on " + report.at("record").at("name").get<std::string>(), report));
}

}  // namespace gyrod::app
