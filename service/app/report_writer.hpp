/// The files of a report folder.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "app/navigation_comparison.hpp"
#include "report/axis_input.hpp"
#include "report/json.hpp"

namespace gyrod::app {

/// Writes the CSV files of axes while they are worked on, and at the end the tables, report.json and index.html. Each file is there
/// in full or not at all. Files of different axes may be written from different threads.
class ReportWriter {
 public:
  /// Makes the folder, with those above it. @param full long series of every sample, else as drawn
  /// @throws files::FileError if it cannot be made or written to
  ReportWriter(std::filesystem::path folder, bool full);

  /// schemes_x.csv, imfs_x.csv, acf_x.csv. Any thread.
  /// @param wanted asked for every piece of text  @return false if it was no longer wanted; the file in hand is then not there
  [[nodiscard]] bool write_series(const report::AxisInput& input, const std::function<bool()>& wanted) const;

  /// The tables, navigation.csv where there is one, report.json and index.html; adds "files" to the report.
  /// @throws files::FileError
  void finish(report::Json& report, const std::optional<NavigationResult>& navigation) const;

 private:
  void write(const std::string& name, const std::string& text) const;

  std::filesystem::path folder_;
  bool full_;
};

}  // namespace gyrod::app
