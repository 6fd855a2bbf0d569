#include "files/csv_row.hpp"

#include <algorithm>
#include <cstddef>

namespace gyrod::files {
namespace {

constexpr std::size_t kLongestShown = 60;

bool is_blank(char c) noexcept { return c == ' ' || c == '\t'; }

bool is_printable(char c) noexcept { return c >= ' ' && c <= '~'; }

/// Index of the next separator outside quotes, or the row's size; past the size if a quote does not end.
std::size_t end_of_cell(std::string_view row, std::size_t begin, char separator) noexcept {
  bool quoted = false;
  for (std::size_t i = begin; i < row.size(); ++i) {
    if (row[i] == '"') quoted = !quoted;
    if (row[i] == separator && !quoted) return i;
  }
  return quoted ? row.size() + 1 : row.size();
}

}  // namespace

bool split_row(std::string_view row, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = end_of_cell(row, begin, separator);
    if (end > row.size()) return false;
    cells.push_back(row.substr(begin, end - begin));
    if (end == row.size()) return true;
    begin = end + 1;
  }
}

std::string_view bare(std::string_view cell) noexcept {
  while (!cell.empty() && is_blank(cell.front())) cell.remove_prefix(1);
  while (!cell.empty() && is_blank(cell.back())) cell.remove_suffix(1);
  if (cell.size() < 2 || cell.front() != '"' || cell.back() != '"') return cell;
  return bare(cell.substr(1, cell.size() - 2));
}

std::string shown(std::string_view text) {
  std::string result = "\"";
  result += text.substr(0, kLongestShown);
  std::replace_if(
      result.begin(), result.end(), [](char c) { return !is_printable(c); }, '?');
  result += text.size() > kLongestShown ? "...\"" : "\"";
  return result;
}

}  // namespace gyrod::files
