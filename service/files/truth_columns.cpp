#include <filesystem>
#include <limits>

#include "files/csv_row.hpp"
#include "files/file_error.hpp"
#include "files/line_reader.hpp"
#include "files/navigation_columns.hpp"
#include "files/number_text.hpp"
#include "files/truth_builder.hpp"

namespace gyrod::files {
namespace {

constexpr double kSecondsPerNs = 1e-9;

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

/// Exponent of a time column's unit in ns, as RecordingHeader::time_exponent; nothing for another name.
std::optional<int> time_exponent(std::string_view name) {
  for (const std::string_view stem : {"stamp_", "timestamp_", "time_"}) {
    if (!name.starts_with(stem)) continue;
    const std::string_view unit = name.substr(stem.size());
    if (unit == "ns") return 0;
    if (unit == "us") return 3;
    if (unit == "ms") return 6;
    if (unit == "s") return 9;
  }
  return std::nullopt;
}

/// A file of numbers with a time column.
class TruthTable {
 public:
  explicit TruthTable(const std::string& path) : lines_(path) {
    std::string_view line;
    if (!lines_.next(line)) throw FileError(lines_.name() + ": is empty; expected a header line");
    read_header(line);
    while (lines_.next(line)) {
      if (!bare(line).empty()) read_row(line);
    }
  }

  [[nodiscard]] const std::string& name() const noexcept { return lines_.name(); }
  [[nodiscard]] const std::vector<double>& stamp_s() const noexcept { return stamp_s_; }
  [[nodiscard]] ColumnMap columns() const {
    ColumnMap map;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (i != time_) map.try_emplace(names_[i], values_[i]);
    }
    return map;
  }

 private:
  void read_header(std::string_view line) {
    static_cast<void>(split_row(line, ',', cells_));
    for (const std::string_view cell : cells_) names_.push_back(lower_case(bare(cell)));
    values_.resize(names_.size());
    for (std::size_t i = 0; i < names_.size() && !exponent_; ++i) {
      exponent_ = time_exponent(names_[i]);
      time_ = i;
    }
    if (!exponent_) {
      throw FileError(lines_.name() + ": no time column; expected timestamp_s, stamp_ns or the like in '" +
                      shown(line) + "'");
    }
  }

  void read_row(std::string_view line) {
    static_cast<void>(split_row(line, ',', cells_));
    if (cells_.size() != names_.size()) {
      complain("has " + std::to_string(cells_.size()) + " cells; expected " + std::to_string(names_.size()));
    }
    const auto stamp_ns = parse_stamp_ns(bare(cells_[time_]), *exponent_);
    if (!stamp_ns) complain("time is '" + shown(cells_[time_]) + "'; expected a number");
    const double stamp_s = kSecondsPerNs * static_cast<double>(*stamp_ns);
    if (!stamp_s_.empty() && stamp_s <= stamp_s_.back()) complain("time does not rise");
    stamp_s_.push_back(stamp_s);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      values_[i].push_back(parse_rate(bare(cells_[i])).value_or(std::numeric_limits<double>::quiet_NaN()));
    }
  }

  [[noreturn]] void complain(const std::string& what) const {
    throw FileError(lines_.name() + ":" + std::to_string(lines_.line_number()) + ": " + what);
  }

  LineReader lines_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> values_;
  std::vector<double> stamp_s_;
  std::optional<int> exponent_;
  std::size_t time_ = 0;
  std::vector<std::string_view> cells_;
};

}  // namespace

std::optional<NavigationTruth> truth_columns(const Record& record, const std::optional<std::string>& prefix,
                                             const core::GeodeticPosition& reference) {
  const auto chosen = chosen_prefix(record.others, record.name, prefix);
  if (!chosen) return std::nullopt;
  NavigationTruth truth = build_truth(record.others, *chosen, record.time_s, reference);
  truth.source = "columns " + *chosen + "*";
  return truth;
}

NavigationTruth load_truth(const std::string& path, const Record& record, const TruthFileOptions& options) {
  const TruthTable table(path);
  const ColumnMap columns = table.columns();
  const auto prefix = chosen_prefix(columns, table.name(), std::nullopt);
  if (!prefix) {
    throw FileError(table.name() + ": no reference; expected columns such as q_w, lat_deg or vn_mps, found " +
                    names_of(columns));
  }
  std::vector<double> time_s;
  for (const double stamp_s : table.stamp_s())
    time_s.push_back(stamp_s - record.first_stamp_s + options.offset_s);
  if (time_s.empty() || time_s.back() < 0.0 || time_s.front() > record.time_s.back()) {
    throw FileError(table.name() + ": no row within the time of " + record.name +
                    "; see --truth-offset if the two clocks differ");
  }
  NavigationTruth truth = build_truth(columns, *prefix, std::move(time_s), options.reference);
  truth.source = std::filesystem::path(table.name()).filename().string();
  return truth;
}

}  // namespace gyrod::files
