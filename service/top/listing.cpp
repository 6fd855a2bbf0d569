#include "top/listing.hpp"

#include <algorithm>
#include <array>

#include "top/words.hpp"

namespace gyrod::top {
namespace {

constexpr std::size_t kColumns = 12;
using Row = std::array<std::string, kColumns>;

std::string states_of(const Sensor& sensor) {
  std::string states;
  for (const Axis& axis : sensor.axes) states += (states.empty() ? "" : ",") + axis.health;
  return states.empty() ? "-" : states;
}

Row row_of(const Sensor& sensor) {
  const Axis* axis = sensor.loudest();
  const Axis known = axis == nullptr ? Axis{} : *axis;
  const Figure lost = sensor.lost_share();
  constexpr double kPercent = 100.0;
  return {sensor.health,
          sensor.name,
          fixed(sensor.sample_rate_hz, 2),
          significant(in_unit(known.noise_in_radps, RateUnit::kDegPerS), 4),
          significant(in_unit(known.noise_out_radps, RateUnit::kDegPerS), 4),
          fixed(known.reduction_db, 2),
          fixed(lost ? Figure(kPercent * *lost) : lost, 3),
          std::to_string(sensor.received),
          std::to_string(sensor.published),
          std::to_string(sensor.rejected),
          std::to_string(sensor.missing),
          states_of(sensor)};
}

}  // namespace

std::string listing(const std::vector<Sensor>& sensors) {
  std::vector<Row> rows = {{"health", "sensor", "rate_hz", "noise_in_dps", "noise_out_dps", "reduction_db",
                            "lost_percent", "received", "published", "rejected", "missing", "axes"}};
  for (const Sensor& sensor : sensors) rows.push_back(row_of(sensor));
  std::array<std::size_t, kColumns> widths{};
  for (const Row& row : rows) {
    for (std::size_t n = 0; n < kColumns; ++n) widths[n] = std::max(widths[n], row[n].size());
  }
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t n = 0; n + 1 < kColumns; ++n)
      text += row[n] + std::string(widths[n] - row[n].size() + 1, ' ');
    text += row.back() + "\n";
  }
  return text;
}

bool all_well(const Status& status, const std::vector<Sensor>& sensors) {
  return status.ready &&
         std::ranges::none_of(sensors, [](const Sensor& sensor) { return is_troubled(sensor.health); });
}

}  // namespace gyrod::top
