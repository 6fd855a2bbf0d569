// The likelihood of white noise alone, and what it is compared with.
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "core/joint/whittle_fit.hpp"
#include "support/signals.hpp"

namespace gyrod::core {
namespace {

using testing::Signal;

constexpr std::size_t kLikelihoodTransform = 1024;
constexpr std::size_t kLikelihoodBins = kLikelihoodTransform / 2 + 1;
constexpr double kFrequencies = 512.0;  ///< bins, the ends counted half

// ln L of white noise alone: -sum (ln r + I / r), ends counted half.
TEST(WhittleLikelihood, OfNoiseIsTheClosedForm) {
  WhittleFit fit(kLikelihoodTransform, 0.001);
  fit.observe(Signal(kLikelihoodBins, 3.0), white_noise(2.0));
  EXPECT_NEAR(fit.log_likelihood({}), -(std::log(2.0) + 1.5) * kFrequencies, 1e-9);
}

TEST(WhittleLikelihood, ANewNoiseIsTakenUp) {
  WhittleFit fit(kLikelihoodTransform, 0.001);
  fit.observe(Signal(kLikelihoodBins, 3.0), white_noise(2.0));
  fit.observe(Signal(kLikelihoodBins, 3.0), white_noise(4.0));
  EXPECT_NEAR(fit.log_likelihood({}), -(std::log(4.0) + 0.75) * kFrequencies, 1e-9);
}

TEST(WhittleLikelihood, AnotherPeriodogramIsSeenBesideTheSameNoise) {
  WhittleFit fit(kLikelihoodTransform, 0.001);
  fit.observe(Signal(kLikelihoodBins, 3.0), white_noise(2.0));
  fit.observe(Signal(kLikelihoodBins, 5.0));
  EXPECT_NEAR(fit.log_likelihood({}), -(std::log(2.0) + 2.5) * kFrequencies, 1e-9);
}

}  // namespace
}  // namespace gyrod::core
