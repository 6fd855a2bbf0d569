// The ellipsoid against its published values and against its own geometry.
#include "core/inertial/earth.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace gyrod::core {
namespace {

constexpr double kRight = std::numbers::pi / 2.0;

// NIMA TR8350.2 table 3.4 gives both ends; Somigliana's k has 12 digits, so that the pole comes out to 1e-10.
TEST(Earth, GravityIsThePublishedOneAtEquatorAndPole) {
  EXPECT_DOUBLE_EQ(normal_gravity_mps2(0.0, 0.0), 9.7803253359);
  EXPECT_NEAR(normal_gravity_mps2(kRight, 0.0), 9.8321849378, 1e-10);
  EXPECT_DOUBLE_EQ(normal_gravity_mps2(-0.7, 100.0), normal_gravity_mps2(0.7, 100.0));
}

// The free-air gradient at 45 deg is 3.0856e-6 /s^2 (Torge 2001, "Geodesy", eq. 4.64: 0.30856 mGal/m), four
// digits; over 1 km the quadratic term adds 7e-10.
TEST(Earth, GravityFallsWithTheFreeAirGradient) {
  const double gradient =
      (normal_gravity_mps2(kRight / 2.0, 1000.0) - normal_gravity_mps2(kRight / 2.0, 0.0)) / 1000.0;
  EXPECT_NEAR(gradient, -3.0856e-6, 2e-9);
}

// NIMA TR8350.2 table 3.3: semi-minor axis b, radius of curvature at the pole c = a^2 / b.
TEST(Earth, RadiiAreThoseOfTheEllipsoid) {
  constexpr double kSemiMinor_m = 6356752.3142;
  constexpr double kPolar_m = 6399593.6258;
  EXPECT_DOUBLE_EQ(transverse_radius_m(0.0), kEarthSemiMajorAxis_m);
  EXPECT_NEAR(meridian_radius_m(0.0), kSemiMinor_m * kSemiMinor_m / kEarthSemiMajorAxis_m, 1e-3);
  EXPECT_NEAR(transverse_radius_m(kRight), kPolar_m, 1e-3);
  EXPECT_NEAR(meridian_radius_m(kRight), kPolar_m, 1e-3);
}

// Definition: M dL is the way along the meridian. The quarter meridian is 10001965.729 m (Torge 2001, table 4.1).
TEST(Earth, MeridianRadiusIntegratesToTheQuarterMeridian) {
  constexpr int kSteps = 2000;
  double sum = 0.0;
  for (int n = 0; n < kSteps; ++n) sum += meridian_radius_m(kRight * (n + 0.5) / kSteps);
  EXPECT_NEAR(sum * kRight / kSteps, 10001965.729, 1e-2);
}

TEST(Earth, TurnsAboutItsAxis) {
  EXPECT_NEAR((earth_rate_radps(0.0) - Eigen::Vector3d(kEarthRate_radps, 0.0, 0.0)).norm(), 0.0, 1e-20);
  EXPECT_NEAR((earth_rate_radps(kRight) - Eigen::Vector3d(0.0, 0.0, -kEarthRate_radps)).norm(), 0.0, 1e-20);
  EXPECT_NEAR(earth_rate_radps(0.6).norm(), kEarthRate_radps, 1e-20);
}

TEST(Earth, GoingNorthTurnsTheFrameAboutWestAndGoingEastAboutTheEarthsAxis) {
  const GeodeticPosition place{0.6, 0.2, 500.0};
  const Eigen::Vector3d north = transport_rate_radps(place, {100.0, 0.0, 0.0});
  EXPECT_DOUBLE_EQ(north.y(), -100.0 / (meridian_radius_m(0.6) + 500.0));
  EXPECT_EQ(north.x(), 0.0);
  EXPECT_EQ(north.z(), 0.0);
  // Going east is turning faster with the earth: w_en is parallel to w_ie.
  const Eigen::Vector3d east = transport_rate_radps(place, {0.0, 100.0, 0.0});
  EXPECT_NEAR(east.cross(earth_rate_radps(0.6)).norm(), 0.0, 1e-24);
  EXPECT_GT(east.dot(earth_rate_radps(0.6)), 0.0);
}

Eigen::Vector3d cartesian(const GeodeticPosition& place) {
  const double n = transverse_radius_m(place.latitude_rad);
  const double cosine = std::cos(place.latitude_rad);
  return {(n + place.height_m) * cosine * std::cos(place.longitude_rad),
          (n + place.height_m) * cosine * std::sin(place.longitude_rad),
          ((1.0 - kEarthEccentricitySquared) * n + place.height_m) * std::sin(place.latitude_rad)};
}

// The straight line between the two places in earth-fixed coordinates, Groves 2013 eq. (2.112): over 50 m an arc
// is longer than its chord by 1e-10 m.
TEST(Earth, AWayIsAsLongAsTheStraightLineThroughSpace) {
  const GeodeticPosition from{0.8, 2.0, 300.0};
  const Eigen::Vector3d path(30.0, -40.0, 5.0);
  EXPECT_NEAR((cartesian(moved(from, path)) - cartesian(from)).norm(), path.norm(), 2e-5);
}

TEST(Earth, AWayThereAndItsMeasureAgree) {
  const GeodeticPosition from{-0.5, std::numbers::pi - 1e-6, 1000.0};  // the way crosses the date line
  const Eigen::Vector3d path(1500.0, 800.0, -60.0);
  EXPECT_LT((way_m(from, moved(from, path)) - path).norm(), 1e-6);  // cube of the way over the radius squared
}

}  // namespace
}  // namespace gyrod::core
