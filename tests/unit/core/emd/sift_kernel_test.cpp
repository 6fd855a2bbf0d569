// The kernels: what each must compute, and how far they may differ from one another.
#include "core/emd/sift_kernel.hpp"

#include <gtest/gtest.h>

#include "core/emd/boundary.hpp"
#include "unit/core/emd/emd_support.hpp"

namespace gyrod {
namespace {

using core::BoundaryRule;
using core::EmdKernel;
using core::SiftKernel;
using core::SiftWorkspace;
using namespace testing;

SiftWorkspace loaded(const Signal& signal, BoundaryRule rule = BoundaryRule::kMirror) {
  SiftWorkspace ws(signal.size(), rule);
  ws.size = signal.size();
  std::ranges::copy(signal, ws.signal.begin());
  return ws;
}

class EveryKernel : public ::testing::TestWithParam<EmdKernel> {
 protected:
  void SetUp() override {
    if (!core::is_available(GetParam())) {
      GTEST_SKIP() << "this processor does not run the kernel";
    }
  }
  const SiftKernel& kernel() const { return core::sift_kernel(GetParam()); }

  /// Positions of the extrema, samples.
  std::vector<double> extrema(const Signal& signal) const {
    SiftWorkspace ws = loaded(signal);
    kernel().find_extrema(ws);
    std::vector<double> positions;
    for (std::size_t k = ws.extrema.begin; k < ws.extrema.end; ++k) {
      positions.push_back(0.5 * ws.extrema.position2[k]);
      EXPECT_EQ(ws.extrema.value[k], signal[static_cast<std::size_t>(positions.back())]);
    }
    return positions;
  }
};

INSTANTIATE_TEST_SUITE_P(All, EveryKernel,
                         ::testing::Values(EmdKernel::kReference, EmdKernel::kBaseline, EmdKernel::kAvx2,
                                           EmdKernel::kAvx512, EmdKernel::kFastest));

TEST_P(EveryKernel, FindsMaximaAndMinimaInOrder) {
  EXPECT_EQ(extrema({0, 1, 0, 2, 3, 2, 5}), (std::vector<double>{1, 2, 4, 5}));
}

TEST_P(EveryKernel, EndsAreNoExtrema) {
  EXPECT_TRUE(extrema({3, 2, 1}).empty());
  EXPECT_TRUE(extrema({1, 1, 1}).empty());
  EXPECT_TRUE(extrema({2, 2, 1, 1}).empty());
  EXPECT_TRUE(extrema({7}).empty());
}

TEST_P(EveryKernel, FlatTopIsOneExtremumAtItsMidpoint) {
  EXPECT_EQ(extrema({0, 1, 1, 1, 0}), std::vector<double>{2});
  EXPECT_EQ(extrema({0, 1, 1, 0}), std::vector<double>{1.5});
  EXPECT_EQ(extrema({0, 0, -1, -1, 5, 5}), std::vector<double>{2.5});
}

TEST_P(EveryKernel, FlatOnASlopeIsNoExtremum) { EXPECT_TRUE(extrema({0, 1, 1, 2, 2, 2, 3}).empty()); }

TEST_P(EveryKernel, FlatLongerThanAWordOfMarksIsOneExtremum) {
  Signal table(400, 1.0);
  table.front() = 0.0;
  table.back() = 0.0;
  EXPECT_EQ(extrema(table), std::vector<double>{199.5});
}

// The marks are handled 64 differences at a time: a flat or a turn may lie on either side of such a joint.
TEST_P(EveryKernel, ExtremaAtEveryOffsetAgreeWithTheReference) {
  for (std::size_t size = 1; size < 200; ++size) {
    for (const double resolution : {1e-9, 0.5, 1.5}) {
      const Signal signal = quantised(white_noise(size, static_cast<unsigned>(size)), resolution);
      SiftWorkspace ours = loaded(signal);
      SiftWorkspace right = loaded(signal);
      kernel().find_extrema(ours);
      core::kReferenceKernel.find_extrema(right);
      ASSERT_EQ(ours.extrema.count(), right.extrema.count()) << size;
      for (std::size_t k = right.extrema.begin; k < right.extrema.end; ++k) {
        ASSERT_EQ(ours.extrema.position2[k], right.extrema.position2[k]) << size;
        ASSERT_EQ(ours.extrema.value[k], right.extrema.value[k]) << size;
      }
    }
  }
}

/// Largest residual of the spline equations of both envelopes with ws.sigma put in, relative to the largest
/// slope.
double spline_residual(const SiftWorkspace& ws, std::span<const double> value) {
  const auto spacing = [&](std::size_t k) { return ws.time[k + 2] - ws.time[k]; };
  const auto slope = [&](std::size_t k) { return (value[k + 2] - value[k]) / spacing(k); };
  double residual = 0.0;
  for (std::size_t k = 2; k + 2 < value.size(); ++k) {
    const double left = spacing(k - 2) * ws.sigma[k - 2] + 2.0 * (spacing(k - 2) + spacing(k)) * ws.sigma[k] +
                        spacing(k) * ws.sigma[k + 2];
    residual = std::max(residual, std::abs(left - (slope(k) - slope(k - 2))));
  }
  return residual / peak(value);
}

/// Signals whose knots are even, random, dense, sparse and very unevenly spaced.
std::vector<Signal> knot_patterns(std::size_t size) {
  Signal bursts(size);
  for (std::size_t t = 0; t < size; ++t) {
    bursts[t] = t % 97 < 12 ? (t % 2 == 0 ? 1.0 : -1.0) : std::cos(0.01 * static_cast<double>(t));
  }
  return {white_noise(size, 21),
          tone(size, 0.24),
          tone(size, 0.011),
          bursts,
          quantised(white_noise(size, 22), 1.0),
          sum(tone(size, 0.003), white_noise(size, 23), 1e-3)};
}

// Substituted back, the solution leaves what rounding leaves. A part of the chunked solve that starts too
// near shows here: with half the warm-up the residual is 1e-9.
TEST_P(EveryKernel, EnvelopesSolveTheSplineEquations) {
  for (const std::size_t size : {9U, 60U, 200U, 1024U, 5000U}) {
    for (const Signal& signal : knot_patterns(size)) {
      SiftWorkspace ws = loaded(signal);
      kernel().find_extrema(ws);
      if (ws.extrema.count() < 3) {
        continue;
      }
      SiftWorkspace before = loaded(signal);
      kernel().find_extrema(before);
      core::add_boundary_knots(before);
      kernel().sift(ws);
      const auto values =
          std::span(before.extrema.value).subspan(before.extrema.begin, before.extrema.count());
      EXPECT_LE(spline_residual(ws, values), 1e-14) << size;
      EXPECT_EQ(ws.sigma[0], 0.0);
      EXPECT_EQ(ws.sigma[1], 0.0);
      EXPECT_NEAR(ws.sigma[values.size() - 1], 0.0, 1e-300);
      EXPECT_NEAR(ws.sigma[values.size() - 2], 0.0, 1e-300);
    }
  }
}

// The kernels add in another order, and solve in chunks: rounding, of which a sift of unit signals leaves a
// few 1e-16.
TEST_P(EveryKernel, OneSiftAgreesWithTheReference) {
  for (const BoundaryRule rule : {BoundaryRule::kMirror, BoundaryRule::kLinear}) {
    for (const std::size_t size : {9U, 64U, 65U, 200U, 1024U, 5000U}) {
      for (const Signal& signal : knot_patterns(size)) {
        SiftWorkspace ours = loaded(signal, rule);
        SiftWorkspace right = loaded(signal, rule);
        kernel().find_extrema(ours);
        core::kReferenceKernel.find_extrema(right);
        if (right.extrema.count() < 3) {
          continue;
        }
        kernel().sift(ours);
        core::kReferenceKernel.sift(right);
        const double scale = std::max(peak(signal), peak(std::span(right.mean).first(size)));
        for (std::size_t t = 0; t < size; ++t) {
          ASSERT_NEAR(ours.signal[t], right.signal[t], 4e-15 * scale) << size << " at " << t;
        }
      }
    }
  }
}

// Ten sifts of eleven modes: rounding grows, and still is rounding.
TEST_P(EveryKernel, DecompositionAgreesWithTheReference) {
  for (const BoundaryRule rule : {BoundaryRule::kMirror, BoundaryRule::kLinear}) {
    for (const std::size_t size : {50U, 1024U, 4096U}) {
      const Signal signal = white_noise(size, 31);
      const Decomposition right = decompose(signal, {.boundary = rule}, EmdKernel::kReference);
      EXPECT_LE(difference(decompose(signal, {.boundary = rule}, GetParam()), right), 1e-12) << size;
    }
  }
}

TEST_P(EveryKernel, VectorKernelsGiveTheSameBits) {
  if (GetParam() == EmdKernel::kReference) {
    GTEST_SKIP() << "differs by rounding, see above";
  }
  for (const BoundaryRule rule : {BoundaryRule::kMirror, BoundaryRule::kLinear}) {
    for (const std::size_t size : {5U, 63U, 64U, 65U, 500U, 1024U, 4099U}) {
      for (const Signal& signal : knot_patterns(size)) {
        const Decomposition baseline = decompose(signal, {.boundary = rule}, EmdKernel::kBaseline);
        EXPECT_TRUE(decompose(signal, {.boundary = rule}, GetParam()) == baseline) << size;
      }
    }
  }
}

}  // namespace
}  // namespace gyrod
