#include "core/evaluation/seams.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/evaluation/rivals.hpp"
#include "core/simulation/random.hpp"
#include "evaluation_support.hpp"

namespace gyrod::core {
namespace {

constexpr std::size_t kHop = 32;

Contender with_seams(std::vector<double> estimate, SeamPattern seams) {
  Contender contender;
  contender.estimate = std::move(estimate);
  contender.seams = seams;
  return contender;
}

SeamFigures figures_of(const Contender& contender) {
  const std::vector<double> truth(contender.estimate.size());
  return seam_figures(contender, truth, {0, truth.size()}).value();
}

// Steps of 1, 2 and 4 beside the seams: their logarithms are ln 2 on average, with a standard deviation of sqrt(2/3) ln 2.
TEST(Seams, ExpectOfTheLargestStepWhatOtherPlacesShow) {
  std::vector<double> x(401);
  for (std::size_t t = 1; t < x.size(); ++t) {
    const double sign = t / 4 % 2 == 0 ? 1.0 : -1.0;
    x[t] = x[t - 1] + sign * std::array{0.5, 1.0, 2.0, 4.0}[t % 4];
  }
  const SeamFigures figures = figures_of(with_seams(x, {4, 0}));
  const double ordinary = std::sqrt((1.0 + 4.0 + 16.0) / 3.0);
  EXPECT_NEAR(figures.worst_step, 0.5 / ordinary, 1e-9);
  EXPECT_NEAR(figures.worst_step_by_chance, 2.0 * std::exp2(4.0 * std::sqrt(2.0 / 3.0)) / ordinary, 1e-9);
}

// An answer that is smooth but for some forty spells of a dozen samples, in which it hardly filters, as that of method paper in strong noise.
std::vector<double> smooth_with_spells(std::uint64_t seed) {
  constexpr std::size_t kSpell = 12;
  const std::vector<double> noise = test::white_noise(6000, 1.0, seed);
  std::vector<double> x = rival_estimate({Rival::kZeroPhase2, 0.02}, noise);
  const std::vector<double> rough = rival_estimate({Rival::kZeroPhase2, 0.3}, noise);
  Random random(seed + 50);
  for (int spell = 0; spell < 40; ++spell) {
    const auto begin = static_cast<std::size_t>(random.uniform() * static_cast<double>(x.size() - kSpell));
    for (std::size_t k = 0; k < kSpell; ++k) {
      const double sine = std::sin(std::numbers::pi * (static_cast<double>(k) + 0.5) / kSpell);
      x[begin + k] += sine * sine * rough[begin + k];
    }
  }
  return x;
}

struct Beyond {
  int roughness = 0;
  int share = 0;
  int step = 0;

  /// Counts what is beyond what guards allow.
  void add(const SeamFigures& figures) {
    if (figures.roughness > std::max(1.2, figures.roughness_by_chance)) ++roughness;
    const double white = 0.05 + 3.0 * figures.outlier_standard_error;
    if (figures.outlier_share > std::max(white, figures.outlier_share_by_chance)) ++share;
    if (figures.worst_step > std::max(3.0, figures.worst_step_by_chance)) ++step;
  }
};

// Where there is no seam, at any place of the hop: 640 of them, of which the largest at the other places alone is exceeded by 34 (roughness) and 20 (step).
TEST(Seams, AreSeldomSeenWhereThereAreNone) {
  Beyond chance;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Contender contender = with_seams(smooth_with_spells(seed), {kHop, 0});
    for (std::size_t place = 0; place < kHop; ++place) {
      contender.seams->first = place;
      chance.add(figures_of(contender));
    }
  }
  EXPECT_LE(chance.roughness, 3);
  EXPECT_LE(chance.share, 3);
  EXPECT_LE(chance.step, 3);
}

/// Mean and four standard deviations, or the largest.
double expected_of(const std::vector<double>& x) {
  const auto count = static_cast<double>(x.size());
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / count;
  double squares = 0.0;
  for (const double value : x) squares += (value - mean) * (value - mean);
  return std::max(mean + 4.0 * std::sqrt(squares / count), *std::ranges::max_element(x));
}

// To 5 %, as limits and ordinary steps are those of the seams' own place.
TEST(Seams, ExpectOfAllFiguresWhatTheyAreAtOtherPlaces) {
  Contender contender = with_seams(smooth_with_spells(3), {kHop, 0});
  std::vector<double> roughness;
  std::vector<double> shares;
  std::vector<double> steps;  // logarithms
  for (std::size_t place = 1; place < kHop; ++place) {
    contender.seams->first = place;
    const SeamFigures figures = figures_of(contender);
    steps.push_back(std::log(figures.worst_step));
    if (place == 1 || place + 1 == kHop) continue;  // they share a second difference with place 0
    roughness.push_back(figures.roughness);
    shares.push_back(figures.outlier_share);
  }
  contender.seams->first = 0;
  const SeamFigures figures = figures_of(contender);
  EXPECT_NEAR(figures.roughness_by_chance / expected_of(roughness), 1.0, 1e-9);
  EXPECT_NEAR(figures.outlier_share_by_chance / expected_of(shares), 1.0, 0.05);
  EXPECT_NEAR(figures.worst_step_by_chance / std::exp(expected_of(steps)), 1.0, 0.05);
}

// Steps as large as those from sample to sample, which fade by a fifth a sample.
TEST(Seams, AreSeenWhereStepsAreAsLargeAsOthers) {
  Beyond seen;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<double> x = rival_estimate({Rival::kZeroPhase2, 0.1}, test::white_noise(6000, 1.0, seed));
    double squares = 0.0;
    for (std::size_t t = 1; t < x.size(); ++t) squares += (x[t] - x[t - 1]) * (x[t] - x[t - 1]);
    const double ordinary = std::sqrt(squares / static_cast<double>(x.size() - 1));
    const std::vector<double> sizes = test::white_noise(x.size(), ordinary, seed + 100);
    double step = 0.0;
    for (std::size_t t = 0; t < x.size(); ++t) {
      if (t % kHop == 16) step += sizes[t];
      x[t] += step;
      step *= 0.8;
    }
    seen.add(figures_of(with_seams(x, {kHop, 16})));
  }
  EXPECT_EQ(seen.roughness, 20);
  EXPECT_EQ(seen.share, 20);
}

}  // namespace
}  // namespace gyrod::core
