#include "files/truth_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <span>
#include <string_view>

#include "core/inertial/attitude.hpp"
#include "files/file_error.hpp"

namespace gyrod::files {
namespace {

using Names = std::span<const std::string_view>;
using Values = std::vector<const std::vector<double>*>;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kLargestNormError = 0.01;  // a quaternion further from length one is none

constexpr std::array<std::string_view, 4> kQuaternion = {"q_w", "q_x", "q_y", "q_z"};
constexpr std::array<std::string_view, 3> kEuler = {"roll_deg", "pitch_deg", "heading_deg"};
constexpr std::array<std::string_view, 3> kEulerYaw = {"roll_deg", "pitch_deg", "yaw_deg"};
constexpr std::array<std::string_view, 3> kGeodetic = {"lat_deg", "lon_deg", "h_m"};
constexpr std::array<std::string_view, 3> kLocal = {"p_x_m", "p_y_m", "p_z_m"};
constexpr std::array<std::string_view, 3> kLocalLong = {"pos_x_m", "pos_y_m", "pos_z_m"};
constexpr std::array<std::string_view, 3> kVelocityDown = {"vn_mps", "ve_mps", "vd_mps"};
constexpr std::array<std::string_view, 3> kVelocityUp = {"vn_mps", "ve_mps", "vu_mps"};
constexpr std::array<Names, 8> kSets = {kQuaternion, kEuler,     kEulerYaw,     kGeodetic,
                                        kLocal,      kLocalLong, kVelocityDown, kVelocityUp};

/// The columns of a set, or nothing unless all are there.
Values find(const ColumnMap& columns, const std::string& prefix, Names names) {
  Values values;
  for (const std::string_view name : names) {
    const auto found = columns.find(prefix + std::string(name));
    if (found == columns.end()) return {};
    values.push_back(&found->second);
  }
  return values;
}

Eigen::Vector3d vector_of(const Values& values, std::size_t n) {
  return {(*values[0])[n], (*values[1])[n], (*values[2])[n]};
}

Eigen::Quaterniond quaternion_at(const Values& values, std::size_t n) {
  Eigen::Quaterniond q((*values[0])[n], (*values[1])[n], (*values[2])[n], (*values[3])[n]);
  const double norm = q.norm();
  if (!(std::abs(norm - 1.0) <= kLargestNormError)) q.coeffs().setConstant(kNan);
  return core::ned_from_z_up(Eigen::Quaterniond(q.coeffs() / norm));
}

void add_attitude(const ColumnMap& columns, const std::string& prefix, core::Truth& truth) {
  if (const Values q = find(columns, prefix, kQuaternion); !q.empty()) {
    for (std::size_t n = 0; n < truth.size(); ++n) truth.attitude.push_back(quaternion_at(q, n));
    return;
  }
  Values angles = find(columns, prefix, kEuler);
  if (angles.empty()) angles = find(columns, prefix, kEulerYaw);
  if (angles.empty()) return;
  for (std::size_t n = 0; n < truth.size(); ++n) {
    const Eigen::Vector3d a = kRadPerDeg * vector_of(angles, n);
    truth.attitude.push_back(core::attitude_of({a.x(), a.y(), a.z()}));
  }
}

void add_velocity(const ColumnMap& columns, const std::string& prefix, core::Truth& truth) {
  const Values down = find(columns, prefix, kVelocityDown);
  const Values up = find(columns, prefix, kVelocityUp);
  if (down.empty() && up.empty()) return;
  for (std::size_t n = 0; n < truth.size(); ++n) {
    Eigen::Vector3d v = vector_of(down.empty() ? up : down, n);
    if (down.empty()) v.z() = -v.z();
    truth.velocity_mps.push_back(v);
  }
}

void add_geodetic(const Values& values, core::Truth& truth) {
  for (std::size_t n = 0; n < truth.size(); ++n) {
    const Eigen::Vector3d p = vector_of(values, n);
    truth.position.push_back({kRadPerDeg * p.x(), kRadPerDeg * p.y(), p.z()});
  }
}

/// Puts the first known place of the level frame at the reference.
void add_local(const Values& values, const core::GeodeticPosition& reference, core::Truth& truth) {
  std::optional<Eigen::Vector3d> origin;
  for (std::size_t n = 0; n < truth.size(); ++n) {
    const Eigen::Vector3d p = vector_of(values, n);
    if (!origin && p.allFinite()) origin = p;
    truth.position.push_back(p.allFinite() ? core::moved(reference, core::ned_from_z_up(p - *origin))
                                           : core::GeodeticPosition{kNan, kNan, kNan});
  }
}

bool same(const core::GeodeticPosition& a, const core::GeodeticPosition& b) {
  return a.latitude_rad == b.latitude_rad && a.longitude_rad == b.longitude_rad && a.height_m == b.height_m;
}

/// Keeps the first row of each repetition where most rows are repetitions. @return rows left out
std::size_t leave_out_held(core::Truth& truth) {
  const auto& all = truth.position;
  std::size_t repeated = 0;
  for (std::size_t n = 1; n < all.size(); ++n) repeated += same(all[n], all[n - 1]) ? 1U : 0U;
  if (2 * repeated < all.size()) return 0;
  core::Truth kept;
  for (std::size_t n = 0; n + 1 < all.size(); ++n) {
    // A row between two repetitions is one that resampling put between two of the reference's own.
    if ((n > 0 && same(all[n], all[n - 1])) || !same(all[n], all[n + 1])) continue;
    kept.time_s.push_back(truth.time_s[n]);
    kept.position.push_back(all[n]);
  }
  const std::size_t held = truth.size() - kept.size();
  truth = std::move(kept);
  return held;
}

std::string listed(const std::vector<std::string>& prefixes) {
  std::string text;
  for (const std::string& prefix : prefixes) {
    text += (text.empty() ? "'" : ", '") + prefix + "'";
  }
  return text;
}

}  // namespace

std::vector<std::string> truth_prefixes(const ColumnMap& columns) {
  std::set<std::string> prefixes;
  for (const auto& [name, values] : columns) {
    for (const Names names : kSets) {
      if (!name.ends_with(names.front())) continue;
      const std::string prefix = name.substr(0, name.size() - names.front().size());
      const bool whole_word = prefix.empty() || prefix.ends_with('_');
      if (whole_word && !find(columns, prefix, names).empty()) prefixes.insert(prefix);
    }
  }
  return {prefixes.begin(), prefixes.end()};
}

std::optional<std::string> chosen_prefix(const ColumnMap& columns, const std::string& name,
                                         const std::optional<std::string>& wanted) {
  const std::vector<std::string> prefixes = truth_prefixes(columns);
  if (!wanted) {
    if (prefixes.size() > 1) {
      throw FileError(name + ": several references; name one of the prefixes " + listed(prefixes) +
                      " by --truth");
    }
    return prefixes.empty() ? std::nullopt : std::optional(prefixes.front());
  }
  for (const std::string& prefix : {*wanted, *wanted + "_"}) {
    if (std::ranges::find(prefixes, prefix) != prefixes.end()) return prefix;
  }
  throw FileError(name + ": no reference with the prefix '" + *wanted + "' of --truth; " +
                  (prefixes.empty() ? "expected columns such as " + *wanted + "_q_w, " + *wanted +
                                          "_lat_deg or " + *wanted + "_vn_mps, found " + names_of(columns)
                                    : "there is " + listed(prefixes)));
}

NavigationTruth build_truth(const ColumnMap& columns, const std::string& prefix, std::vector<double> time_s,
                            const core::GeodeticPosition& reference) {
  NavigationTruth built;
  core::Truth& truth = built.truth;
  truth.time_s = std::move(time_s);
  add_attitude(columns, prefix, truth);
  add_velocity(columns, prefix, truth);
  if (const Values geodetic = find(columns, prefix, kGeodetic); !geodetic.empty()) {
    add_geodetic(geodetic, truth);
  } else {
    Values local = find(columns, prefix, kLocal);
    if (local.empty()) local = find(columns, prefix, kLocalLong);
    built.local = !local.empty();
    if (built.local) add_local(local, reference, truth);
  }
  if (truth.has_position() && !truth.has_attitude() && !truth.has_velocity())
    built.held = leave_out_held(truth);

  const double span_s = truth.size() > 1 ? truth.time_s.back() - truth.time_s.front() : 0.0;
  const double spacing_s = span_s / static_cast<double>(std::max<std::size_t>(truth.size(), 2) - 1);
  built.max_gap_s = std::clamp(10.0 * spacing_s, kShortestTruthGap_s, kLongestTruthGap_s);
  if (truth.has_position() && !truth.has_velocity()) {
    built.velocity_differentiated = true;
    truth.velocity_mps =
        core::differentiated(truth.time_s, truth.position, kVelocityHalfWidth_s, built.max_gap_s);
  }
  return built;
}

}  // namespace gyrod::files
