/// Whether the noise can be what an estimate took away. Internal to core/joint.
#pragma once

#include "core/joint/bank_estimate.hpp"
#include "core/joint/joint_options.hpp"

namespace gyrod::core {

/// Most that one square of a residual or an innovation, in parts of its variance, adds to a mean of them: a knock is over soon, and is to be forgotten soon.
inline constexpr double kMostToMean = 100.0;
/// Most that such a square says: a million deviations. What is multiplied with it stays a number.
inline constexpr double kMostSurprise = 1e12;

/// Of one output. What a good estimate e takes off a sample z is noise, of a variance R that is known: d^2 / R with d = z - e is 1 at the
/// most in the mean, and hardly ever above 25. Where it is more, e is what is wrong: a knock that no model expected, smeared by the filters over
/// what came before and after it. There the sample counts by as much as e is the worse of the two:
///   e + w d,   w = max(0, 1 - residual_limit R / d^2, 1 - residual_mean_limit / m),   m <- m + (d^2 / R - m) / residual_memory,
/// which is never farther from the sample than sqrt(residual_limit R), and the nearer the farther off e is.
/// A sample that is wrong by itself is no knock: motion lasts. Where the samples about it are known, d^2 counts lone_limit times the largest of
/// theirs at the most, and R at the least.
/// A plain value; finite for finite arguments.
class ResidualCheck {
 public:
  /// @param expected_variance R, and the variance of what else the estimate leaves out on purpose; 0 while unknown, infinite where
  /// anything may be left out: then the estimate stays as it is
  /// @param beside largest d^2 of the samples about it; infinite where these are not known
  /// @return e + w d; where w > 0, with a variance that knows of both
  [[nodiscard]] BankEstimate apply(double sample, BankEstimate estimate, double expected_variance,
                                   double beside, const JointOptions& options) noexcept;

 private:
  double mean_square_ = 1.0;  ///< m
};

}  // namespace gyrod::core
