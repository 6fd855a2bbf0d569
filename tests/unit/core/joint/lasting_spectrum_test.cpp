// The mean spectrum of a channel's windows, and what a member that is fitted to it finds.
#include "core/joint/lasting_spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "core/joint/joint_fit.hpp"
#include "core/joint/kalman_bank.hpp"
#include "support/allocation_counter.hpp"
#include "support/signals.hpp"
#include "unit/core/joint/joint_support.hpp"

namespace gyrod {
namespace {

using core::LastingSpectrum;
using testing::Signal;

using Bins = std::array<double, 3>;

Bins mean_of(const LastingSpectrum& lasting, double unit = 1.0) {
  Bins mean{};
  lasting.mean(unit, mean);
  return mean;
}

TEST(LastingSpectrum, IsTheMeanOfAllWindowsUntilLaterOnesCountMore) {
  LastingSpectrum lasting;
  lasting.observe(Bins{1.0, 2.0, 3.0}, 1.0, 1.0, 0.25);
  EXPECT_EQ(mean_of(lasting), (Bins{1.0, 2.0, 3.0}));
  lasting.observe(Bins{3.0, 2.0, 1.0}, 1.0, 1.0, 0.25);
  EXPECT_EQ(mean_of(lasting), (Bins{2.0, 2.0, 2.0}));
  lasting.observe(Bins{2.0, 2.0, 2.0}, 1.0, 1.0, 0.25);
  lasting.observe(Bins{6.0, 2.0, 2.0}, 1.0, 1.0, 0.25);
  EXPECT_NEAR(mean_of(lasting)[0], 3.0, 1e-15);
  lasting.observe(Bins{7.0, 2.0, 2.0}, 1.0, 1.0, 0.25);
  EXPECT_NEAR(mean_of(lasting)[0], 4.0, 1e-15) << "a quarter, not a fifth";
}

TEST(LastingSpectrum, ShortWindowsCountForLess) {
  LastingSpectrum lasting;
  lasting.observe(Bins{9.0, 0.0, 0.0}, 1.0, 0.01, 0.25);
  EXPECT_EQ(mean_of(lasting)[0], 9.0);
  lasting.observe(Bins{}, 1.0, 0.99, 0.25);
  EXPECT_NEAR(mean_of(lasting)[0], 0.09, 1e-15);
  for (int i = 0; i < 3; ++i) lasting.observe(Bins{}, 1.0, 1.0, 0.25);
  const double before = mean_of(lasting)[0];
  lasting.observe(Bins{}, 1.0, 0.04, 0.25);
  EXPECT_NEAR(mean_of(lasting)[0], 0.99 * before, 1e-15);
}

TEST(LastingSpectrum, IsInTheDatasUnit) {
  LastingSpectrum lasting;
  lasting.observe(Bins{1.0, 2.0, 3.0}, 4.0, 1.0, 0.5);
  EXPECT_EQ(mean_of(lasting, 2.0), (Bins{2.0, 4.0, 6.0}));
  core::ModeSet modes;
  modes.add({.a = {0.5}, .drive = 3.0, .variance = 4.0, .share = 0.25});
  lasting.keep(modes, 4.0);
  const core::ModeSet kept = lasting.modes(2.0);
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept.modes()[0].drive, 6.0);
  EXPECT_EQ(kept.modes()[0].variance, 8.0);
  EXPECT_EQ(kept.modes()[0].share, 1.0) << "what is motion is for every window to say";
}

// A gap makes a fast sensor's windows short again, and they grow. What was known stays, modes by cycles per sample above all.
TEST(LastingSpectrum, IsRestatedWhereWindowsBecomeLongerOrShorter) {
  LastingSpectrum lasting;
  core::ModeSet modes;
  modes.add({.drive = 3.0});
  lasting.observe(Bins{1.0, 2.0, 4.0}, 1.0, 1.0, 0.25);
  lasting.keep(modes, 1.0);
  // Between bins there are straight lines; a window has become a quarter of one, and the next counts in full.
  lasting.observe(std::array{3.0, 3.0, 3.0, 3.0, 3.0}, 1.0, 1.0, 0.25);
  std::array<double, 5> longer{};
  lasting.mean(1.0, longer);
  const std::array before{1.0, 1.5, 2.0, 3.0, 4.0};
  for (std::size_t k = 0; k < longer.size(); ++k)
    EXPECT_NEAR(longer[k], before[k] + 0.8 * (3.0 - before[k]), 1e-15) << k;
  EXPECT_EQ(lasting.modes(1.0).size(), 1U);
  // Back: means of a bin and, by half, of those beside it. A window and a quarter have been seen, and this one.
  lasting.observe(Bins{}, 1.0, 1.0, 0.25);
  const Bins shorter = mean_of(lasting);
  EXPECT_NEAR(shorter[0], 5.0 / 9.0 * (longer[0] + 0.5 * longer[1]) / 1.5, 1e-15);
  EXPECT_NEAR(shorter[1], 5.0 / 9.0 * (0.5 * longer[1] + longer[2] + 0.5 * longer[3]) / 2.0, 1e-15);
  EXPECT_NEAR(shorter[2], 5.0 / 9.0 * (longer[4] + 0.5 * longer[3]) / 1.5, 1e-15);
  EXPECT_EQ(lasting.modes(1.0).size(), 1U);
}

TEST(LastingSpectrum, AnOffsetStaysWhatItIsWhereWindowsChange) {
  for (const std::size_t other : {3U, 9U, 17U, 33U}) {
    LastingSpectrum lasting;
    lasting.observe(std::vector<double>(9, 2.0), 1.0, 1.0, 0.5);
    lasting.observe(std::vector<double>(other, 2.0), 1.0, 1.0, 0.5);
    std::vector<double> mean(other);
    lasting.mean(1.0, mean);
    for (const double power : mean) EXPECT_EQ(power, 2.0) << other;
  }
}

TEST(LastingSpectrum, StartsAnewWithBinsThatDoNotFit) {
  LastingSpectrum lasting;
  core::ModeSet modes;
  modes.add({});
  lasting.observe(Bins{1.0, 2.0, 3.0}, 1.0, 1.0, 0.5);
  lasting.keep(modes, 1.0);
  lasting.observe(std::vector{5.0, 6.0, 7.0, 8.0}, 1.0, 1.0, 0.5);
  std::array<double, 4> mean{};
  lasting.mean(1.0, mean);
  EXPECT_EQ(mean, (std::array{5.0, 6.0, 7.0, 8.0}));
  EXPECT_EQ(lasting.modes(1.0).size(), 0U);
}

TEST(LastingSpectrum, IsNotSpoiltForGood) {
  LastingSpectrum lasting;
  core::ModeSet modes;
  modes.add({.drive = std::numeric_limits<double>::infinity()});
  lasting.observe(Bins{1.0, std::numeric_limits<double>::max(), 3.0}, 2.0, 1.0, 0.5);
  lasting.keep(modes, 1.0);
  EXPECT_EQ(lasting.modes(1.0).size(), 0U);
  lasting.observe(Bins{4.0, 5.0, 6.0}, 1.0, 1.0, 0.5);
  EXPECT_EQ(mean_of(lasting), (Bins{4.0, 5.0, 6.0}));
}

TEST(LastingSpectrum, ForgetsAllButItsRoom) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "sanitizers bring their own heap";
  LastingSpectrum lasting;
  lasting.make_room(3);
  const auto before = testing::allocations();
  lasting.observe(Bins{1.0, 2.0, 3.0}, 1.0, 1.0, 0.5);
  lasting.forget();
  lasting.observe(Bins{7.0, 8.0, 9.0}, 1.0, 1.0, 0.5);
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_EQ(mean_of(lasting), (Bins{7.0, 8.0, 9.0}));
}

