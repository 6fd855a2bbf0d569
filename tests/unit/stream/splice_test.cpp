#include "stream/splice.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace gyrod::stream {
namespace {

constexpr Position kLag = 16;
constexpr Position kHop = 32;
constexpr Position kWindow = 64;
constexpr Position kFade = 12;  // three quarters of the lag

/// The window that ends before `end`, and what is to be released of it.
WindowJob window_to(Position end, std::uint64_t segment = 1) {
  WindowJob job;
  job.begin = end - kWindow;
  job.end = end;
  job.release_begin = end - kHop - kLag;
  job.release_end = end - kLag;
  job.segment = segment;
  return job;
}

/// What a window says of its positions: always the same value.
std::vector<double> says(double value) { return std::vector<double>(kWindow, value); }

/// The released part.
std::vector<double> released(const WindowJob& job, const std::vector<double>& window) {
  return {window.begin() + (job.release_begin - job.begin), window.begin() + (job.release_end - job.begin)};
}

std::vector<double> join(Splice& splice, const WindowJob& job, std::vector<double> window,
                         std::size_t axis = 0) {
  splice.join(job, axis, window);
  return released(job, window);
}

TEST(Splice, FadesFromTheWindowBeforeByTheFormulaOfItsHeader) {
  Splice splice(kLag);
  EXPECT_EQ(join(splice, window_to(100), says(1.0)), std::vector<double>(kHop, 1.0)) << "nothing before it";
  const auto second = join(splice, window_to(100 + kHop), says(3.0));
  for (Position k = 0; k < kHop; ++k) {
    const double weight =
        k < kFade ? (1.0 + std::cos(std::numbers::pi * (static_cast<double>(k) + 0.5) / kFade)) / 2.0 : 0.0;
    EXPECT_NEAR(second[static_cast<std::size_t>(k)], 3.0 - 2.0 * weight, 1e-15) << k;
  }
}

TEST(Splice, ChangesNothingWhereBothWindowsSayTheSame) {
  Splice splice(kLag);
  std::vector<double> line(200);
  for (std::size_t n = 0; n < line.size(); ++n) line[n] = 0.1 * static_cast<double>(n);
  for (const Position end : {64, 96, 128, 160}) {
    const WindowJob job = window_to(end);
    const std::vector<double> window{line.begin() + job.begin, line.begin() + job.end};
    EXPECT_EQ(join(splice, job, window), released(job, window));
  }
}

TEST(Splice, FadesFromWhatTheWindowBeforeSaidNotFromWhatWasReleasedOfIt) {
  Splice splice(kLag);
  (void)join(splice, window_to(100), says(1.0));
  (void)join(splice, window_to(132), says(3.0));
  Splice fresh(kLag);
  (void)join(fresh, window_to(132), says(3.0));
  EXPECT_EQ(join(splice, window_to(164), says(5.0)), join(fresh, window_to(164), says(5.0)));
}

TEST(Splice, ReachesNoFurtherThanTheWindowBefore) {
  Splice splice(kLag);
  // A stream's last window but one ends five positions after what it releases.
  WindowJob short_one = window_to(100);
  short_one.release_end = 95;
  (void)join(splice, short_one, says(1.0));
  WindowJob next = window_to(132);
  next.release_begin = 95;
  const auto second = join(splice, next, says(3.0));
  EXPECT_LT(second[4], 3.0);
  EXPECT_EQ(second[5], 3.0);
}

TEST(Splice, ReleasesNoMoreThanIsDue) {
  Splice splice(kLag);
  (void)join(splice, window_to(100), says(1.0));
  WindowJob tail = window_to(104);
  tail.release_begin = 84;
  tail.release_end = 89;
  std::vector<double> window = says(3.0);
  splice.join(tail, 0, window);
  EXPECT_LT(window[static_cast<std::size_t>(88 - tail.begin)], 3.0);
  EXPECT_EQ(window[static_cast<std::size_t>(89 - tail.begin)], 3.0) << "the next window's to change";
  EXPECT_EQ(window[static_cast<std::size_t>(83 - tail.begin)], 3.0) << "gone already";
}

TEST(Splice, TakesNothingAcrossAGapOrAWindowThatWasPassedThrough) {
  const std::vector<double> untouched(kHop, 3.0);
  Splice across_gap(kLag);
  (void)join(across_gap, window_to(100, 1), says(1.0));
  EXPECT_EQ(join(across_gap, window_to(132, 2), says(3.0)), untouched);
  Splice passed_through(kLag);
  (void)join(passed_through, window_to(100), says(1.0));
  EXPECT_EQ(join(passed_through, window_to(164), says(3.0)), untouched);
}

TEST(Splice, KeepsAxesApart) {
  Splice splice(kLag);
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    (void)join(splice, window_to(100), says(static_cast<double>(axis)), axis);
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    EXPECT_NEAR(join(splice, window_to(132), says(3.0), axis)[0], static_cast<double>(axis), 0.02) << axis;
}

TEST(Splice, WithoutALagThereIsNothingToFadeFrom) {
  Splice splice(0);
  for (const Position end : {100, 132}) {
    WindowJob job = window_to(end);
    job.release_begin = end - kHop;
    job.release_end = end;
    EXPECT_EQ(join(splice, job, says(static_cast<double>(end))),
              std::vector<double>(kHop, static_cast<double>(end)));
  }
}

}  // namespace
}  // namespace gyrod::stream
