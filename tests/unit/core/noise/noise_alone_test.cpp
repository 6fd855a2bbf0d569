// Densities without chance: each rule has its own spectrum that breaks it.
#include "core/noise/noise_alone.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

constexpr double kSegments = 16.0;

using Shape = std::function<double(double)>;

/// Of a second order low-pass: 1 / (1 + (bin / 50)^4), that of a tenth of the rate.
double second_order(double bin) { return 1.0 / (1.0 + std::pow(bin / 50.0, 4.0)); }

/// Sums over kSegments segments of spectra with this density at a bin, times an axis's scale.
AxisDensities densities(const Shape& shape, const std::array<double, kSensorAxes>& scale = {1.0, 1.0, 1.0}) {
  const AxisBands bands;
  AxisDensities result;
  result.count = kSegments;
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    for (std::size_t band = 0; band < bands.size(); ++band) {
      const double centre = 0.5 * static_cast<double>(bands.edge(band) + bands.edge(band + 1) - 1);
      result.own[axis][band] = kSegments * scale[axis] * shape(centre);
    }
  }
  return result;
}

AxisBands::Axes nothing_seen() {
  AxisBands::Axes least;
  for (auto& axis : least) axis.fill(std::numeric_limits<double>::infinity());
  return least;
}

std::optional<NoiseAlone> found(const AxisDensities& before, const AxisDensities& now,
                                const AxisBands::Axes& least = nothing_seen(), double motion_bins = 10.0) {
  return find_noise_alone(AxisBands(), before, now, least, motion_bins);
}

std::optional<NoiseAlone> found(const AxisDensities& both) { return found(both, both); }

TEST(NoiseAlone, IsAllOfASpectrumWithoutMotion) {
  const auto noise = found(densities(second_order, {1.0, 2.0, 0.9}));
  ASSERT_TRUE(noise);
  EXPECT_EQ(noise->first, 0U);
  EXPECT_NEAR(noise->density[1][0], 2.0 * second_order(3.5), 1e-12);
  EXPECT_TRUE(noise->tells(0));
  EXPECT_FALSE(noise->tells(AxisBands().size() - 1)) << "a hundredth";
}

// Turns and a road, ten times the noise up to bin 20, each axis its own.
TEST(NoiseAlone, BeginsWhereMotionEnds) {
  AxisDensities moving = densities(second_order);
  const AxisBands bands;
  std::size_t end = 0;
  for (std::size_t band = 0; bands.edge(band) < 20; end = ++band) {
    moving.own[0][band] *= 1000.0 / static_cast<double>(bands.edge(band) * bands.edge(band));
    moving.own[1][band] *= 30.0;
  }
  const auto noise = found(moving);
  ASSERT_TRUE(noise);
  EXPECT_EQ(noise->first, end);
  EXPECT_FALSE(noise->tells(end - 1));
  EXPECT_LT(noise->flat_density, noise->likeness.middle[end]);
  EXPECT_GT(noise->flat_density, 0.75 * noise->likeness.middle[end]);
}

TEST(NoiseAlone, EndsInNoFloor) {
  EXPECT_FALSE(found(densities([](double) { return 1.0; })));
  EXPECT_FALSE(found(densities([](double bin) { return second_order(bin) + 0.12; })));
  EXPECT_TRUE(found(densities([](double bin) { return second_order(bin) + 0.015; })));
  EXPECT_FALSE(found(densities([](double bin) { return second_order(bin) + 0.05; })))
      << "as white noise under motion that falls off";
}

TEST(NoiseAlone, IsNarrow) {
  const auto steep = [](double edge) { return [edge](double bin) { return bin < edge ? 1.0 : 0.01; }; };
  EXPECT_TRUE(found(densities(steep(150.0)))) << "to bin 140: 0.58 of the bins";
  EXPECT_FALSE(found(densities(steep(200.0)))) << "to bin 218: 0.85";
}

TEST(NoiseAlone, IsFlatWhereItBegins) {
  EXPECT_FALSE(found(densities([](double bin) { return std::pow(bin, -3.0); })));
  EXPECT_FALSE(found(densities([](double bin) { return std::exp(-bin / 3.0); })));
}

TEST(NoiseAlone, IsFlatBeyondMotion) {
  const AxisDensities noise = densities(second_order);  // to bin 39
  EXPECT_TRUE(found(noise, noise, nothing_seen(), 38.0));
  EXPECT_FALSE(found(noise, noise, nothing_seen(), 60.0));
}

TEST(NoiseAlone, HasNoHump) {
  EXPECT_FALSE(found(densities(
      [](double bin) { return second_order(bin) + 5.0 * std::exp(-std::pow((bin - 150.0) / 15.0, 2.0)); })));
}

TEST(NoiseAlone, IsAlikeOnAllAxesAndOfASize) {
  EXPECT_TRUE(found(densities(second_order, {1.0, 2.9, 1.0})));
  EXPECT_FALSE(found(densities(second_order, {1.0, 3.1, 1.0})));
  AxisDensities unlike = densities(second_order);
  for (std::size_t band = 0; band < AxisBands().size(); ++band)
    unlike.own[2][band] = densities([](double bin) { return second_order(2.0 * bin); }).own[2][band];
  EXPECT_FALSE(found(unlike));
  AxisDensities dead = densities(second_order);
  dead.own[1] = {};
  EXPECT_FALSE(found(dead));
}

TEST(NoiseAlone, IsSharedByNoTwoAxes) {
  AxisDensities shared = densities(second_order);
  for (std::size_t band = 0; band < AxisBands().size(); ++band)
    shared.shared[2][band] = -0.2 * shared.own[0][band];
  EXPECT_TRUE(found(shared)) << "4 % of its power";
  for (std::size_t band = 0; band < AxisBands().size(); ++band)
    shared.shared[2][band] = -0.5 * shared.own[0][band];
  EXPECT_FALSE(found(shared)) << "a quarter";
}

TEST(NoiseAlone, IsSteady) {
  // Two bins of 16 segments: a factor of 1.2 e^(4 sqrt(2 / 32)) = 3.3; the widest band that tells has 20: 1.6.
  EXPECT_TRUE(found(densities(second_order), densities(second_order, {1.5, 1.0, 1.0})));
  EXPECT_FALSE(found(densities(second_order), densities(second_order, {1.8, 1.0, 1.0})));
  EXPECT_FALSE(found(densities(second_order, {1.8, 1.0, 1.0}), densities(second_order)));
}

TEST(NoiseAlone, IsTheLeastThatHasBeenSeen) {
  const AxisDensities noise = densities(second_order);
  const auto seen = [&noise](double factor) {
    AxisBands::Axes least = noise.own;
    for (double& density : least[1]) density *= factor / kSegments;
    for (double& density : least[0]) density = std::numeric_limits<double>::infinity();
    return least;
  };
  EXPECT_TRUE(found(noise, noise, seen(0.7)));
  EXPECT_FALSE(found(noise, noise, seen(0.5)));
}

}  // namespace
}  // namespace gyrod::core