// Three orders of an engine, each of a twentieth of the noise's power, beside a swing.
TEST(LastingMember, FindsWhatOneWindowDoesNotShow) {
  constexpr std::size_t kSize = 6000;
  Signal truth = testing::times(testing::tone(kSize, 0.005), 2.0);
  for (const double cycles : {0.18, 0.225, 0.31})
    truth = testing::sum(truth, testing::tone(kSize, cycles), 0.3);
  const Signal z = testing::sum(truth, testing::white_noise(kSize, 4));
  const auto error = [&](const core::JointOptions& options) {
    return testing::denoised_error(truth, z, 2500, options);
  };
  core::JointOptions without;
  without.lasting_log_prior = -100.0;
  EXPECT_LT(error({}), 0.9 * error(without));
}

/// Of x[t-16], from 100 samples to 1024 after a gap, by windows of 1024 samples at the most; before it, they were of 4096.
/// @param with what models know when the gap ends
double error_after_a_gap(const Signal& truth, const Signal& z, core::JointModel with) {
  constexpr std::size_t kWindow = 1024;
  const std::size_t begin = z.size() - kWindow;
  core::JointFit fit(kWindow);
  core::KalmanBank bank({}, 16);
  bank.expect_noise(1.0);
  core::JointModel made;
  core::WindowReport report;
  double squares = 0.0;
  for (std::size_t t = 0; t < kWindow; ++t) {
    if (t >= 96 && t % 32 == 0) bank.use(made);
    if (t >= 64 && t % 32 == 0) {
      fit.fit(std::span(z).subspan(begin, t), core::white_noise(1.0), with, report);
      made = with;
    }
    const double error = bank.step(z[begin + t]).denoised.rate - truth[begin + t - 16];
    if (t >= 100) squares += error * error;
  }
  return std::sqrt(squares / static_cast<double>(kWindow - 100));
}

