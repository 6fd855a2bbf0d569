/// The report's numbers as JSON. Keys keep their order, as they become columns of CSV files.
#pragma once

#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace gyrod::report {

using Json = nlohmann::ordered_json;

inline constexpr double kDegPerRad = 180.0 / std::numbers::pi;

/// The section or number is not there, and why: {"absent": reason}. The page says the same in its place.
[[nodiscard]] Json absent(std::string reason);

/// value * factor to 6 significant digits each, so that traces stay short; what is not finite becomes null.
[[nodiscard]] Json rounded(std::span<const double> values, double factor = 1.0);

/// JSON text that may stand in an HTML <script> element: no <, > or & in it, whatever the strings hold. Broken UTF-8 is replaced.
[[nodiscard]] std::string script_text(const Json& json);

/// Ordinary JSON text, two blanks a level. Broken UTF-8 is replaced.
[[nodiscard]] std::string file_text(const Json& json);

/// Some significant digits for sentences, "12.35"; no exponent from 0.001 to 999 999.
[[nodiscard]] std::string number_text(double value, int digits = 4);

}  // namespace gyrod::report
