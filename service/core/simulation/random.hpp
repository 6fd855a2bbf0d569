/// Random numbers that are the same bits on every machine with IEEE 754 doubles.
#pragma once

#include <array>
#include <cstdint>

namespace gyrod::core {

/// xoshiro256++ 1.0 (Blackman & Vigna 2019, "Scrambled linear pseudorandom number generators", period 2^256 -
/// 1), its state filled by splitmix64 (Steele, Lea & Flood 2014), as its authors advise. The standard
/// library's distributions are not used: their values differ from one implementation to the next.
class Random {
 public:
  explicit Random(std::uint64_t seed) noexcept;

  /// Uniform over all 64-bit numbers.
  [[nodiscard]] std::uint64_t next() noexcept;
  /// Uniform over the multiples of 2^-53 in [0, 1).
  [[nodiscard]] double uniform() noexcept;
  /// Uniform over [low, high).
  [[nodiscard]] double uniform(double low, double high) noexcept;
  /// Mean 0, variance 1, by the polar method (Marsaglia & Bray 1964), with a logarithm of our own.
  [[nodiscard]] double normal() noexcept;

 private:
  std::array<std::uint64_t, 4> state_{};
  double spare_ = 0.0;  ///< the polar method makes two at a time
  bool has_spare_ = false;
};

}  // namespace gyrod::core
