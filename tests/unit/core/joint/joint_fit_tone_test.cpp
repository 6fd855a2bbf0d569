// What a report says of a window: narrow tones, which of them are told and what the members make of them; whether modes are noise.
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "core/joint/joint_fit.hpp"
#include "support/signals.hpp"
#include "unit/core/joint/line_support.hpp"

namespace gyrod {
namespace {

using core::JointFit;
using core::JointModel;
using core::WindowReport;
using testing::Signal;

constexpr std::size_t kToneWindow = 1024;

// A tone of 0.45 in this noise of deviation 1 stands out by 14 times: worth a mode, but not a word.
TEST(JointFitTone, IsReportedWhenItIsSure) {
  const Signal noise = testing::white_noise(kToneWindow, 1);
  const auto reported = [&noise](double amplitude) {
    JointFit fit(kToneWindow);
    JointModel model;
    WindowReport report;
    fit.fit(testing::sum(noise, testing::tone(kToneWindow, 0.225), amplitude), core::white_noise(1.0), model,
            report);
    return report;
  };
  EXPECT_NEAR(reported(1.0).tone_frequency_cycles, 0.225, 0.5 / kToneWindow);
  EXPECT_NEAR(reported(1.0).tone_amplitude, 1.0, 0.15);
  EXPECT_EQ(reported(0.45).tone_amplitude, 0.0);
  EXPECT_EQ(reported(0.0).tone_amplitude, 0.0);
}

// A line of the sensor's noise is no tone, though it stands out 100 times; a tone beside it is one.
TEST(JointFitTone, IsNotTheLineOfTheNoise) {
  const core::NoiseModel noise = testing::noise_with_line(0.2, 3.0);
  const Signal shape = testing::autoregressive(noise.colour_coefficients(), 8 * kToneWindow, 2);
  const Signal line = testing::times(shape, std::sqrt(noise.colour_variance));
  const auto reported = [&](double amplitude) {
    JointFit fit(kToneWindow);
    JointModel model;
    WindowReport report;
    for (std::size_t first = 0; first + kToneWindow <= line.size(); first += 32) {
      Signal z(line.begin() + static_cast<std::ptrdiff_t>(first),
               line.begin() + static_cast<std::ptrdiff_t>(first + kToneWindow));
      z = testing::sum(z, testing::white_noise(kToneWindow, static_cast<unsigned>(first)));
      fit.fit(testing::sum(z, testing::tone(kToneWindow, 0.3), amplitude), noise, model, report);
    }
    return report;
  };
  EXPECT_EQ(reported(0.0).tone_amplitude, 0.0);
  EXPECT_NEAR(reported(1.0).tone_frequency_cycles, 0.3, 0.5 / kToneWindow);
  EXPECT_NEAR(reported(1.0).tone_amplitude, 1.0, 0.2);
}

// With its drive divided by 16 the tone would be all but given up by the still member: its innovations would have 0.64 of the variance.
TEST(JointFitTone, IsDoubtedByNoMember) {
  const Signal tone = testing::times(testing::tone(kToneWindow, 0.225), 3.0);
  JointFit fit(kToneWindow);
  JointModel model;
  WindowReport report;
  fit.fit(testing::sum(tone, testing::white_noise(kToneWindow, 1), 0.3), core::white_noise(0.09), model,
          report);
  const double full = model.member(core::MemberKind::kFull).innovation_variance;
  EXPECT_GT(model.member(core::MemberKind::kStill).innovation_variance, 0.72 * full);
}

// Whatever the rule: one IMF of white noise in a hundred lies outside the band by chance, and a swing far beyond it.
TEST(JointFitReport, SaysWhetherEnergiesAreThoseOfNoise) {
  core::JointOptions options;
  for (const int sifts : {10, 9}) {
    options.emd.sifts = sifts;
    core::JointFit fit(1024, options);
    core::JointModel model;
    core::WindowReport report;
    fit.fit(testing::sum(testing::times(testing::tone(1024, 0.01), 2.0), testing::white_noise(1024, 3), 0.3),
            core::white_noise(0.09), model, report);
    const core::ImfFigures& first = report.imf[0];
    if (sifts == 9) {
      EXPECT_EQ(first.noise_excess_high, 0.0) << "the tables are those of ten";
      continue;
    }
    EXPECT_GT(first.excess, first.noise_excess_low);
    EXPECT_LT(first.excess, first.noise_excess_high);
    EXPECT_GT(first.noise_probability, 0.01);
    const auto swing = std::ranges::max_element(report.imf, {}, &core::ImfFigures::energy);
    EXPECT_GT(swing->excess, swing->noise_excess_high);
    EXPECT_LT(swing->noise_probability, 1e-6);
  }
}

}  // namespace
}  // namespace gyrod
