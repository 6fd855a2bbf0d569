// Which noise it is, and how many degrees of freedom that leaves.
#include "core/allan/degrees_of_freedom.hpp"

#include <gtest/gtest.h>

#include "allan_support.hpp"

namespace gyrod {
namespace {

using namespace testing;
using core::equivalent_degrees_of_freedom;
using core::PowerLaw;

// Approximations of Howe, Allan, Barnes, "Properties of signal sources and measurement methods", 35th AFCS, 1981,
// table 5.1; n is the number of phase points. Theirs are fits, said to be good to some per cent.
double published_white(double n, double m) {
  return (3.0 * (n - 1.0) / (2.0 * m) - 2.0 * (n - 2.0) / n) * 4.0 * m * m / (4.0 * m * m + 5.0);
}
double published_flicker(double n, double m) {
  return m < 2.0 ? 2.0 * (n - 2.0) * (n - 2.0) / (2.3 * n - 4.9) : 5.0 * n * n / (4.0 * m * (n + 3.0 * m));
}
double published_random_walk(double n, double m) {
  return (n - 2.0) / m * ((n - 1.0) * (n - 1.0) - 3.0 * m * (n - 1.0) + 4.0 * m * m) /
         ((n - 3.0) * (n - 3.0));
}
double published_quantization(double n, double m) { return (n + 1.0) * (n - 2.0 * m) / (2.0 * (n - m)); }

TEST(DegreesOfFreedom, AgreeWithThePublishedApproximations) {
  constexpr double kPhasePoints = 10'001.0;
  for (const std::size_t m : {1U, 4U, 16U, 100U, 400U, 1000U}) {
    const auto terms = static_cast<std::size_t>(kPhasePoints) - 2 * m;
    const auto edf = [&](PowerLaw noise) { return equivalent_degrees_of_freedom(noise, m, terms); };
    const auto size = static_cast<double>(m);
    EXPECT_NEAR(edf(PowerLaw::kWhite) / published_white(kPhasePoints, size), 1.0, 0.06) << m;
    EXPECT_NEAR(edf(PowerLaw::kQuantization) / published_quantization(kPhasePoints, size), 1.0, 0.06) << m;
    EXPECT_NEAR(edf(PowerLaw::kRandomWalk) / published_random_walk(kPhasePoints, size), 1.0, 0.12) << m;
    EXPECT_NEAR(edf(PowerLaw::kFlicker) / published_flicker(kPhasePoints, size), 1.0, 0.1) << m;
  }
}

// One square is one degree of freedom; squares of noise that is one single slow swing are no more.
TEST(DegreesOfFreedom, AreAtLeastOneAndAtMostTheTerms) {
  for (const PowerLaw noise :
       {PowerLaw::kQuantization, PowerLaw::kWhite, PowerLaw::kFlicker, PowerLaw::kRandomWalk}) {
    EXPECT_DOUBLE_EQ(equivalent_degrees_of_freedom(noise, 5, 1), 1.0);
    EXPECT_NEAR(equivalent_degrees_of_freedom(noise, 100'000, 2), 1.0,
                noise == PowerLaw::kQuantization ? 1.0 : 1e-4);
    for (const std::size_t m : {1U, 3U, 1000U}) {
      const double edf = equivalent_degrees_of_freedom(noise, m, 777);
      EXPECT_GE(edf, 1.0);
      EXPECT_LE(edf, 777.0);
    }
  }
}

// The step of large clusters against the full sum: m = 64 is summed in full, 65 in steps of its 64th.
TEST(DegreesOfFreedom, DoNotJumpWhereTheSumIsThinnedOut) {
  for (const PowerLaw noise : {PowerLaw::kWhite, PowerLaw::kFlicker, PowerLaw::kRandomWalk}) {
    const double full = equivalent_degrees_of_freedom(noise, 64, 64'000);
    const double thinned = equivalent_degrees_of_freedom(noise, 640, 640'000);
    EXPECT_NEAR(thinned / full, 1.0, 1e-9) << "the same sum in units of m";
    EXPECT_NEAR(equivalent_degrees_of_freedom(noise, 65, 65'000) / full, 1.0, 1e-3);
  }
}

PowerLaw identified(const Signal& rate, std::size_t m) {
  std::vector<double> sums(rate.size() + 1, 0.0);
  for (std::size_t n = 0; n < rate.size(); ++n) sums[n + 1] = sums[n] + rate[n];
  std::vector<double> work(rate.size());
  return core::identify_noise(sums, m, work);
}

// 1000 clusters: delta is off by 0.03, its limit 0.25 away.
TEST(NoiseIdentification, TellsWhiteQuantizationAndRandomWalk) {
  for (const std::size_t m : {1U, 10U, 100U}) {
    const std::size_t size = 1000 * m;
    EXPECT_EQ(identified(white_noise(size, 1), m), PowerLaw::kWhite) << m;
    EXPECT_EQ(identified(random_walk(size, 2), m), PowerLaw::kRandomWalk) << m;
    EXPECT_EQ(identified(differenced_noise(size, 3), m), PowerLaw::kQuantization) << m;
  }
}

TEST(NoiseIdentification, TakesARampForRandomWalkAndAConstantForWhite) {
  Signal ramp(300);
  for (std::size_t n = 0; n < ramp.size(); ++n) ramp[n] = static_cast<double>(n);
  EXPECT_EQ(identified(ramp, 3), PowerLaw::kRandomWalk);
  EXPECT_EQ(identified(Signal(300, 0.0), 3), PowerLaw::kWhite);
}

}  // namespace
}  // namespace gyrod
