/// Allan deviation of a rate that keeps coming: octave cluster times, fixed memory, whatever the length.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/allan/allan_deviation.hpp"

namespace gyrod::core {

/// Cluster sizes m = 1, 2, 4 .. 2^23 samples: at 100 Hz 10 ms to 23 h.
inline constexpr std::size_t kAllanOctaves = 24;

/// A cluster is moved on by an eighth of itself, or by one sample where that is less.
inline constexpr std::size_t kAllanShare = 8;

/// m of an octave, samples.
[[nodiscard]] constexpr std::size_t allan_cluster(std::size_t octave) noexcept {
  return std::size_t{1} << octave;
}

/// s of an octave, samples: from one term to the next.
[[nodiscard]] constexpr std::size_t allan_stride(std::size_t octave) noexcept {
  return std::max<std::size_t>(1, allan_cluster(octave) / kAllanShare);
}

/// All that is known of a curve. Plain numbers, to be kept across restarts.
struct AllanSums {
  /// Of (x_{k+2m} - 2 x_{k+m} + x_k)^2, (rad/s)^2.
  std::array<double, kAllanOctaves> squares{};
  std::array<std::uint64_t, kAllanOctaves> terms{};
  friend bool operator==(const AllanSums&, const AllanSums&) = default;
};

/// The estimator. Over every unbroken stretch of N samples, x_k the sum of its first k, k = 0, s, 2s .. N - 2m:
///   sigma^2(m) = 1 / (2 m^2 M) sum (x_{k+2m} - 2 x_{k+m} + x_k)^2,   M terms in all stretches,   s = max(1, m / 8).
/// For one stretch and m <= 8 these are the terms of allan_deviation_at(); above, an eighth of m apart, every s-th of them, which
/// tell nearly as much: neighbours in between are all but the same number.
///
/// x_k is an integer, in parts of kQuantum, modulo 2^64: sums never drift, and differences are exact, after a sample as after a year.
/// What is rounded is a sample, by 2^-35 rad/s at the most (6e-6 deg/h), and the sums of squares, which are compensated
/// (Neumaier): some 1e-16 of them, whatever the number of terms.
///
/// 4 kB, copied as plain memory. A sample costs five terms on average and 24 at the worst; nothing allocates. One thread at a time.
class OnlineAllan {
 public:
  /// rad/s
  static constexpr double kQuantum = 1.0 / (1ULL << 34U);
  /// rad/s; a rate beyond this, or one that is not finite, is a gap. Below, no difference can overflow.
  static constexpr double kMostRate = 32.0;

  void step(double rate) noexcept;

  /// A gap: clusters at work are given up, sums stay.
  void interrupt() noexcept { samples_ = 0; }

  [[nodiscard]] AllanSums sums() const noexcept;

  /// Goes on from sums of an earlier run, as after a gap.
  void restore(const AllanSums& sums) noexcept;

 private:
  /// Of one cluster size: the newest x_k, k a multiple of s, two clusters of them and one more.
  struct Octave {
    std::array<std::uint64_t, 2 * kAllanShare + 1> angles{};
    std::uint32_t newest = 0;
    std::uint32_t held = 0;
    std::uint64_t terms = 0;
    double squares = 0.0;
    double carry = 0.0;  ///< what rounding took from squares
  };

  void begin_stretch() noexcept;
  static void add(Octave& octave, std::size_t lag, std::uint64_t angle) noexcept;

  std::array<Octave, kAllanOctaves> octaves_{};
  std::uint64_t angle_ = 0;    ///< x, in parts of kQuantum, modulo 2^64
  std::uint64_t samples_ = 0;  ///< of this stretch
};

/// Whether a program could have made these: finite, no term without a square's room, no longer cluster with more terms.
[[nodiscard]] bool is_possible(const AllanSums& sums) noexcept;

/// The curve as far as it is known, ascending in tau: a point where there is a term. Degrees of freedom and interval as in
/// allan_deviation(), the terms taken for those of one stretch, which is the careful side; the kind of noise from the slope to the
/// next shorter cluster time: sigma^2 ~ tau^-2, tau^-1, 1, tau.
/// AllanPoint::terms counts terms that are s apart.
/// @pre sample_rate_hz > 0
[[nodiscard]] std::vector<AllanPoint> allan_points(const AllanSums& sums, double sample_rate_hz,
                                                   double confidence = AllanOptions{}.confidence);

/// sigma of an octave, rad/s; 0 where there is no term.
[[nodiscard]] double allan_deviation_of(const AllanSums& sums, std::size_t octave) noexcept;

}  // namespace gyrod::core
