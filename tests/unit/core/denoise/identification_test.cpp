// Family and orders of simulated series, and what is said where there is none.
#include "core/denoise/identification.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "support/arma_process.hpp"

namespace gyrod {
namespace {

using core::Identification;
using core::Identifier;
using core::ModelFamily;
using namespace testing;

constexpr std::size_t kSize = 5000;
constexpr unsigned kSeries = 100;

class IdentifiedOrders : public ::testing::TestWithParam<ArmaProcess> {};

INSTANTIATE_TEST_SUITE_P(Processes, IdentifiedOrders,
                         ::testing::Values(ArmaProcess{{0.7}, {}}, ArmaProcess{{1.2, -0.5}, {}},
                                           ArmaProcess{{2.2, -2.4, 1.4, -0.5}, {}}, ArmaProcess{{}, {0.6}},
                                           ArmaProcess{{}, {0.8, 0.4}}, ArmaProcess{{}, {0.7, 0.5, 0.4}},
                                           ArmaProcess{{0.7}, {0.4}}, ArmaProcess{{1.2, -0.5}, {0.5}},
                                           ArmaProcess{{1.2, -0.5}, {0.6, 0.3}}));

// tests/benchmark/identification_study.cpp has more processes, and those that were found wrong.
TEST_P(IdentifiedOrders, AreRightIn95Of100Series) {
  const ArmaProcess& truth = GetParam();
  Identifier identifier(kSize);
  unsigned right = 0;
  unsigned adequate = 0;
  for (unsigned seed = 1; seed <= kSeries; ++seed) {
    const Identification found = identifier.identify(realisation(truth, kSize, seed));
    right += found.model.p == truth.p() && found.model.q == truth.q() ? 1U : 0U;
    adequate += found.residuals.adequate ? 1U : 0U;
  }
  EXPECT_GE(right, 95U);
  EXPECT_GE(adequate, 88U) << "a test at 5 % rejects 5 of 100, standard deviation 2.2";
}

TEST(Identification, CallsWhiteNoiseWhite) {
  Identifier identifier(kSize);
  unsigned white = 0;
  for (unsigned seed = 1; seed <= 20; ++seed)
    white += identifier.identify(white_noise(kSize, seed)).model.family() == ModelFamily::kWhite ? 1U : 0U;
  EXPECT_GE(white, 19U);
}

// Table 2 on textbook cases: the cut-off is at the order, and the other function tails off.
TEST(CorrelationEvidence, SeesThePacfOfAr2AndTheAcfOfMa2CutOff) {
  Identifier identifier(20000);
  const Identification ar = identifier.identify(realisation({{1.6, -0.7}, {}}, 20000, 2));
  EXPECT_EQ(ar.evidence.pacf_cut_off, 2U);
  EXPECT_EQ(ar.by_correlations, ModelFamily::kAr);
  const Identification ma = identifier.identify(realisation({{}, {1.4, 0.8}}, 20000, 2));
  EXPECT_EQ(ma.evidence.acf_cut_off, 2U);
  EXPECT_EQ(ma.by_correlations, ModelFamily::kMa);
  const Identification arma = identifier.identify(realisation({{0.95}, {0.9}}, 20000, 2));
  EXPECT_FALSE(arma.evidence.acf_cut_off);
  EXPECT_FALSE(arma.evidence.pacf_cut_off);
  EXPECT_EQ(arma.by_correlations, ModelFamily::kArma);
}

// rho_1 = b / (1 + b^2), zero beyond; phi_ll = -(-b)^l (1 - b^2) / (1 - b^(2l+2)) (Box, Jenkins, section 3.3.2). Tolerance: four
// standard errors of 1 / sqrt(N), at most.
TEST(CorrelationEvidence, HoldsTheClosedFormsOfMa1) {
  const double b = 0.6;
  Identifier identifier(40000);
  const Identification found = identifier.identify(realisation({{}, {b}}, 40000, 3));
  EXPECT_NEAR(found.evidence.acf[0], b / (1.0 + b * b), 0.02);
  EXPECT_NEAR(found.evidence.acf[1], 0.0, 0.025);
  for (int lag = 1; lag <= 4; ++lag) {
    const double expected = -std::pow(-b, lag) * (1.0 - b * b) / (1.0 - std::pow(b, 2 * lag + 2));
    EXPECT_NEAR(found.evidence.pacf[static_cast<std::size_t>(lag - 1)], expected, 0.02) << lag;
  }
  EXPECT_NEAR(found.evidence.acf_band[0], 1.96 / 200.0, 1e-12);
  const double rho = found.evidence.acf[0];
  EXPECT_NEAR(found.evidence.acf_band[1], 1.96 / 200.0 * std::sqrt(1.0 + 2.0 * rho * rho), 1e-12)
      << "Bartlett";
}

TEST(Identification, TheDecisionHasTheLeastBic) {
  Identifier identifier(kSize);
  const Identification found = identifier.identify(realisation({{0.7}, {0.4}}, kSize, 1));
  ASSERT_TRUE(found.best_ar.tried && found.best_ma.tried && found.best_arma.tried);
  EXPECT_LT(found.best_arma.bic, found.best_ar.bic);
  EXPECT_LT(found.best_arma.bic, found.best_ma.bic);
  EXPECT_EQ(found.best_arma.p, found.model.p);
  EXPECT_EQ(found.best_arma.q, found.model.q);
}

// A process whose order is beyond the limits leaves coloured residuals, and that is said.
TEST(Identification, AModelThatIsTooSmallIsNotAdequate) {
  Identifier identifier(kSize, {.max_ar_order = 1, .max_ma_order = 0, .max_mixed_order = 0});
  const Identification found = identifier.identify(realisation({{1.2, -0.5}, {}}, kSize, 1));
  EXPECT_EQ(found.model.p, 1U);
  EXPECT_FALSE(found.residuals.adequate);
  EXPECT_FALSE(found.residuals.within_bands);
}

TEST(Identification, OfConstantAndShortSeriesIsNone) {
  Identifier identifier(1000);
  for (const Signal& x : {Signal(1000, -3.0), Signal(1000), white_noise(31, 1), Signal{1.0}, Signal{}}) {
    const Identification found = identifier.identify(x);
    EXPECT_EQ(found.model.family(), ModelFamily::kNone);
    EXPECT_FALSE(found.residuals.adequate);
  }
  EXPECT_NE(identifier.identify(white_noise(32, 1)).model.family(), ModelFamily::kNone);
}

TEST(Identification, RefusesOrdersThatThereIsNoRoomFor) {
  EXPECT_THROW(Identifier(100, {.max_ar_order = 0}), std::invalid_argument);
  EXPECT_THROW(Identifier(100, {.max_ar_order = core::kMaxArOrder + 1}), std::invalid_argument);
  EXPECT_THROW(Identifier(100, {.max_ma_order = core::kMaxMaOrder + 1}), std::invalid_argument);
}

}  // namespace
}  // namespace gyrod
