#include "core/inertial/earth.hpp"

#include <cmath>
#include <numbers>

namespace gyrod::core {
namespace {

/// 1 - e^2 sin^2 L
double curvature(double latitude_rad) noexcept {
  const double sine = std::sin(latitude_rad);
  return 1.0 - kEarthEccentricitySquared * sine * sine;
}

}  // namespace

double meridian_radius_m(double latitude_rad) noexcept {
  const double w = curvature(latitude_rad);
  return kEarthSemiMajorAxis_m * (1.0 - kEarthEccentricitySquared) / (w * std::sqrt(w));
}

double transverse_radius_m(double latitude_rad) noexcept {
  return kEarthSemiMajorAxis_m / std::sqrt(curvature(latitude_rad));
}

double normal_gravity_mps2(double latitude_rad, double height_m) noexcept {
  const double sine = std::sin(latitude_rad);
  const double at_ellipsoid =
      kGravityAtEquator_mps2 * (1.0 + kSomiglianaConstant * sine * sine) / std::sqrt(curvature(latitude_rad));
  const double share = height_m / kEarthSemiMajorAxis_m;
  const double slope = 1.0 + kEarthFlattening + kGravityRatio - 2.0 * kEarthFlattening * sine * sine;
  return at_ellipsoid * (1.0 - 2.0 * slope * share + 3.0 * share * share);
}

Eigen::Vector3d earth_rate_radps(double latitude_rad) noexcept {
  return {kEarthRate_radps * std::cos(latitude_rad), 0.0, -kEarthRate_radps * std::sin(latitude_rad)};
}

Eigen::Vector3d transport_rate_radps(const GeodeticPosition& position,
                                     const Eigen::Vector3d& velocity_mps) noexcept {
  const double east = velocity_mps.y() / (transverse_radius_m(position.latitude_rad) + position.height_m);
  const double north = velocity_mps.x() / (meridian_radius_m(position.latitude_rad) + position.height_m);
  return {east, -north, -east * std::tan(position.latitude_rad)};
}

GeodeticPosition moved(const GeodeticPosition& from, const Eigen::Vector3d& path_m) noexcept {
  const double height = from.height_m - 0.5 * path_m.z();
  const double first_turn = 0.5 * path_m.x() / (meridian_radius_m(from.latitude_rad) + height);
  const double turn = path_m.x() / (meridian_radius_m(from.latitude_rad + first_turn) + height);
  const double middle = from.latitude_rad + 0.5 * turn;
  return {from.latitude_rad + turn,
          from.longitude_rad + path_m.y() / ((transverse_radius_m(middle) + height) * std::cos(middle)),
          from.height_m - path_m.z()};
}

Eigen::Vector3d way_m(const GeodeticPosition& from, const GeodeticPosition& to) noexcept {
  const double height = 0.5 * (from.height_m + to.height_m);
  const double middle = 0.5 * (from.latitude_rad + to.latitude_rad);
  // The shorter way round the earth.
  const double turn = std::remainder(to.longitude_rad - from.longitude_rad, 2.0 * std::numbers::pi);
  return {(to.latitude_rad - from.latitude_rad) * (meridian_radius_m(middle) + height),
          turn * (transverse_radius_m(middle) + height) * std::cos(middle), from.height_m - to.height_m};
}

}  // namespace gyrod::core
