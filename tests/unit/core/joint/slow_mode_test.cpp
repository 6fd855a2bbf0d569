// What is slow beyond what a window resolves: the fit's slow mode and the filters that are designed with it.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/joint/whittle_fit.hpp"
#include "core/signal/levinson.hpp"
#include "unit/core/joint/joint_support.hpp"

namespace gyrod::core {
namespace {

using testing::Signal;

// All power in the lowest bin: the process never changes. On the unit circle Levinson's recursion ends at order 0 and calls it white, with all its
// variance for a drive.
TEST(SlowMode, OfWhatNeverChangesIsNotTakenForWhite) {
  const WhittleFit fit(1024, 0.001);
  constexpr std::array<double, kModeOrder + 1> kConstant = {4.0, 4.0, 4.0, 4.0};
  const SpectralMode mode = fit.mode_of(kConstant, true);
  EXPECT_LT(mode.drive, 1e-6);
  EXPECT_TRUE(std::isfinite(ar_variance_gain(mode.a)));
  EXPECT_NEAR(mode.drive * ar_variance_gain(mode.a), 4.0, 1e-3);
}

// 30 deg/s within 20 s and 5 deg/s within 4 s at 250 Hz, in noise of 0.06 deg/s: 54 dB. All members can be designed, window by window.
TEST(SlowMode, OfStrongSlowMotionLeavesNoMemberWithoutAFilter) {
  Signal z = testing::times(testing::tone(8000, 0.0002), 30.0);
  z = testing::sum(z, testing::tone(8000, 0.001, 0.3), 5.0);
  z = testing::sum(z, testing::white_noise(8000, 1), 0.06);
  const testing::JointOutput out = testing::run_joint(z, core::white_noise(0.0036), 16);
  EXPECT_TRUE(out.usable);
  EXPECT_EQ(out.fallbacks, 0U);
}

// What leaks from the tapers' end over the noise would pass for motion, and the noise there would be kept: 0.0217 deg/s were left without
// prewhitening, 0.0166 with it.
TEST(SlowMode, OfStrongSlowMotionDoesNotHideWhatIsNoiseAboveIt) {
  Signal x = testing::times(testing::tone(8000, 0.0002), 30.0);
  x = testing::sum(x, testing::tone(8000, 0.001, 0.3), 5.0);
  const Signal z = testing::sum(x, testing::white_noise(8000, 1), 0.06);
  const testing::JointOutput out = testing::run_joint(z, core::white_noise(0.0036), 16);
  EXPECT_LT(testing::rms_difference(out.denoised, x, 2000, 7900), 0.018);
}

}  // namespace
}  // namespace gyrod::core
