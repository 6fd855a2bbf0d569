#include "report/json.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace gyrod::report {
namespace {

double to_six_digits(double value) {
  constexpr int kDigits = 6;
  std::array<char, 32> text{};
  const auto written = std::to_chars(text.data(), text.data() + text.size(), value,
                                     std::chars_format::scientific, kDigits - 1);
  double back = value;
  std::from_chars(text.data(), written.ptr, back);
  return back;
}

}  // namespace

Json absent(std::string reason) { return Json{{"absent", std::move(reason)}}; }

Json rounded(std::span<const double> values, double factor) {
  Json array = Json::array();
  array.get_ref<Json::array_t&>().reserve(values.size());
  for (const double value : values) {
    if (std::isfinite(value)) {
      array.push_back(to_six_digits(value * factor));
    } else {
      array.push_back(nullptr);
    }
  }
  return array;
}

std::string script_text(const Json& json) {
  // These three stand in JSON only inside strings, where an escape is as good.
  std::string safe;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    switch (c) {
      case '<':
        safe += "\\u003c";
        break;
      case '>':
        safe += "\\u003e";
        break;
      case '&':
        safe += "\\u0026";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string file_text(const Json& json) {
  constexpr int kIndent = 1;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string number_text(double value, int digits) {
  constexpr double kLeast = 1e-3;
  constexpr double kMost = 1e6;
  const double size = std::abs(value);
  std::array<char, 48> text{};
  if (value == 0.0 || !std::isfinite(value) || size < kLeast || size >= kMost) {
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    return text.data();
  }
  const int decimals = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(size))));
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

}  // namespace gyrod::report
