#include "settings/unused_keys.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

#include <nlohmann/json.hpp>

#include "settings/dump.hpp"

namespace gyrod::settings {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 5> kOfPaper = {"denoise.scheme", "denoise.screening", "denoise.sifts",
                                                      "denoise.boundary", "denoise.max_ar_order"};
constexpr std::array<std::string_view, 4> kOfJoint = {"denoise.max_signal_hz", "denoise.stretch_windows",
                                                      "bus.topics.realtime", "bus.topics.realtime_batch"};

}  // namespace

std::vector<std::string> unused_keys(const Settings& settings) {
  const auto given = values_of(settings);
  const auto defaults = values_of({});
  const bool is_joint = settings.denoise.method == Method::kJoint;
  std::vector<std::string> lines;
  const auto note = [&](std::string_view key) {
    const json& value = given.find(key)->second;
    if (value == defaults.find(key)->second) return;
    lines.push_back(std::string(key) + " is " + value.dump() + ", which is for denoise.method \"" +
                    (is_joint ? "paper" : "joint") + "\"; it is \"" + (is_joint ? "joint" : "paper") + "\"");
  };
  if (is_joint) {
    std::ranges::for_each(kOfPaper, note);
    const std::string band = unused_band(settings.denoise.max_signal_hz, settings.engine.sample_rate_hz);
    if (!band.empty()) lines.push_back(band);
  } else {
    std::ranges::for_each(kOfJoint, note);
  }
  return lines;
}

std::string unused_band(double max_signal_hz, double sample_rate_hz) {
  const double nyquist_hz = 0.5 * sample_rate_hz;
  if (!(nyquist_hz > 0.0) || max_signal_hz < nyquist_hz) return "";
  std::ostringstream line;
  line << "denoise.max_signal_hz is " << max_signal_hz << "; at a sample rate of " << sample_rate_hz
       << " Hz there is nothing above " << nyquist_hz << " Hz";
  return line.str();
}

}  // namespace gyrod::settings
