// The filter of ARMA models against that of AR models, closed forms, and what a matched filter must leave.
#include "core/denoise/arma_kalman.hpp"

#include <array>

#include <gtest/gtest.h>

#include "core/denoise/ar_kalman.hpp"
#include "core/denoise/whiteness.hpp"
#include "core/signal/autocorrelation.hpp"
#include "core/signal/moments.hpp"
#include "support/arma_process.hpp"

namespace gyrod {
namespace {

using core::ArmaKalman;
using core::ArmaModel;
using namespace testing;

ArmaModel model_of(const ArmaProcess& process) {
  ArmaModel model;
  model.status = core::ArStatus::kFitted;
  model.p = process.p();
  model.q = process.q();
  std::ranges::copy(process.a, model.a.begin());
  std::ranges::copy(process.b, model.b.begin());
  model.innovation_variance = 1.0;
  return model;
}

// Harvey's form and the companion form are two bases of one filter. They start differently; after 400 samples that is forgotten.
TEST(ArmaKalman, OfAnArModelIsTheFilterOfArKalman) {
  for (const std::vector<double>& a :
       {std::vector{0.9}, std::vector{1.2, -0.5}, std::vector{2.2, -2.4, 1.4, -0.5}}) {
    const Signal measured = sum(autoregressive(a, 500, 1), white_noise(500, 2), 2.0);
    ArmaKalman kalman;
    core::ArKalman reference;
    ASSERT_TRUE(kalman.design(model_of({a, {}}), 1.0, 4.0));
    ASSERT_TRUE(reference.design(a, 1.0, 4.0));
    EXPECT_NEAR(kalman.innovation_variance(), reference.innovation_variance(), 1e-11);
    EXPECT_NEAR(kalman.error_variance(), reference.error_variance(), 1e-11);
    Signal filtered = measured;
    Signal expected = measured;
    kalman.filter(filtered);
    reference.filter(expected);
    const Signal difference = sum(filtered, expected, -1.0);
    EXPECT_LE(peak(std::span(difference).subspan(400)), 1e-11 * peak(measured));
  }
}

// Nothing is corrected where the model explains everything: identity, whatever the state it begins in.
TEST(ArmaKalman, ReturnsWhatTheModelPredictsWithoutNoise) {
  const double radius = 0.9999;
  const double c = 2.0 * radius * std::cos(2.0 * std::numbers::pi / 150.0);
  Signal z = {3.0, 2.5};
  while (z.size() < 2000) z.push_back(c * z[z.size() - 1] - radius * radius * z[z.size() - 2]);
  const Signal expected = z;
  ArmaKalman kalman;
  ASSERT_TRUE(kalman.design(model_of({{c, -radius * radius}, {}}), 1e-6, 1.0));
  kalman.filter(z);
  EXPECT_LE(peak(sum(z, expected, -1.0)), 1e-9 * peak(expected));
}

// A level that wanders little, seen in white noise of the model's own (MA part) and of the sensor: what the first samples are off by
// must not be carried on. With a start at the first sample as measured the mean below is 0.21.
TEST(ArmaKalman, DoesNotCarryTheFirstSamplesNoiseOn) {
  Signal z = white_noise(20000, 5);
  z[0] = 3.0;
  z[1] = 3.0;
  ArmaKalman kalman;
  ASSERT_TRUE(kalman.design(model_of({{0.9999}, {-0.995}}), 1.0, 1.0));
  kalman.filter(z);
  const std::span<const double> head = std::span(z).subspan(10, 2000);
  EXPECT_NEAR(core::mean(head), 0.0, 5.0 / std::sqrt(2000.0)) << "five standard errors of the noise's mean";
}

// White noise in white noise: X = q, K = q / (q + r), and the output is K z.
TEST(ArmaKalman, OfWhiteNoiseIsAFactor) {
  ArmaKalman kalman;
  ASSERT_TRUE(kalman.design(model_of({{}, {}}), 1.0, 3.0));
  Signal z = white_noise(100, 1);
  const Signal expected = times(z, 0.25);
  kalman.filter(z);
  EXPECT_LE(peak(sum(z, expected, -1.0)), 1e-15);
}

// MA(1) in white noise is an MA(1) again: z = e[k] + c e[k-1], (1 + c^2) s = q (1 + b^2) + r, c s = q b, |c| < 1; s is the innovation's
// variance.
TEST(ArmaKalman, InnovationVarianceOfMa1IsTheClosedForm) {
  for (const double b : {-0.9, 0.2, 0.6}) {
    const double q = 1.0;
    const double r = 0.5;
    const double ratio = (q * (1.0 + b * b) + r) / (q * b);  // c + 1 / c
    const double root = std::sqrt(ratio * ratio - 4.0);
    const double c = ratio > 0.0 ? 0.5 * (ratio - root) : 0.5 * (ratio + root);
    ArmaKalman kalman;
    ASSERT_TRUE(kalman.design(model_of({{}, {b}}), q, r));
    EXPECT_NEAR(kalman.innovation_variance(), q * b / c, 1e-12) << b;
  }
}

class MatchedArmaFilter : public ::testing::TestWithParam<ArmaProcess> {};

INSTANTIATE_TEST_SUITE_P(Processes, MatchedArmaFilter,
                         ::testing::Values(ArmaProcess{{}, {0.6}}, ArmaProcess{{}, {0.7, 0.5, 0.4}},
                                           ArmaProcess{{0.7}, {0.4}}, ArmaProcess{{1.2, -0.5}, {0.6, 0.3}},
                                           ArmaProcess{{0.9}, {0.5, 0.3, 0.2}}));

// The correction is K_1 times the innovation, so what is left of the measurement is (1 - K_1) times it.
TEST_P(MatchedArmaFilter, LeavesWhiteInnovationsAndTheErrorItSays) {
  constexpr std::size_t kSize = 20000;
  const Signal truth = realisation(GetParam(), kSize, 3);
  const Signal measured = sum(truth, white_noise(kSize, 4), 1.5);
  ArmaKalman kalman;
  ASSERT_TRUE(kalman.design(model_of(GetParam()), 1.0, 2.25));
  Signal filtered = measured;
  kalman.filter(filtered);
  const Signal left = times(sum(measured, filtered, -1.0), 1.0 / (1.0 - kalman.gain()(0)));
  // Of a variance over 20 000 correlated samples: 5 % is five standard errors of the most correlated of these.
  EXPECT_NEAR(core::mean_square(left), kalman.innovation_variance(), 0.05 * kalman.innovation_variance());
  EXPECT_NEAR(core::mean_square(sum(filtered, truth, -1.0)), kalman.error_variance(),
              0.05 * kalman.error_variance());
  std::array<double, 21> acf{};
  core::Autocorrelation(kSize).acf(left, acf);
  EXPECT_GT(core::test_whiteness(acf, kSize, 0).p_value, 1e-3);
}

// A slow, smooth mode: a double pole pair of period 400 samples, seen in noise 1e13 times its driving variance. In double
// precision the gain comes out as 0.
TEST(ArmaKalman, IsFoundForAModeAsSmoothAsASpline) {
  const double radius = 0.998;
  const double c = 2.0 * radius * std::cos(2.0 * std::numbers::pi / 400.0);
  const double d = radius * radius;
  const ArmaModel mode = model_of({{2.0 * c, -c * c - 2.0 * d, 2.0 * c * d, -d * d}, {}});
  ArmaKalman kalman;
  EXPECT_TRUE(kalman.design(mode, 1e-13, 1.0));
  EXPECT_GT(kalman.gain()(0), 0.0);
  EXPECT_LT(kalman.gain()(0), 1.0);
}

TEST(ArmaKalman, IsNotMadeWithoutNoise) {
  ArmaKalman kalman;
  EXPECT_FALSE(kalman.design(model_of({{0.7}, {0.4}}), 1.0, 0.0));
  EXPECT_FALSE(kalman.design(model_of({{0.7}, {0.4}}), 0.0, 1.0));
  EXPECT_FALSE(kalman.design(model_of({{0.7}, {0.4}}), 1.0, -1.0));
}

}  // namespace
}  // namespace gyrod
