// Knots that the boundary rules add, on signals small enough to see them.
#include "core/emd/boundary.hpp"

#include <gtest/gtest.h>

#include "core/emd/sift_kernel.hpp"
#include "unit/core/emd/emd_support.hpp"

namespace gyrod {
namespace {

using core::BoundaryRule;
using core::SiftWorkspace;
using namespace testing;

struct Knot {
  double time;
  double value;

  bool operator==(const Knot&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Knot& knot) {
  return out << knot.time << ":" << knot.value;
}

std::vector<Knot> knots(const SiftWorkspace& ws) {
  std::vector<Knot> all;
  for (std::size_t k = ws.extrema.begin; k < ws.extrema.end; ++k) {
    all.push_back({0.5 * ws.extrema.position2[k], ws.extrema.value[k]});
  }
  return all;
}

std::vector<Knot> knots_of(const Signal& signal, BoundaryRule rule) {
  SiftWorkspace ws(signal.size(), rule);
  ws.size = signal.size();
  std::ranges::copy(signal, ws.signal.begin());
  core::kReferenceKernel.find_extrema(ws);
  core::add_boundary_knots(ws);
  return knots(ws);
}

// Extrema at 1, 3, 5, 7, 9; both ends lie between their neighbours' values.
const Signal kWave{1, 4, 2, 0, 2, 5, 2, -1, 2, 3, 1};

TEST(MirrorRule, ReflectsFourExtremaAboutTheFirst) {
  const std::vector<Knot> all = knots_of(kWave, BoundaryRule::kMirror);
  const std::vector<Knot> expected{{-7, 3}, {-5, -1}, {-3, 5},  {-1, 0}, {1, 4},  {3, 0}, {5, 5},
                                   {7, -1}, {9, 3},   {11, -1}, {13, 5}, {15, 0}, {17, 4}};
  EXPECT_EQ(all, expected);
}

TEST(MirrorRule, TakesAnEndBeyondTheSecondExtremumForAnExtremum) {
  Signal wave = kWave;
  wave.front() = -2;
  const std::vector<Knot> all = knots_of(wave, BoundaryRule::kMirror);
  const std::vector<Knot> left(all.begin(), all.begin() + 6);
  const std::vector<Knot> expected{{-7, -1}, {-5, 5}, {-3, 0}, {-1, 4}, {0, -2}, {1, 4}};
  EXPECT_EQ(left, expected);
}

TEST(MirrorRule, TakesAnEndLevelWithTheSecondExtremumForAnExtremum) {
  Signal wave = kWave;
  wave.front() = 0;
  const std::vector<Knot> all = knots_of(wave, BoundaryRule::kMirror);
  EXPECT_EQ(all[4], (Knot{0, 0}));
  EXPECT_EQ(all[5], (Knot{1, 4}));
}

TEST(MirrorRule, ReflectsAboutTheEndWhereExtremaAboutTheFirstDoNotReachIt) {
  const Signal late{1, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 4, 0, 5, -1, 4, 1};
  const std::vector<Knot> all = knots_of(late, BoundaryRule::kMirror);
  const std::vector<Knot> left(all.begin(), all.begin() + 6);
  const std::vector<Knot> expected{{-10, -1}, {-9, 5}, {-8, 0}, {-7, 4}, {0, 1}, {7, 4}};
  EXPECT_EQ(left, expected);
}

TEST(MirrorRule, GoesBackAndForthBetweenTheEndsOfThreeExtrema) {
  const Signal few{1, 4, 0, 5, 2};
  const std::vector<Knot> all = knots_of(few, BoundaryRule::kMirror);
  const std::vector<Knot> expected{{-3, 4}, {-2, 0}, {-1, 5}, {0, 0}, {1, 4}, {2, 0},
                                   {3, 5},  {4, 0},  {5, 4},  {6, 0}, {7, 5}};
  EXPECT_EQ(all, expected);
}

// Left: maxima 4, 5 at 1, 5 -> 3.75 at 0; minima 0, -1 at 3, 7 -> 0.75.
// Right: maxima 3, 5 at 1, 5 from the end -> 2.5; minima -1, 0 at 3, 7 from it -> -1.75.
TEST(LinearRule, ExtrapolatesBothEnvelopesToTheEndSamples) {
  const std::vector<Knot> all = knots_of(kWave, BoundaryRule::kLinear);
  const std::vector<Knot> expected{{0, 3.75}, {0, 0.75}, {1, 4},      {3, 0},   {5, 5},
                                   {7, -1},   {9, 3},    {10, -1.75}, {10, 2.5}};
  EXPECT_EQ(all, expected);
}

TEST(LinearRule, KeepsTheEndSampleBetweenTheEnvelopes) {
  Signal wave = kWave;
  wave.front() = 0.5;
  EXPECT_EQ(knots_of(wave, BoundaryRule::kLinear)[1], (Knot{0, 0.5}));
  wave.front() = 3.9;
  EXPECT_EQ(knots_of(wave, BoundaryRule::kLinear)[0], (Knot{0, 3.9}));
}

TEST(LinearRule, IsLevelWhereAKindHasOneExtremum) {
  const Signal few{1, 4, 0, 5, 2};
  const std::vector<Knot> all = knots_of(few, BoundaryRule::kLinear);
  const std::vector<Knot> expected{{0, 3.5}, {0, 0}, {1, 4}, {2, 0}, {3, 5}, {4, 0}, {4, 5.5}};
  EXPECT_EQ(all, expected);
}

}  // namespace
}  // namespace gyrod
