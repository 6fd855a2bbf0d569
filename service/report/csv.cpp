#include "report/csv.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>

namespace gyrod::report {
namespace {

using Cells = std::vector<std::pair<std::string, std::string>>;

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string safe = "\"";
  for (const char c : text) safe += c == '"' ? std::string("\"\"") : std::string(1, c);
  return safe + "\"";
}

std::string cell_text(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return quoted(value.get<std::string>());
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const Json& element : value) text += (text.empty() ? "" : " ") + cell_text(element);
  return text;
}

void flatten(const Json& row, const std::string& prefix, Cells& cells) {
  for (const auto& [key, value] : row.items()) {
    if (value.is_object()) {
      flatten(value, prefix + key + "_", cells);
    } else {
      cells.emplace_back(prefix + key, cell_text(value));
    }
  }
}

void append_number(std::string& text, double value) {
  constexpr int kDigits = 9;
  if (!std::isfinite(value)) return;  // an empty cell
  std::array<char, 32> digits{};
  const auto written =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, kDigits);
  text.append(digits.data(), written.ptr);
}

}  // namespace

std::string table_csv(const Json& rows) {
  std::string text;
  for (const Json& row : rows) {
    Cells cells;
    flatten(row, "", cells);
    const auto line = [&cells, &text](auto field) {
      for (std::size_t i = 0; i < cells.size(); ++i) text += (i == 0 ? "" : ",") + cells[i].*field;
      text += "\n";
    };
    if (text.empty()) line(&Cells::value_type::first);
    line(&Cells::value_type::second);
  }
  return text.empty() ? "\n" : text;
}

void write_series(const std::string& first, double step, const std::vector<Column>& columns,
                  const Sink& sink) {
  constexpr std::size_t kPiece = 100'000;
  std::string text = first;
  for (const Column& column : columns) text += "," + column.name;
  text += "\n";
  for (std::size_t n = 0; n < columns.front().values.size(); ++n) {
    append_number(text, static_cast<double>(n) * step);
    for (const Column& column : columns) {
      text += ',';
      append_number(text, column.values[n] * column.factor);
    }
    text += '\n';
    if (text.size() < kPiece) continue;
    sink(text);
    text.clear();
  }
  sink(text);
}

}  // namespace gyrod::report
