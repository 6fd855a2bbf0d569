// The correlation among the points of a curve, against that of many simulated curves.
#include "core/allan/point_correlation.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "allan_support.hpp"

namespace gyrod {
namespace {

using namespace testing;
using Eigen::MatrixXd;

const std::vector<std::size_t> kSizes = {1, 2, 4, 10, 11, 40, 100};
constexpr std::size_t kSamples = 4000;
constexpr unsigned kSeeds = 400;

MatrixXd simulated(const std::function<Signal(std::size_t, unsigned)>& noise) {
  MatrixXd variances(kSeeds, static_cast<Eigen::Index>(kSizes.size()));
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const auto points = core::allan_deviation_at(noise(kSamples, seed + 1), 1.0, kSizes);
    for (std::size_t i = 0; i < points.size(); ++i) {
      variances(seed, static_cast<Eigen::Index>(i)) = points[i].deviation * points[i].deviation;
    }
  }
  MatrixXd centred = variances.rowwise() - variances.colwise().mean();
  centred.colwise().normalize();
  return centred.transpose() * centred;
}

MatrixXd computed(core::NoiseTerm term) {
  std::array<double, core::kNoiseTerms> squares{};
  squares[static_cast<std::size_t>(term)] = 2.5;
  return core::point_correlation(core::allan_deviation_at(white_noise(kSamples, 1), 1.0, kSizes), squares);
}

// 400 seeds give a correlation to 0.05; the header promises 0.15 besides.
constexpr double kTolerance = 0.2;

TEST(PointCorrelation, AgreesWithSimulation) {
  EXPECT_LT((simulated(white_noise) - computed(kN)).cwiseAbs().maxCoeff(), kTolerance);
  EXPECT_LT((simulated(random_walk) - computed(kK)).cwiseAbs().maxCoeff(), kTolerance);
  EXPECT_LT((simulated(differenced_noise) - computed(kQ)).cwiseAbs().maxCoeff(), kTolerance);
}

TEST(PointCorrelation, IsAMatrixOfCorrelationsForEveryTerm) {
  for (const core::NoiseTerm term : kAllTerms) {
    const MatrixXd correlation = computed(term);
    EXPECT_TRUE(correlation.allFinite());
    EXPECT_LT((correlation - correlation.transpose()).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT((correlation.diagonal().array() - 1.0).abs().maxCoeff(), 1e-12);
    EXPECT_GE(correlation.minCoeff(), 0.0);
  }
}

}  // namespace
}  // namespace gyrod
