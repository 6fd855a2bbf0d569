// A mode from autocovariances.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/joint/whittle_fit.hpp"

namespace gyrod::core {
namespace {

constexpr double kModeBandwidth = 0.01;
/// Those of an AR(1) of pole 0.9 and variance 1.
constexpr std::array<double, kModeOrder + 1> kOfAnAr1 = {1.0, 0.9, 0.81, 0.729};

// The slow mode is what it is: an AR(1) again, driven by 1 - 0.9^2, but for a width of 1e-5 cycles: (2 pi 1e-5)^2 / 2 = 2e-9 in r_1.
TEST(WhittleMode, IsTheProcessThatHasTheAutocovariancesWhereItIsSlow) {
  const SpectralMode mode = WhittleFit(256, kModeBandwidth).mode_of(kOfAnAr1, true);
  EXPECT_TRUE(mode.slow);
  EXPECT_NEAR(mode.a[0], 0.9, 1e-7);
  EXPECT_NEAR(mode.a[1], 0.0, 1e-7);
  EXPECT_NEAR(mode.a[2], 0.0, 1e-7);
  EXPECT_NEAR(mode.drive, 0.19, 1e-7);
}

// Another is made wider by a Gaussian of the bandwidth: r_l exp(-(2 pi b l)^2 / 2), put into the Yule-Walker equations.
TEST(WhittleMode, IsNoNarrowerThanTheBandwidthWhereItIsNot) {
  const SpectralMode mode = WhittleFit(256, kModeBandwidth).mode_of(kOfAnAr1, false);
  EXPECT_FALSE(mode.slow);
  const auto r = [](int lag) {
    const double angle = 2.0 * std::numbers::pi * kModeBandwidth * lag;
    return kOfAnAr1[static_cast<std::size_t>(std::abs(lag))] * std::exp(-0.5 * angle * angle);
  };
  for (int lag = 0; lag <= static_cast<int>(kModeOrder); ++lag) {
    double sum = lag == 0 ? mode.drive : 0.0;
    for (int i = 1; i <= static_cast<int>(kModeOrder); ++i)
      sum += mode.a[static_cast<std::size_t>(i - 1)] * r(lag - i);
    EXPECT_NEAR(sum, r(lag), 1e-12) << lag;
  }
}

// Of a line L beside white noise of 1 that a window of 1 does not have, e = sum (L - (L / M)^2 (M - 1)) / sum L is expected to be there, M = L + 1.
TEST(WhittleMode, OfALineThatIsNotThereLittleIsExplained) {
  const SpectralMode line{.a = {2.0 * 0.97 * std::cos(2.0), -0.97 * 0.97, 0.0}, .drive = 0.15};
  WhittleFit fit(256, kModeBandwidth);
  const std::vector<double> window(129, 1.0);
  fit.observe(window, core::white_noise(1.0), std::span(&line, 1));
  double expected = 0.0;
  double all = 0.0;
  for (const double M : fit.noise()) {
    const double L = M - 1.0;
    expected += L - L / M * L / M * (M - 1.0);
    all += L;
  }
  const auto explained = fit.explained(ModeSet{});
  for (std::size_t k = 0; k < window.size(); ++k)
    EXPECT_NEAR(explained[k], expected / all * (fit.noise()[k] - 1.0), 1e-9) << k;
}

/// A turn that is slower than a bin is wide, in white noise of 1: so much in the lowest bin, a tenth of that in the next and so on.
std::vector<double> window_of_a_slow_turn(double power) {
  std::vector<double> window(513, 1.0);
  for (std::size_t k = 0; k < 6; ++k) window[k] += power * std::pow(0.1, static_cast<double>(k));
  return window;
}

// Either of two modes at frequency 0 may be what is there. With poles much narrower than a bin each would be given more of it than there is, by every iteration
// again: 50 times in this window of 1e3, 1e7 times in one of a drive.
TEST(WhittleMode, TwoAtFrequencyZeroShareWhatIsThere) {
  for (const double power : {1e2, 1e3, 1e4, 1e5}) {
    const std::vector<double> window = window_of_a_slow_turn(power);
    WhittleFit fit(1024, 0.001);
    fit.observe(window, core::white_noise(1.0));
    const std::array<double, kModeOrder + 1> slow = {1.0, 0.99999, 0.99996, 0.99991};
    ModeSet modes;
    modes.add(fit.mode_of(slow, false));
    modes.add(fit.mode_of(slow, true));
    fit.iterate(modes, 60);
    double observed = 0.0;
    for (const double bin : window) observed += 2.0 * bin / 1024.0;
    for (const SpectralMode& mode : modes.modes()) EXPECT_LT(mode.variance, 2.0 * observed) << power;
  }
}

}  // namespace
}  // namespace gyrod::core
