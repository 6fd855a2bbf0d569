/// What answers before the first window has been fitted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/joint/bank_estimate.hpp"
#include "core/joint/joint_options.hpp"

namespace gyrod::core {

/// Local levels seen in white noise,
///   x[t] = x[t-1] + w,   z[t] = x[t] + v,   var w = ratio var v,
/// one for each of some ratios, from calm to wild, each with the exact gains of a filter that knows nothing before its first sample:
///   X[t] = P[t-1] + ratio,   K[t] = X[t] / (X[t] + 1),   P[t] = X[t] / (X[t] + 1)   in parts of var v,
/// weighed by how well they expect what comes, with a power of their likelihoods and a fixed share. The estimate at lag L is x[t-L] given z[..t], as the bank's.
/// Allocates nothing. Finite for input whose differences are. Not thread-safe.
/// Source: Anderson, Moore 1979, "Optimal filtering", sections 3.1 and 7.3.
class StartLevels {
 public:
  /// Forgets the samples, not what is expected.
  void reset() noexcept;
  /// var v, unit^2, where the sensor's noise is known; 0: it is guessed from fourth differences, which motion makes larger.
  void expect_noise(double variance) noexcept { known_variance_ = variance; }
  /// A guess is no more than this from here on, unit^2; infinite after reset(). For what the sensor's other axes tell.
  void bound_guess(double variance) noexcept { most_ = variance; }
  /// Takes z[t].
  void step(double sample) noexcept;

  /// Of x[t-lag]. @pre lag is less than the number of samples taken, and at most kMaxLag
  [[nodiscard]] BankEstimate estimate(std::size_t lag) const noexcept;
  /// Variance that the levels expect at this lag, as far as they agree. @pre as estimate()
  [[nodiscard]] double expected_variance(std::size_t lag) const noexcept;
  /// var v as known or guessed, unit^2; 0 before there is a guess.
  [[nodiscard]] double noise_variance() const noexcept { return variance_; }

 private:
  static constexpr std::array<double, 4> kRatios = {1e-4, 0.02, 1.0, 20.0};
  static constexpr double kEven =
      1.0 / static_cast<double>(kRatios.size());  ///< weight of one, where nothing speaks for another
  /// Ring of the last samples; a power of two beyond kMaxLag.
  static constexpr std::size_t kHeld = 64;
  static_assert(kHeld > kMaxLag && (kHeld & (kHeld - 1)) == 0);

  struct Level {
    double x = 0.0;         ///< given all samples
    double variance = 0.0;  ///< P
    double weight = 0.0;
    std::array<double, kHeld> prediction{};
    std::array<double, kHeld> innovation{};
    std::array<double, kHeld> uncertainty{};  ///< X
  };
  struct Smoothed {
    double rate = 0.0;
    double variance = 0.0;  ///< in parts of var v
  };

  void guess_variance(double sample) noexcept;
  void weigh() noexcept;
  [[nodiscard]] Smoothed smoothed(const Level& level, std::size_t lag) const noexcept;

  std::array<Level, kRatios.size()> levels_{};
  std::uint64_t count_ = 0;
  double known_variance_ = 0.0;
  double variance_ = 0.0;
  double guess_ = 0.0;  ///< by differences
  double most_ = std::numeric_limits<double>::infinity();
  std::array<double, 4> differences_{};  ///< the last sample, and its differences of orders 1 to 3
  double guesses_ = 0.0;                 ///< that make up the guess
};

}  // namespace gyrod::core
