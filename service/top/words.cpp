#include "top/words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>

#include "stream/health.hpp"

namespace gyrod::top {
namespace {

constexpr int kGreen = 35;
constexpr int kBlue = 33;
constexpr int kAmber = 172;
constexpr int kRed = 196;
constexpr int kGrey = 245;

/// In the order of stream::Health; letters and colours are those of the live page.
constexpr std::array<StateLook, stream::kHealthStates> kLooks = {{{'O', kGreen},
                                                                  {'W', kBlue},
                                                                  {'G', kAmber},
                                                                  {'L', kAmber},
                                                                  {'D', kAmber},
                                                                  {'N', kRed},
                                                                  {'C', kRed},
                                                                  {'K', kRed},
                                                                  {'S', kGrey}}};

std::string with_decimals(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string with_digits(double value, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%#.*g", digits, value);
  return text.data();
}

}  // namespace

StateLook look_of(std::string_view health) noexcept {
  for (std::size_t n = 0; n < kLooks.size(); ++n) {
    if (stream::name_of(static_cast<stream::Health>(n)) == health) return kLooks[n];
  }
  return {'?', kGrey};
}

bool is_troubled(std::string_view health) noexcept {
  return health != stream::name_of(stream::Health::kOk) &&
         health != stream::name_of(stream::Health::kWarmingUp);
}

std::string_view name_of(RateUnit unit) noexcept { return unit == RateUnit::kDegPerS ? "deg/s" : "rad/s"; }

Figure in_unit(Figure radps, RateUnit unit) noexcept {
  constexpr double kDegPerRad = 180.0 / std::numbers::pi;
  if (!radps || unit == RateUnit::kRadPerS) return radps;
  return *radps * kDegPerRad;
}

std::string significant(Figure value, int digits) { return value ? with_digits(*value, digits) : "-"; }

std::string fixed(Figure value, int decimals) { return value ? with_decimals(*value, decimals) : "-"; }

std::string per_second(Figure value) {
  constexpr double kThousand = 1000.0;
  if (!value) return "-";
  if (*value >= kThousand * kThousand) return with_decimals(*value / (kThousand * kThousand), 2) + " M/s";
  if (*value >= kThousand) return with_decimals(*value / kThousand, 1) + " k/s";
  return with_decimals(*value, 0) + "/s";
}

std::string duration(Figure seconds) {
  constexpr double kMilli = 1e-3;
  if (!seconds) return "-";
  return *seconds < 1.0 ? with_digits(*seconds / kMilli, 3) + " ms" : with_digits(*seconds, 3) + " s";
}

std::string clock(double time_s) {
  constexpr double kDay_s = 86400.0;
  constexpr int kMinute_s = 60;
  constexpr int kHour_s = 3600;
  if (!std::isfinite(time_s)) return "--:--:--Z";
  const int s = static_cast<int>(time_s - kDay_s * std::floor(time_s / kDay_s));
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%02d:%02d:%02dZ", s / kHour_s, s % kHour_s / kMinute_s,
                s % kMinute_s);
  return text.data();
}

std::string age(double seconds) {
  constexpr std::uint64_t kMinute = 60;
  constexpr std::uint64_t kHour = 60 * kMinute;
  constexpr std::uint64_t kDay = 24 * kHour;
  constexpr double kMost = 1e12;
  const auto s = static_cast<std::uint64_t>(std::clamp(seconds, 0.0, kMost));
  const auto part = [](std::uint64_t n, const char* unit) { return std::to_string(n) + " " + unit; };
  if (s >= kDay) return part(s / kDay, "d ") + part(s % kDay / kHour, "h");
  if (s >= kHour) return part(s / kHour, "h ") + part(s % kHour / kMinute, "min");
  return s >= kMinute ? part(s / kMinute, "min") : part(s, "s");
}

}  // namespace gyrod::top
