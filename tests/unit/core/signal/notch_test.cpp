#include "core/signal/notch.hpp"

#include <cmath>
#include <cstddef>
#include <span>

#include <gtest/gtest.h>

#include "support/signals.hpp"

namespace gyrod::core {
namespace {

using testing::Signal;

constexpr std::size_t kSize = 1024;
constexpr double kHalfWidth = 0.005;

/// Root mean square of the middle half.
double rms(const Signal& x) {
  double squares = 0.0;
  for (std::size_t n = kSize / 4; n < 3 * kSize / 4; ++n) squares += x[n] * x[n];
  return std::sqrt(squares / (0.5 * kSize));
}

Signal notched(Signal x, double cycles = 0.2) {
  notch(x, cycles, kHalfWidth);
  return x;
}

TEST(Notch, TakesATonesPowerWhereItStands) {
  EXPECT_LT(rms(notched(testing::tone(kSize, 0.2, 0.7))), 1e-3 * rms(testing::tone(kSize, 0.2, 0.7)));
}

// |z - z0|^2 / |z - r z0|^2 near the zero is d^2 / (d^2 + h^2) with d the distance in frequency: one half at d = h, and of two passes a quarter, as power
// of amplitude a quarter is the square of one half.
TEST(Notch, LeavesAQuarterOfThePowerHalfAWidthAway) {
  const Signal near = testing::tone(kSize, 0.2 + kHalfWidth);
  EXPECT_NEAR(rms(notched(near)) / rms(near), 0.5, 0.05);
}

TEST(Notch, LeavesWhatIsFarAwayInSizeAndTime) {
  const Signal motion = testing::tone(kSize, 0.1, 0.3);
  EXPECT_LT(rms(testing::sum(notched(motion), motion, -1.0)), 0.07 * rms(motion));
  const Signal constant(kSize, 3.0);
  EXPECT_NEAR(notched(constant)[kSize / 2], 3.0, 0.2);
}

// There is no before and after: the same of a reversed window, but for where it starts from nothing.
TEST(Notch, TurnsWithTime) {
  const Signal x = testing::white_noise(kSize, 4);
  const Signal there = notched(x);
  const Signal back = testing::reversed(notched(testing::reversed(x)));
  EXPECT_LT(rms(testing::sum(there, back, -1.0)), 1e-3);
}

TEST(Notch, OfNothingIsNothing) {
  notch({}, 0.2, kHalfWidth);
  Signal one(1, 2.0);
  notch(one, 0.2, kHalfWidth);
  EXPECT_EQ(one[0], 2.0) << "one sample says nothing of a tone";
}

}  // namespace
}  // namespace gyrod::core
