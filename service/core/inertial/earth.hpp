/// The WGS-84 ellipsoid, its normal gravity and its rotation. North-east-down (NED) axes throughout. All
/// functions are pure, allocate nothing and are safe to call from any thread.
///
/// Sources: [NIMA] NIMA TR8350.2, third edition 2000, tables 3.1, 3.3, 3.4 and section 4; [Groves] Groves 2013,
/// "Principles of GNSS, Inertial, and Multisensor Integrated Navigation Systems", chapters 2 and 5.
#pragma once

#include <Eigen/Core>

namespace gyrod::core {

inline constexpr double kEarthSemiMajorAxis_m = 6378137.0;       ///< a, [NIMA] table 3.1
inline constexpr double kEarthFlattening = 1.0 / 298.257223563;  ///< f, [NIMA] table 3.1
inline constexpr double kEarthEccentricitySquared = kEarthFlattening * (2.0 - kEarthFlattening);  ///< e^2
inline constexpr double kEarthRate_radps = 7.292115e-5;          ///< [NIMA] table 3.1
inline constexpr double kGravityAtEquator_mps2 = 9.7803253359;   ///< [NIMA] table 3.4
inline constexpr double kGravityAtPole_mps2 = 9.8321849378;      ///< [NIMA] table 3.4
inline constexpr double kSomiglianaConstant = 0.00193185265241;  ///< k, [NIMA] table 3.4
inline constexpr double kGravityRatio = 0.00344978650684;        ///< m = w^2 a^2 b / GM, [NIMA] table 3.4

/// A place above the ellipsoid.
struct GeodeticPosition {
  double latitude_rad = 0.0;  ///< geodetic, north positive
  double longitude_rad = 0.0;
  double height_m = 0.0;  ///< above the ellipsoid
};

/// Radius of curvature along the meridian, m: M = a (1 - e^2) / (1 - e^2 sin^2 L)^(3/2). [Groves] eq. (2.105)
[[nodiscard]] double meridian_radius_m(double latitude_rad) noexcept;

/// Radius of curvature across the meridian, m: N = a / (1 - e^2 sin^2 L)^(1/2). [Groves] eq. (2.106)
[[nodiscard]] double transverse_radius_m(double latitude_rad) noexcept;

/// Normal gravity, m/s^2, which holds the centrifugal part, pointing down:
///   g0 = g_e (1 + k sin^2 L) / (1 - e^2 sin^2 L)^(1/2),                            [NIMA] eq. (4-1)
///   g  = g0 (1 - 2 (1 + f + m - 2 f sin^2 L) h / a + 3 h^2 / a^2).                 [NIMA] eq. (4-3)
/// Good to about 1e-6 m/s^2 below 20 km. Its small horizontal part above the ellipsoid (8e-9 m/s^2 per m of
/// height at most) and the earth's real anomalies (up to some 1e-3 m/s^2) are left out.
[[nodiscard]] double normal_gravity_mps2(double latitude_rad, double height_m) noexcept;

/// Rotation of the earth against the stars in NED axes, rad/s: w (cos L, 0, -sin L). [Groves] eq. (5.37)
[[nodiscard]] Eigen::Vector3d earth_rate_radps(double latitude_rad) noexcept;

/// Rotation of the NED axes against the earth, rad/s: (v_E/(N+h), -v_N/(M+h), -v_E tan L/(N+h)).
/// [Groves] eq. (5.44). @pre not at a pole
[[nodiscard]] Eigen::Vector3d transport_rate_radps(const GeodeticPosition& position,
                                                   const Eigen::Vector3d& velocity_mps) noexcept;

/// Where one gets from `from` by going `path_m` north, east, down; radii are taken in the middle of the way.
/// For ways up to some kilometres: the error grows with the cube of the way. @pre not at a pole
[[nodiscard]] GeodeticPosition moved(const GeodeticPosition& from, const Eigen::Vector3d& path_m) noexcept;

/// Metres north, east, down from one place to another: moved() turned round.
[[nodiscard]] Eigen::Vector3d way_m(const GeodeticPosition& from, const GeodeticPosition& to) noexcept;

}  // namespace gyrod::core