// 0.26 for 0.34: what has lasted for minutes does not have to be found anew.
TEST(LastingMember, OutlastsAGapThatMakesWindowsShortAgain) {
  constexpr std::size_t kWindow = 4096;
  constexpr std::size_t kSize = 24'000;
  Signal truth = testing::times(testing::tone(kSize, 0.005), 2.0);
  for (const double cycles : {0.18, 0.225, 0.31})
    truth = testing::sum(truth, testing::tone(kSize, cycles), 0.3);
  const Signal z = testing::sum(truth, testing::white_noise(kSize, 4));
  core::JointFit fit(kWindow);
  core::JointModel model;
  core::WindowReport report;
  for (std::size_t end = kWindow; end < kSize - 2048; end += 512)
    fit.fit(std::span(z).subspan(end - kWindow, kWindow), core::white_noise(1.0), model, report);
  core::JointModel forgetful = model;
  forgetful.lasting.forget();
  EXPECT_LT(error_after_a_gap(truth, z, model), 0.85 * error_after_a_gap(truth, z, forgetful));
}

// A fit that goes on may make a tone of the mode that was called slow.
TEST(LastingMember, CallsTheSlowestModeSlow) {
  constexpr std::size_t kWindow = 1024;
  constexpr std::array kCycles = {0.005, 0.2};
  const Signal motion = testing::sum(testing::tone(kWindow, kCycles[0]), testing::tone(kWindow, kCycles[1]));
  const Signal z = testing::sum(testing::times(motion, 3.0), testing::white_noise(kWindow, 4));
  core::JointFit fit(kWindow);
  core::JointModel model;
  core::WindowReport report;
  fit.fit(z, core::white_noise(1.0), model, report);
  core::ModeSet swapped = model.lasting.modes(1.0);
  ASSERT_GT(swapped.size(), 1U);
  for (core::SpectralMode& mode : swapped.modes()) mode.slow = !mode.slow;
  model.lasting.keep(swapped, 1.0);
  fit.fit(z, core::white_noise(1.0), model, report);
  const core::ModeSet after = model.lasting.modes(1.0);
  ASSERT_EQ(std::ranges::count_if(after.modes(), &core::SpectralMode::slow), 1);
  const core::SpectralMode& slow = *std::ranges::find_if(after.modes(), &core::SpectralMode::slow);
  const auto at = [&slow](double cycles) {
    return testing::spectrum_of(slow, 2.0 * std::numbers::pi * cycles);
  };
  EXPECT_GT(at(kCycles[0]), 100.0 * at(kCycles[1]));
}

}  // namespace
}  // namespace gyrod
