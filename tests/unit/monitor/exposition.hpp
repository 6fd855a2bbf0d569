/// Reads the Prometheus text format 0.0.4 strictly, as a scraper would.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gyrod::monitor::test {

struct Series {
  std::string name;  ///< with _bucket, _sum, _count for histograms
  std::map<std::string, std::string> labels;
  double value = 0.0;
};

struct Family {
  std::string name;
  std::string help;
  std::string type;
  std::vector<Series> series;
};

/// @throws std::runtime_error naming the line that breaks the format: a series before or outside its family's
/// HELP and TYPE, a family given twice, a line that cannot be read
[[nodiscard]] std::vector<Family> parse_exposition(std::string_view text);

/// The family of this name, or nullptr.
[[nodiscard]] const Family* find_family(const std::vector<Family>& families, std::string_view name);

/// The value of the one series with exactly these labels; nothing if there is none.
[[nodiscard]] std::optional<double> value_of(const std::vector<Family>& families, std::string_view name,
                                             const std::map<std::string, std::string>& labels = {});

}  // namespace gyrod::monitor::test
