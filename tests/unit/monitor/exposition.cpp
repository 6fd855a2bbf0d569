#include "unit/monitor/exposition.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace gyrod::monitor::test {
namespace {

constexpr std::string_view kNameCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_:";

/// Reads one line from left to right.
class LineReader {
 public:
  explicit LineReader(const std::string& line) : line_(line), rest_(line) {}

  std::string name() {
    const std::size_t size = std::min(rest_.find_first_not_of(kNameCharacters), rest_.size());
    if (size == 0) fail("a name");
    return take(size);
  }

  bool accept(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  void expect(std::string_view token) {
    if (!accept(token)) fail(std::string(token));
  }

  /// A label's value up to the closing quote, unescaped.
  std::string quoted() {
    std::string value;
    expect("\"");
    while (!accept("\"")) {
      if (rest_.empty()) fail("a closing quote");
      if (accept("\\n")) {
        value += '\n';
      } else {
        (void)accept("\\");
        value += take(1);
      }
    }
    return value;
  }

  double number() {
    std::size_t used = 0;
    const double value = std::stod(std::string(rest_), &used);
    if (used != rest_.size()) fail("a number and nothing behind it");
    return value;
  }

  std::string rest() { return take(rest_.size()); }

  [[noreturn]] void fail(const std::string& expected) const {
    throw std::runtime_error("'" + line_ + "': expected " + expected + " at '" + std::string(rest_) + "'");
  }

 private:
  std::string take(std::size_t size) {
    std::string taken(rest_.substr(0, size));
    rest_.remove_prefix(taken.size());
    return taken;
  }

  std::string line_;
  std::string_view rest_;
};

Series read_series(LineReader& line) {
  Series series;
  series.name = line.name();
  if (line.accept("{")) {
    while (!line.accept("}")) {
      const std::string label = line.name();
      line.expect("=");
      series.labels[label] = line.quoted();
      (void)line.accept(",");
    }
  }
  line.expect(" ");
  series.value = line.number();
  return series;
}

bool belongs(const Series& series, const Family& family) {
  if (family.type != "histogram") return series.name == family.name;
  const auto is = [&](const char* suffix) { return series.name == family.name + suffix; };
  return is("_bucket") || is("_sum") || is("_count");
}

void read_line(const std::string& text, std::vector<Family>& families) {
  LineReader line(text);
  if (line.accept("# HELP ")) {
    Family family{.name = line.name(), .help = "", .type = "", .series = {}};
    if (find_family(families, family.name) != nullptr) line.fail("a family only once");
    line.expect(" ");
    family.help = line.rest();
    families.push_back(std::move(family));
    return;
  }
  if (families.empty()) line.fail("HELP first");
  if (line.accept("# TYPE ")) {
    line.expect(families.back().name + " ");
    families.back().type = line.rest();
    return;
  }
  Series series = read_series(line);
  if (families.back().type.empty() || !belongs(series, families.back())) {
    line.fail("a series of the family above");
  }
  families.back().series.push_back(std::move(series));
}

}  // namespace

std::vector<Family> parse_exposition(std::string_view text) {
  std::vector<Family> families;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) read_line(line, families);
  return families;
}

const Family* find_family(const std::vector<Family>& families, std::string_view name) {
  const auto found = std::ranges::find(families, name, &Family::name);
  return found == families.end() ? nullptr : &*found;
}

std::optional<double> value_of(const std::vector<Family>& families, std::string_view name,
                               const std::map<std::string, std::string>& labels) {
  const Family* family = find_family(families, name);
  if (family == nullptr) return std::nullopt;
  const auto found = std::ranges::find(family->series, labels, &Series::labels);
  if (found == family->series.end()) return std::nullopt;
  return found->value;
}

}  // namespace gyrod::monitor::test
