// How often the significance rule is right, over many windows.
#include <array>

#include <gtest/gtest.h>

#include "denoiser_support.hpp"

namespace gyrod {
namespace {

using core::ImfClass;
using core::ImfFigures;
using core::ScreeningRule;
using core::WindowReport;
using namespace testing;

constexpr std::size_t kWindows = 2000;
constexpr std::size_t kFirstSeed = 2000000;  // none of the table's

WindowReport screened(std::span<const double> window) {
  return denoise(window, with_rule(ScreeningRule::kSignificance)).report;
}

bool outside(const ImfFigures& figures) {
  return figures.excess < figures.noise_excess_low || figures.excess > figures.noise_excess_high;
}

// 1 % is asked for. Of 2000 windows that is 20 +- 4.5 by chance; chi-squared is an approximation, best for the IMFs with many waves.
TEST(SignificanceRates, OfFalseAlarmsOnWhiteNoiseAreAsStatedAtEverySize) {
  for (const std::size_t size : {512U, 1024U, 2048U}) {
    std::array<double, 6> alarms{};
    for (std::size_t seed = 0; seed < kWindows; ++seed) {
      const WindowReport report = screened(white_noise(size, static_cast<unsigned>(kFirstSeed + seed)));
      for (std::size_t i = 0; i < alarms.size() && i < report.imf_count; ++i)
        alarms[i] += outside(report.imf[i]) ? 1.0 / kWindows : 0.0;
    }
    EXPECT_EQ(alarms[0], 0.0) << "IMF 1 is what the level is taken from";
    for (std::size_t i = 1; i < alarms.size(); ++i) {
      RecordProperty("imf" + std::to_string(i + 1) + "_of_" + std::to_string(size),
                     std::to_string(alarms[i]));
      EXPECT_GT(alarms[i], 0.003) << size << " samples, IMF " << i + 1;
      EXPECT_LT(alarms[i], 0.022) << size << " samples, IMF " << i + 1;
    }
  }
}

// A swing a hundred times the noise's size and slower than the window: the fast IMFs keep their class.
TEST(SignificanceRates, DoNotChangeWithASlowDriveBelow) {
  constexpr std::size_t kSize = 1024;
  std::size_t same = 0;
  for (std::size_t seed = 0; seed < 200; ++seed) {
    const auto noise = white_noise(kSize, static_cast<unsigned>(kFirstSeed + seed));
    const WindowReport still = screened(noise);
    const WindowReport moving = screened(sum(noise, tone(kSize, 1.0 / 2000.0), 100.0));
    bool equal = true;
    for (std::size_t i = 0; i < 4; ++i) equal = equal && still.imf[i].imf_class == moving.imf[i].imf_class;
    same += equal ? 1U : 0U;
  }
  RecordProperty("same_of_200", std::to_string(same));
  EXPECT_GE(same, 190U) << "a false alarm near the bound may come or go";
}

// A tone of amplitude 1: half of the noise's energy, nine times what noise has in IMF 4.
TEST(SignificanceRates, OfMissedTonesOfHalfTheNoisesEnergyAreSmall) {
  constexpr std::size_t kSize = 1024;
  std::size_t seen = 0;
  for (std::size_t seed = 0; seed < 200; ++seed) {
    const auto noise = white_noise(kSize, static_cast<unsigned>(kFirstSeed + seed));
    const WindowReport report = screened(sum(noise, tone(kSize, 1.0 / 30.0), 1.0));
    seen += report.j <= 4 ? 1U : 0U;
  }
  RecordProperty("seen_of_200", std::to_string(seen));
  EXPECT_GE(seen, 199U);
}

}  // namespace
}  // namespace gyrod
