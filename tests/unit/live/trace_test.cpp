/// Curves to draw: every spike shows, frames agree; spectra of known signals.
#include "live/trace.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "live/spectrum.hpp"

namespace gyrod::live {
namespace {

constexpr std::int64_t kPeriodNs = 10'000'000;  // 100 Hz
constexpr std::int64_t kStartNs = 1'700'000'000'123'456'789;

std::vector<Point> points(std::size_t count, auto rate) {
  std::vector<Point> made(count);
  for (std::size_t i = 0; i < count; ++i) {
    made[i].stamp_ns = kStartNs + static_cast<std::int64_t>(i) * kPeriodNs;
    const auto value = static_cast<float>(rate(i));
    made[i].rate_radps = {value, 2.0F * value, -value};
  }
  return made;
}

Trace trace_of(std::span<const Point> all, std::int64_t bucket_ns) {
  TraceMaker maker(bucket_ns);
  maker.take(all);
  return maker.make(true);
}

TEST(Trace, ASpikeOfOneSampleShows) {
  const auto all = points(60'000, [](std::size_t i) { return i == 31'337 ? 5.0 : 0.001; });
  const Trace trace = trace_of(all, bucket_for(600.0, 100));
  EXPECT_LE(trace.middle_ns.size(), 101U);
  EXPECT_EQ(*std::ranges::max_element(trace.largest[0]), 5.0F);
  EXPECT_EQ(*std::ranges::max_element(trace.largest[1]), 10.0F);
  EXPECT_EQ(*std::ranges::min_element(trace.least[2]), -5.0F);
  EXPECT_EQ(std::ranges::count(trace.largest[0], 5.0F), 1);
}

TEST(Trace, IsTheSameHoweverTheSamplesCome) {
  const auto all = points(1000, [](std::size_t i) { return std::sin(static_cast<double>(i)); });
  const std::int64_t bucket_ns = 70'000'000;
  const Trace whole = trace_of(all, bucket_ns);
  TraceMaker maker(bucket_ns);
  Trace joined;
  for (std::size_t begin = 0; begin < all.size(); begin += 9) {
    maker.take(std::span(all).subspan(begin, std::min<std::size_t>(9, all.size() - begin)));
    const Trace part = maker.make(begin + 9 >= all.size());
    joined.middle_ns.insert(joined.middle_ns.end(), part.middle_ns.begin(), part.middle_ns.end());
    joined.least[0].insert(joined.least[0].end(), part.least[0].begin(), part.least[0].end());
  }
  EXPECT_EQ(joined.middle_ns, whole.middle_ns);
  EXPECT_EQ(joined.least[0], whole.least[0]);
}

TEST(Trace, StretchesAreAtMultiplesOfTheirLength) {
  const auto all = points(50, [](std::size_t) { return 1.0; });
  const std::int64_t bucket_ns = 30'000'000;
  for (const std::int64_t middle : trace_of(all, bucket_ns).middle_ns)
    EXPECT_EQ(middle % bucket_ns, bucket_ns / 2);
}

TEST(Trace, StampsBeforeTheYear1970AreInTheirOwnStretch) {
  const std::vector<Point> all = {{-1, {1.0F, 1.0F, 1.0F}}, {1, {2.0F, 2.0F, 2.0F}}};
  EXPECT_EQ(trace_of(all, 100).middle_ns, (std::vector<std::int64_t>{-50, 50}));
}

TEST(Gaps, AreWhereSamplesAreMissing) {
  auto all = points(10, [](std::size_t) { return 0.0; });
  all.erase(all.begin() + 4);  // one sample
  std::vector<Interval> gaps;
  std::optional<std::int64_t> last;
  find_gaps(std::span(all).first(4), 100.0, last, gaps);
  find_gaps(std::span(all).subspan(4), 100.0, last, gaps);
  EXPECT_EQ(gaps, (std::vector<Interval>{{kStartNs + 3 * kPeriodNs, kStartNs + 5 * kPeriodNs}}));
}

TEST(Spectrum, OfWhiteNoiseIsItsDeviationByTheRootOfHalfTheRate) {
  std::mt19937_64 bits(3);  // NOLINT(cert-msc51-cpp): the same each time
  std::normal_distribution<double> normal(0.0, 0.006);
  const auto noise = points(20'000, [&](std::size_t) { return normal(bits); });
  const auto spectrum = spectrum_of(noise, 100.0, 256);
  ASSERT_TRUE(spectrum.has_value());
  double power = 0.0;
  for (const double density : spectrum->density[0]) power += density * density;
  power /= static_cast<double>(spectrum->density[0].size());
  // Mean of 126 bins of 155 stretches, half of them independent: 1 % and less.
  EXPECT_NEAR(std::sqrt(power), 0.006 * std::sqrt(2.0 / 100.0), 0.02 * 0.006 * std::sqrt(2.0 / 100.0));
  EXPECT_DOUBLE_EQ(spectrum->frequency_hz.back(), 50.0);
  EXPECT_NEAR(spectrum->density[1][40], 2.0 * spectrum->density[0][40], 1e-6);
}

TEST(Spectrum, ATonePeaksAtItsFrequencyWithItsPower) {
  constexpr double kAmplitude = 0.1;
  const auto tone = points(4096, [](std::size_t i) {
    return kAmplitude * std::sin(2.0 * std::numbers::pi * 12.5 * static_cast<double>(i) / 100.0);
  });
  const auto spectrum = spectrum_of(tone, 100.0, 512);
  ASSERT_TRUE(spectrum.has_value());
  const auto peak = std::ranges::max_element(spectrum->density[0]) - spectrum->density[0].begin();
  EXPECT_DOUBLE_EQ(spectrum->frequency_hz[static_cast<std::size_t>(peak)], 12.5);
  double power = 0.0;
  for (const double density : spectrum->density[0]) power += density * density * 100.0 / 512.0;
  EXPECT_NEAR(power, kAmplitude * kAmplitude / 2.0, 1e-3 * kAmplitude * kAmplitude);
  EXPECT_EQ(spectrum->samples, 4096U);
}

TEST(Spectrum, DoesNotReachOverAGap) {
  auto all = points(700, [](std::size_t i) { return static_cast<double>(i % 7); });
  for (std::size_t i = 300; i < all.size(); ++i) all[i].stamp_ns += 10 * kPeriodNs;
  const auto spectrum = spectrum_of(all, 100.0, 256);
  ASSERT_TRUE(spectrum.has_value());
  EXPECT_EQ(spectrum->samples, 256U + 384U) << "one stretch before the gap, two that overlap behind it";
}

TEST(Spectrum, WaitsForEnoughSamples) {
  EXPECT_FALSE(stretch_for(511).has_value());
  EXPECT_EQ(stretch_for(512), 256U);
  EXPECT_EQ(stretch_for(6000), 1024U);
  EXPECT_EQ(stretch_for(1'000'000), kMostStretch);
  EXPECT_FALSE(spectrum_of({}, 100.0, 256).has_value());
}

}  // namespace
}  // namespace gyrod::live
