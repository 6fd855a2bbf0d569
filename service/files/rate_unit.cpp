#include "files/rate_unit.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>

namespace gyrod::files {
namespace {

struct UnitNames {
  RateUnit unit = RateUnit::kRadps;
  std::array<std::string_view, 4> spellings;  // the first is the one gyrod writes
};

/// In the order of RateUnit.
constexpr std::array<UnitNames, 5> kUnits = {{
    {RateUnit::kRadps, {"radps", "rad_s", "rad/s", "rad/s"}},
    {RateUnit::kMradps, {"mradps", "mrad_s", "mrad/s", "mrad/s"}},
    {RateUnit::kDps, {"dps", "degps", "deg_s", "deg/s"}},
    {RateUnit::kMdps, {"mdps", "mdegps", "mdeg_s", "mdeg/s"}},
    {RateUnit::kDph, {"dph", "degph", "deg_h", "deg/h"}},
}};

constexpr double kHalfTurnDeg = 180.0;
constexpr double kMilliPerOne = 1000.0;
constexpr double kSecondsPerHour = 3600.0;

}  // namespace

std::optional<RateUnit> rate_unit_of(std::string_view spelling) noexcept {
  for (const auto& names : kUnits) {
    if (std::ranges::find(names.spellings, spelling) != names.spellings.end()) return names.unit;
  }
  return std::nullopt;
}

std::string_view spelling_of(RateUnit unit) noexcept {
  return kUnits[static_cast<std::size_t>(unit)].spellings.front();
}

std::string known_rate_units() {
  std::string list;
  for (const auto& names : kUnits) {
    if (!list.empty()) list += ", ";
    list += names.spellings.front();
  }
  return list;
}

double radps_per(RateUnit unit) noexcept {
  switch (unit) {
    case RateUnit::kRadps:
      return 1.0;
    case RateUnit::kMradps:
      return 1.0 / kMilliPerOne;
    case RateUnit::kDps:
      return std::numbers::pi / kHalfTurnDeg;
    case RateUnit::kMdps:
      return std::numbers::pi / (kHalfTurnDeg * kMilliPerOne);
    case RateUnit::kDph:
      return std::numbers::pi / (kHalfTurnDeg * kSecondsPerHour);
  }
  return 1.0;
}

double to_radps(double value, RateUnit unit) noexcept { return value * radps_per(unit); }

double from_radps(double rate_radps, RateUnit unit) noexcept { return rate_radps / radps_per(unit); }

}  // namespace gyrod::files
