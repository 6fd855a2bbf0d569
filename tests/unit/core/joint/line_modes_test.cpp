#include "core/joint/line_modes.hpp"

#include <array>

#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

/// What is motion of a broad mode and a narrow one of these powers, beside a line of power 4: {broad, narrow}.
std::array<double, 2> shares(double broad_power, double narrow_power) {
  SpectralMode broad{.drive = broad_power * 0.8};
  SpectralMode narrow{.drive = narrow_power * 0.01};
  std::array<ModeNearLine, 2> modes{{{&broad, broad_power}, {&narrow, narrow_power}}};
  share_with_line(4.0, modes);
  return {broad.share, narrow.share};
}

void expect_shares(double broad_power, double narrow_power, double broad, double narrow) {
  const auto [its_broad, its_narrow] = shares(broad_power, narrow_power);
  EXPECT_NEAR(its_broad, broad, 1e-12) << broad_power << ", " << narrow_power;
  EXPECT_NEAR(its_narrow, narrow, 1e-12) << broad_power << ", " << narrow_power;
}

// A quarter of 4 may be in modes: the narrow mode is asked first, then the broad one for what is left.
TEST(LineModes, AQuarterOfTheLinesPowerMayBeInTheNarrowestModes) {
  expect_shares(0.4, 0.6, 0.0, 0.0);
  expect_shares(2.0, 0.4, 1.0, 0.0);              // 0.6 left, and more than twice that is motion
  expect_shares(0.9, 0.4, 1.0 - 0.3 / 0.9, 0.0);  // 0.6 left, one and a half times that: half of it
  expect_shares(0.5, 2.0, 0.0, 1.0);              // twice 1 is motion, and leaves the 1
  expect_shares(3.0, 5.0, 1.0, 1.0);
}

}  // namespace
}  // namespace gyrod::core
