/// Small words of the JSON API.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "stream/counters.hpp"

namespace gyrod::monitor {

/// Keys keep the order of the manual.
using Json = nlohmann::ordered_json;

/// null where nothing is known, or what is known is no number.
[[nodiscard]] Json json_of(const std::optional<double>& value);
/// Of figures whose 0 means "not known".
[[nodiscard]] Json json_if_known(double value);
/// Beyond what a double holds, so a text of digits.
[[nodiscard]] Json json_of_stamp(std::int64_t stamp_ns);

/// {"received": .., ..., "rejected": {"not_finite": .., ...}, "rejected_total": ..}: all of Counts.
[[nodiscard]] Json json_of(const stream::Counts& counts);

/// Broken UTF-8 is replaced.
[[nodiscard]] std::string text_of(const Json& json);

}  // namespace gyrod::monitor
