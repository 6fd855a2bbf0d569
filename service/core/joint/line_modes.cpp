#include "core/joint/line_modes.hpp"

#include <algorithm>

namespace gyrod::core {
namespace {

/// Of a line's power, what modes at its place may be of it.
constexpr double kMostRest = 0.25;

}  // namespace

void share_with_line(double line_power, std::span<ModeNearLine> modes) noexcept {
  // Innovation over variance, the spectral flatness: 0 for a line, 1 for white noise.
  std::ranges::sort(modes, {}, [](const ModeNearLine& near) { return near.mode->drive / near.power; });
  double left = kMostRest * line_power;
  for (const auto& [mode, power] : modes) {
    const double line = power > left ? left * std::max(2.0 - power / left, 0.0) : power;
    mode->share = 1.0 - line / power;
    left -= line;
  }
}

}  // namespace gyrod::core
