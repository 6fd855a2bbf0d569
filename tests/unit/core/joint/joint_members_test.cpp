// What the members of a model are made of: modes, the noise's line, and how hard both are driven.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "core/joint/joint_fit.hpp"
#include "core/noise/still_noise.hpp"
#include "core/signal/levinson.hpp"
#include "unit/core/joint/joint_support.hpp"
#include "unit/core/joint/line_support.hpp"

namespace gyrod {
namespace {

using core::FilterBlock;
using core::JointFit;
using core::JointModel;
using core::JointOptions;
using core::MemberKind;
using core::WindowReport;
using testing::Signal;

constexpr std::size_t kMembersWindow = 1024;

/// Broad shaking about 0.2 cycles per sample with this variance, over a slow swing.
Signal shaking(double power, unsigned seed) {
  const auto block = testing::oscillation(0.97, 2.0 * std::numbers::pi * 0.2, 1.0);
  const Signal shape = testing::autoregressive(std::array{block.a[0], block.a[1]}, kMembersWindow, seed);
  const double gain = core::ar_variance_gain(std::array{block.a[0], block.a[1]});
  return testing::sum(testing::times(shape, std::sqrt(power / gain)), testing::tone(kMembersWindow, 0.01),
                      2.0);
}

struct Made {
  JointModel model;
  WindowReport report;
};

Made made_of(const Signal& z, const core::NoiseModel& noise, const JointOptions& options = {}) {
  JointFit fit(kMembersWindow, options);
  Made made;
  fit.fit(z, noise, made.model, made.report);
  return made;
}

std::span<const FilterBlock> blocks_of(const Made& made, MemberKind kind) {
  return made.model.member(kind).blocks.all();
}

double variance_of(const FilterBlock& block) {
  return block.drive * core::ar_variance_gain(std::span(block.a).first(block.order));
}

/// Shaking about the line of the noise, which is believed and is not there. What reaches the line at all may be of it.
Made beside_a_line(const JointOptions& options = {}) {
  JointOptions reaching = options;
  reaching.line.reach = 100.0;
  const Signal z = testing::sum(shaking(9.0, 1), testing::white_noise(kMembersWindow, 1), 1.0);
  return made_of(z, testing::noise_with_line(0.2, 2.0), reaching);
}

/// What drives each of the member's modes in parts of what drives the full member's, to twelve digits: {the slow one's, all others'}.
std::array<double, 2> drives_of(const Made& made, MemberKind kind) {
  const auto full = blocks_of(made, MemberKind::kFull);
  const auto blocks = blocks_of(made, kind);
  double slow = 0.0;
  double others = 0.0;
  for (std::size_t i = 0; i < full.size() && full[i].order == core::kModeOrder; ++i) {
    EXPECT_EQ(blocks[i].a, full[i].a);
    const double ratio = std::round(1e12 * blocks[i].drive / full[i].drive) / 1e12;
    const bool last = i + 1 == full.size() || full[i + 1].order != core::kModeOrder;
    EXPECT_TRUE(last || i == 0 || ratio == others) << i;
    (last ? slow : others) = ratio;
  }
  return {slow, others};
}

// Shaking that is over for half of the window: the tapers of the full set hardly see it, those of the pruned one do.
TEST(JointMembers, ThePrunedOnesAreThoseOfTheWholeWindow) {
  Signal z = shaking(4.0, 3);
  const Signal noise = testing::white_noise(kMembersWindow, 8);
  for (std::size_t n = 0; n < z.size(); ++n) z[n] = (n < z.size() / 2 ? z[n] : 0.0) + noise[n];
  const Made made = made_of(z, core::white_noise(1.0));
  const auto predicted = [&made](MemberKind kind) { return made.model.member(kind).prediction_variance; };
  EXPECT_GT(predicted(MemberKind::kPruned), 1.5 * predicted(MemberKind::kFull));
  JointOptions alike;
  alike.pruned_recency = alike.recency;
  const Made newest = made_of(z, core::white_noise(1.0), alike);
  EXPECT_LT(newest.model.member(MemberKind::kPruned).prediction_variance, predicted(MemberKind::kFull) * 1.1);
}

// By docs/joint.md, "Members": 4 times and a tenth; the slow mode, which comes last where there is no tone, alike in all.
TEST(JointMembers, AreDrivenHarderAndLess) {
  const Made made = beside_a_line();
  EXPECT_EQ(drives_of(made, MemberKind::kRough), (std::array{1.0, 4.0}));
  EXPECT_EQ(drives_of(made, MemberKind::kStill), (std::array{1.0, 0.1}));
}

// Of a mode that is motion to the part f, f (1 - f) of its variance is not told by the sum; in each member that of the mode as it is driven there. The
// fit takes the variance from the bins of the spectrum: 1 %.
TEST(JointMembers, KnowWhatASharedModeDoesNotTell) {
  JointOptions options;
  options.pole_factor = 1.0;
  const Made made = beside_a_line(options);
  std::size_t shared = 0;
  for (const MemberKind kind : {MemberKind::kFull, MemberKind::kRough, MemberKind::kStill}) {
    for (const FilterBlock& block : blocks_of(made, kind)) {
      const double expected = block.signal * (1.0 - block.signal) * variance_of(block);
      EXPECT_NEAR(block.apart, expected, 0.01 * expected);
      shared += expected > 0.0 ? 1U : 0U;
    }
  }
  EXPECT_EQ(shared, 3U) << "one in each";
}

// The roots, not the coefficients: a_i is multiplied by the factor's i-th power.
TEST(JointMembers, HaveTheirModesRootsPulledIn) {
  JointOptions options;
  options.pole_factor = 1.0;
  const Made made = beside_a_line(options);
  options.pole_factor = 0.9;
  const Made pulled = beside_a_line(options);
  const auto plain = blocks_of(made, MemberKind::kFull);
  for (std::size_t b = 0; b < plain.size(); ++b) {
    for (std::size_t i = 0; i < plain[b].order; ++i) {
      const double factor =
          plain[b].order == core::kModeOrder ? std::pow(0.9, static_cast<double>(i + 1)) : 1.0;
      EXPECT_NEAR(blocks_of(pulled, MemberKind::kFull)[b].a[i], factor * plain[b].a[i], 1e-12) << b;
    }
  }
}

/// White noise of variance 1 and what an AR(1) of 0.5 makes of such: a sensor's colour, known as well as rest tells it.
core::NoiseModel coloured_noise() {
  core::NoiseModel model = core::white_noise(1.0);
  model.colour_order = 1;
  model.colour = {0.5};
  model.colour_variance = 1.0;
  return core::scaled(model, core::kNoiseMargin);
}

// Of a swell above the noise, slow with three real roots at 0.98, EM needs many iterations to find where it ends: a thousand leave 0.196, those that
// there are 0.217, and 5 after pruning 0.228.
TEST(JointMembers, KnowWhereSlowMotionEnds) {
  constexpr std::array kSwell = {2.94, -2.8812, 0.941192};
  const Signal swell = testing::autoregressive(kSwell, kMembersWindow, 4);
  const Signal z = testing::sum(testing::times(swell, 0.01), testing::white_noise(kMembersWindow, 4));
  const auto left = [&z](const JointOptions& options) {
    return made_of(z, coloured_noise(), options).model.member(MemberKind::kPruned).error_variance(16);
  };
  JointOptions patient;
  patient.final_iterations = 1000;
  EXPECT_LT(left({}), 1.13 * left(patient));
}

/// Of windows of such noise, with `power` of shaking added; sorted.
std::vector<double> full_priors(double power) {
  constexpr std::array kColour = {0.5};
  constexpr unsigned kWindows = 100;
  std::vector<double> priors;
  for (unsigned seed = 1; seed <= kWindows; ++seed) {
    Signal z = testing::sum(testing::white_noise(kMembersWindow, seed),
                            testing::autoregressive(kColour, kMembersWindow, seed + kWindows));
    if (power > 0.0) z = testing::sum(z, shaking(power, seed + 2 * kWindows));
    priors.push_back(made_of(z, coloured_noise()).model.full_prior);
  }
  std::ranges::sort(priors);
  return priors;
}

// What the full set makes of noise seldom buys what would pay for it; shaking as strong as the noise leaves more than the slow mode after pruning.
// The shares were measured: 0.25, the least, in 90 of 100 windows, 1 in 5.
TEST(JointMembers, OfTheFullSetCountLittleWhereItFindsOnlyNoise) {
  const auto still = full_priors(0.0);
  EXPECT_EQ(still[still.size() * 17 / 20], JointOptions{}.least_full_prior);
  EXPECT_LT(still[still.size() * 9 / 10], 1.0);
  EXPECT_EQ(full_priors(2.0).front(), 1.0);
}

// e^(g/2) by the likelihoods: a window that has its evidence priced 2 ln 3 higher has a third of the prior.
TEST(JointMembers, OfTheFullSetCountByTheirLikelihood) {
  const Signal z = testing::white_noise(kMembersWindow, 5);
  JointOptions options;
  options.least_full_prior = 0.0;
  options.full_evidence = 60.0;
  const double prior = made_of(z, core::white_noise(1.0), options).model.full_prior;
  options.full_evidence += 2.0 * std::log(3.0);
  ASSERT_LT(prior, 1.0);
  EXPECT_NEAR(made_of(z, core::white_noise(1.0), options).model.full_prior, prior / 3.0, 1e-12 * prior);
}

// Modes are counted beside the slowest, which the full one has, too.
TEST(JointMembers, AreCountedByTheFullOnesModes) {
  const Made made = made_of(testing::sum(shaking(9.0, 1), testing::white_noise(kMembersWindow, 1), 1.0),
                            core::white_noise(1.0));
  const auto modes_in = [&made](MemberKind kind) {
    const auto count = std::ranges::count(blocks_of(made, kind), core::kModeOrder, &FilterBlock::order);
    return static_cast<std::size_t>(count);
  };
  EXPECT_EQ(made.report.modes + 1, modes_in(MemberKind::kFull));
  EXPECT_LT(modes_in(MemberKind::kPruned), made.report.modes + 1);
}

// AR(1) noise with pole 0.9 has 1 / (1 - 0.9)^2 of its drive where it is slow, and 1 / (1 - 0.9^2) in all.
TEST(JointMembers, CompareSlowMotionWithTheNoiseWhereThatIsSlow) {
  core::NoiseModel noise;
  noise.white_variance = 0.5;
  noise.colour_order = 1;
  noise.colour[0] = 0.9;
  noise.colour_variance = 0.1;
  const Signal still =
      testing::times(testing::autoregressive(std::array{0.9}, kMembersWindow, 5), std::sqrt(0.1));
  const Made made =
      made_of(testing::sum(still, testing::white_noise(kMembersWindow, 6), std::sqrt(0.5)), noise);
  const double slow = 0.5 + 0.1 / (0.1 * 0.1);
  const double all = 0.5 + 0.1 / (1.0 - 0.9 * 0.9);
  EXPECT_NEAR(made.model.slow_noise_variance / made.model.noise_variance, slow / all, 1e-9);
}

// The noise's line, last of the blocks, is as strong as it was believed, as much more as the windows show all of the noise to be, and as much less where that is
// less than half.
TEST(JointMembers, ExpectTheNoisesLineAtItsLevel) {
  const core::NoiseModel noise = testing::noise_with_line(0.2, 2.0);
  const core::NoiseModel resonance = testing::noise_with_resonance(0.2, 2.0);
  const Signal line = testing::autoregressive(resonance.colour_coefficients(), kMembersWindow, 2);
  const Signal z =
      testing::sum(testing::white_noise(kMembersWindow, 3), line, std::sqrt(resonance.colour_variance));
  for (const double scale : {0.3, 0.6, 0.9, 1.3}) {
    JointFit fit(kMembersWindow);
    Made made;
    for (std::size_t hop = 0; hop < 40; ++hop)
      fit.fit(testing::times(z, scale), noise, made.model, made.report);
    const double level = made.model.noise.level();
    const FilterBlock& block = blocks_of(made, MemberKind::kFull).back();
    ASSERT_EQ(block.order, 2U);
    ASSERT_EQ(level < 0.5, scale < 0.7);
    ASSERT_EQ(level < 1.0, scale < 1.0);
    const double believed = made.model.lines[0].line({}).power;
    EXPECT_NEAR(variance_of(block), believed * (scale < 0.7 ? level : std::max(level, 1.0)), 1e-9) << scale;
  }
}

// A tone that is slower than 128 samples a period and still beyond the signal band would be lost in the slow mode, which cannot predict it.
TEST(JointMembers, HaveAModeForWhatIsSlowAndBeyondTheSignalBand) {
  const Signal tone = testing::times(testing::tone(kMembersWindow, 0.006), 4.0);
  const Signal z = testing::sum(tone, testing::white_noise(kMembersWindow, 4), 0.1);
  const auto class_of_it = [&z](double max_signal_cycles) {
    JointFit fit(kMembersWindow);
    fit.set_max_signal(max_signal_cycles);
    Made made;
    fit.fit(z, core::white_noise(0.01), made.model, made.report);
    const auto& imf = made.report.imf;
    const auto loudest =
        std::max_element(imf.begin(), imf.begin() + static_cast<std::ptrdiff_t>(made.report.imf_count),
                         [](const auto& a, const auto& b) { return a.energy < b.energy; });
    EXPECT_NEAR(loudest->mean_period_samples, 1.0 / 0.006, 0.1 / 0.006);
    return loudest->imf_class;
  };
  EXPECT_EQ(class_of_it(0.5), core::ImfClass::kSignal);
  EXPECT_EQ(class_of_it(0.003), core::ImfClass::kMixed);
}

}  // namespace
}  // namespace gyrod
