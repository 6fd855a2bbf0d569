#include "core/joint/start_levels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "support/signals.hpp"

namespace gyrod::core {
namespace {

/// A local level as one Gaussian vector: x[0] with next to no knowledge, x[t] = x[t-1] + w, z = x + v.
class Walk {
 public:
  Walk(double ratio, double noise_variance, const std::vector<double>& z)
      : noise_(noise_variance),
        z_(Eigen::Map<const Eigen::VectorXd>(z.data(), static_cast<Eigen::Index>(z.size()))) {
    const Eigen::Index n = z_.size();
    states_.resize(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index k = 0; k < n; ++k) {
        states_(i, k) = noise_variance * (1e9 + ratio * static_cast<double>(std::min(i, k)));
      }
    }
  }

  /// x[j] given all: mean relative to z[0], and variance.
  [[nodiscard]] std::array<double, 2> posterior(Eigen::Index j) const {
    const Eigen::MatrixXd seen = states_ + noise_ * Eigen::MatrixXd::Identity(z_.size(), z_.size());
    const Eigen::VectorXd gain = seen.ldlt().solve(states_.col(j));
    const Eigen::VectorXd apart = z_.array() - z_[0];
    return {gain.dot(apart), states_(j, j) - gain.dot(states_.col(j))};
  }

