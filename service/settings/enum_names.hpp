/// The enumerators' names in the configuration, in the order of the enumerators and of the schema's `enum`.
#pragma once

#include <array>
#include <string_view>

#include "settings/settings.hpp"

namespace gyrod::settings {

constexpr std::array<std::string_view, 2> names_of(Reliability) { return {"reliable", "best_effort"}; }
constexpr std::array<std::string_view, 3> names_of(InputReliability) {
  return {"auto", "reliable", "best_effort"};
}
constexpr std::array<std::string_view, 2> names_of(Liveliness) { return {"automatic", "manual_by_topic"}; }
constexpr std::array<std::string_view, 2> names_of(Durability) { return {"volatile", "transient_local"}; }
constexpr std::array<std::string_view, 2> names_of(Method) { return {"paper", "joint"}; }
constexpr std::array<std::string_view, core::kSchemes> names_of(core::Scheme) { return core::kSchemeNames; }
constexpr std::array<std::string_view, 3> names_of(Screening) {
  return {"windowed", "paper", "significance"};
}
constexpr std::array<std::string_view, 2> names_of(core::BoundaryRule) { return {"mirror", "linear"}; }
constexpr std::array<std::string_view, 4> names_of(NoiseSource) {
  return {"auto", "calibrated", "standstill", "imf1"};
}
constexpr std::array<std::string_view, 5> names_of(LogLevel) {
  return {"trace", "debug", "info", "warning", "error"};
}

/// The name of one enumerator, as in the configuration.
template <class Enum>
[[nodiscard]] constexpr std::string_view name_of(Enum value) {
  return names_of(value)[static_cast<std::size_t>(value)];
}

}  // namespace gyrod::settings
