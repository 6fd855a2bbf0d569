#include "monitor/sensor_exposition.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace gyrod::monitor {
namespace {

/// As the library writes: sixteen significant digits.
void append(std::string& text, double value) {
  if (std::isnan(value)) {
    text += "Nan";
  } else if (std::isinf(value)) {
    text += value < 0.0 ? "-Inf" : "+Inf";
  } else {
    constexpr int kDigits = std::numeric_limits<double>::max_digits10 - 1;
    constexpr double kWhole = 1e15;
    std::array<char, 32> digits{};
    char* const end = digits.data() + digits.size();
    // Most values are whole, which is told much faster.
    const bool whole = std::abs(value) < kWhole && std::trunc(value) == value && !std::signbit(value);
    const auto written = whole
                             ? std::to_chars(digits.data(), end, static_cast<std::uint64_t>(value))
                             : std::to_chars(digits.data(), end, value, std::chars_format::general, kDigits);
    text.append(digits.data(), written.ptr);
  }
}

/// As the format asks within quotes.
std::string escaped(const std::string& label) {
  std::string text;
  for (const char c : label) {
    if (c == '"' || c == '\\') text += '\\';
    text += c == '\n' ? "\\n" : std::string(1, c);
  }
  return text;
}

void append_series(std::string& text, const SensorMetric& metric, const std::string& label, const char* axis,
                   double value) {
  text += metric.name;
  text += "{sensor=\"";
  text += label;
  if (axis != nullptr) {
    text += "\",axis=\"";
    text += axis;
  }
  text += "\"} ";
  append(text, value);
  text += '\n';
}

}  // namespace

SensorExposition::SensorExposition(std::initializer_list<std::span<const SensorMetric>> groups) {
  for (const auto& group : groups) {
    for (const SensorMetric& metric : group) families_.push_back({&metric, {}});
  }
}

void SensorExposition::add(const stream::ChannelSnapshot& sensor) {
  const std::string label = escaped(sensor.sensor);
  for (Family& family : families_) {
    for (std::size_t axis = 0; axis < (family.metric->of_axis ? stream::kAxes : 1); ++axis) {
      const Value value = family.metric->value(sensor, axis);
      const char* const name = family.metric->of_axis ? stream::kAxisNames[axis] : nullptr;
      if (value) append_series(family.text, *family.metric, label, name, *value);
    }
  }
  ++sensors_;
}

void SensorExposition::append_to(std::string& text) const {
  for (const Family& family : families_) {
    const std::string name = family.metric->name;
    const bool counter = family.metric->type == prometheus::MetricType::Counter;
    text += "# HELP " + name + " " + family.metric->help + "\n";
    text += "# TYPE " + name + (counter ? " counter\n" : " gauge\n");
    text += family.text;
  }
}

}  // namespace gyrod::monitor