 private:
  double noise_;
  Eigen::VectorXd z_;
  Eigen::MatrixXd states_;
};

void run(StartLevels& levels, const std::vector<double>& z) {
  levels.reset();
  for (const double value : z) levels.step(value);
}

TEST(StartLevels, AreTheDenseEquationsOfALocalLevel) {
  constexpr double kNoise = 0.04;
  StartLevels levels;
  levels.expect_noise(kNoise);
  // Jumps of 40 deviations all the time: the wildest level is left alone.
  std::vector<double> z;
  for (int t = 0; t < 40; ++t) z.push_back(8.0 * std::sin(2.3 * t));
  run(levels, z);
  const Walk wild(20.0, kNoise, z);
  for (const std::size_t lag : {0U, 3U, 16U, 32U}) {
    const auto [mean, variance] = wild.posterior(static_cast<Eigen::Index>(z.size() - 1 - lag));
    EXPECT_NEAR(levels.estimate(lag).rate, z[0] + mean, 1e-5) << lag;
    EXPECT_NEAR(levels.estimate(lag).variance, variance, 1e-3 * kNoise) << lag;
    EXPECT_NEAR(levels.expected_variance(lag), variance, 1e-3 * kNoise) << lag;
  }
}

// Unknown before, seen n times in noise of variance s^2: the mean, s^2 / n.
TEST(StartLevels, KnowNothingBeforeTheFirstSample) {
  StartLevels levels;
  levels.expect_noise(0.25);
  levels.reset();
  levels.step(1e4);
  EXPECT_DOUBLE_EQ(levels.estimate(0).rate, 1e4);
  EXPECT_NEAR(levels.estimate(0).variance, 0.25, 1e-8);
}

// After two samples that differ by nu, level i expects S_i = 2 + its ratio of that square, in parts of var v: all know of the first sample what v hides.
// Its gain is (1 + ratio) / S, its likelihood S^-1/2 exp(-nu^2 / (2 S)), of which the root counts; before, all were alike. 1e-6: the 1e9 of the start.
TEST(StartLevels, WeighTheRootsOfTheirLikelihoods) {
  constexpr std::array<double, 4> kStepsRatios = {1e-4, 0.02, 1.0, 20.0};
  for (const double nu : {0.0, 0.5, 2.0, 6.0}) {
    double sum = 0.0;
    double gain = 0.0;
    for (const double ratio : kStepsRatios) {
      const double S = 2.0 + ratio;
      const double weight = std::pow(std::exp(-0.5 * nu * nu / S) / std::sqrt(S), 0.5);
      sum += weight;
      gain += weight * (1.0 + ratio) / S;
    }
    StartLevels levels;
    levels.expect_noise(0.25);
    run(levels, {3.0, 3.0 + 0.5 * nu});
    EXPECT_NEAR(levels.estimate(0).rate, 3.0 + 0.5 * nu * gain / sum, 1e-6) << nu;
  }
}

TEST(StartLevels, AverageWhatStandsStill) {
  constexpr std::size_t kSamples = 90;
  StartLevels levels;
  levels.expect_noise(1.0);
  double squares = 0.0;
  double claimed = 0.0;
  constexpr int kRuns = 200;
  for (int i = 0; i < kRuns; ++i) {
    run(levels, testing::white_noise(kSamples, static_cast<unsigned>(i + 1)));
    squares += std::pow(levels.estimate(16).rate, 2) / kRuns;
    claimed += levels.estimate(16).variance / kRuns;
  }
  // Of a constant known beforehand to be one: 1 / 90. It may walk as well, for all that is known; so the claim is a careful one.
  EXPECT_LT(squares, 0.03);
  EXPECT_GT(claimed / squares, 1.0);
  EXPECT_LT(claimed / squares, 4.0);
}

// A shaking vehicle in noise that is known: nothing may be lost. A level of the noise that is taken from differences of low order made
// 2.4 times the noise of it.
TEST(StartLevels, LoseNothingOfMotionThatIsFarAboveTheNoise) {
  for (const bool known : {true, false}) {
    StartLevels levels;
    levels.expect_noise(known ? 0.01 : 0.0);
    levels.reset();
    const auto noise = testing::times(testing::white_noise(96, 5), 0.1);
    double squares = 0.0;
    for (std::size_t t = 0; t < noise.size(); ++t) {
      const double truth = 1.2 * std::sin(2.0 * std::numbers::pi * 0.17 * static_cast<double>(t));
      levels.step(truth + noise[t]);
      squares += std::pow(levels.estimate(0).rate - truth, 2) / 96.0;
    }
    EXPECT_LT(std::sqrt(squares), known ? 0.11 : 0.2);
  }
}

// Fourth differences of white noise have 70 times its variance, those of a slow sine next to none: (2 sin(pi f))^8.
TEST(StartLevels, GuessTheNoiseBesideMotion) {
  StartLevels levels;
  levels.reset();
  const auto noise = testing::times(testing::white_noise(3000, 8), 0.1);
  for (std::size_t t = 0; t < noise.size(); ++t) {
    levels.step(5.0 * std::sin(0.05 * static_cast<double>(t)) + noise[t]);
  }
  EXPECT_NEAR(levels.noise_variance(), 0.01, 0.0015);  // three of sqrt(2 * 2.6 / 3000) = 4 %
}

TEST(StartLevels, KeepWhatIsExpectedWhenTheyForget) {
  StartLevels levels;
  levels.expect_noise(0.5);
  run(levels, {1.0, 2.0, 3.0});
  levels.reset();
  EXPECT_EQ(levels.noise_variance(), 0.5);
  levels.step(-7.0);
  EXPECT_EQ(levels.estimate(0).rate, -7.0);
}

TEST(StartLevels, AreFiniteForAnyInputWhoseDifferencesAre) {
  for (const double known : {0.0, 1e-300, 1.0, 1e300}) {
    for (const double size : {0.0, 1e-300, 1e-6, 1e6, 1e150, 1e300}) {
      StartLevels levels;
      levels.expect_noise(known);
      levels.reset();
      for (std::size_t t = 0; t < 100; ++t) {
        levels.step(size * (static_cast<double>(t % 3) - 1.0));
        for (const std::size_t lag : {std::size_t{0}, std::min(t, kMaxLag)}) {
          EXPECT_TRUE(std::isfinite(levels.estimate(lag).rate)) << known << " " << size;
          EXPECT_TRUE(levels.estimate(lag).variance >= 0.0) << known << " " << size;
        }
      }
    }
  }
}

}  // namespace
}  // namespace gyrod::core
