/// The buffers of sifting, sized once. All kernels work in the same ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "core/emd/emd.hpp"

namespace gyrod::core {

/// Allocates whole cache lines, so that a vector register loads from one line.
template <typename T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{64};

  CacheLineAllocator() = default;
  template <typename U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>& /*other*/) noexcept {}

  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kAlignment)); }
  void deallocate(T* memory, std::size_t /*count*/) noexcept { ::operator delete(memory, kAlignment); }
  bool operator==(const CacheLineAllocator& /*other*/) const noexcept { return true; }
};

template <typename T>
using Buffer = std::vector<T, CacheLineAllocator<T>>;

/// Extrema in order of time, maxima and minima alternating, and the knots beyond the ends that a boundary
/// rule adds. Entries [begin, end) are valid. Positions are doubled, so that the midpoint of a flat top is a
/// whole number.
struct Extrema {
  /// Most knots a boundary rule adds at one end.
  static constexpr std::size_t kMaxAdded = 5;

  explicit Extrema(std::size_t max_samples);
  [[nodiscard]] std::size_t count() const noexcept { return end - begin; }

  Buffer<std::int32_t> position2;  ///< twice the position, in samples
  Buffer<double> value;
  std::size_t begin = kMaxAdded;
  std::size_t end = kMaxAdded;
};

/// What one sift reads and writes. `signal` is the proto-IMF of `size` samples; every buffer is longer than
/// its content by what vector loads and stores may overshoot.
struct SiftWorkspace {
  /// Entries that a vector operation may touch beyond a buffer's content.
  static constexpr std::size_t kOvershoot = 64;
  /// Parts that the spline system is solved in at the same time.
  static constexpr std::size_t kChunks = 8;
  /// Knots (of each kind) by which a part starts early and ends late.
  static constexpr std::size_t kWarmUp = 32;
  /// Unknowns of one elimination row: one of each kind from each part, then as many zeros, read beyond the
  /// last part.
  static constexpr std::size_t kRow = 4 * kChunks;

  SiftWorkspace(std::size_t max_samples, BoundaryRule boundary_rule);

  BoundaryRule boundary;
  std::size_t size = 0;
  Buffer<double> signal;
  Buffer<double> mean;  ///< mean of the two envelopes at each sample

  /// Bit i of word i / 64: the signal rises (falls) from sample i to i + 1.
  Buffer<std::uint64_t> rises;
  Buffer<std::uint64_t> falls;

  Extrema extrema;

  // One entry a knot, counted from extrema.begin. A knot's kind is the parity of its number.
  Buffer<double> time;             ///< position, samples
  Buffer<double> inverse_spacing;  ///< 1 / (time[k+2] - time[k])
  Buffer<double> slope;            ///< (value[k+2] - value[k]) / (time[k+2] - time[k])
  Buffer<double> sigma;            ///< sixth of the second derivative of the knot's own envelope
  Buffer<double> mean_value;       ///< mean of the two envelopes at the knot
  Buffer<double> mean_sigma;       ///< sixth of its second derivative
  Buffer<double> linear;           ///< coefficients of the mean in (time - time[k]) on [time[k], time[k+1]]
  Buffer<double> cubic;

  // The tridiagonal system, one row a knot, with 2 * kWarmUp rows of the unit matrix before the first.
  Buffer<double> off_diagonal;  ///< to knot k+2; its row's other entry is the one of knot k-2
  Buffer<double> diagonal;
  Buffer<double> right_side;
  // Its elimination, kRow entries a row.
  Buffer<double> ratio;
  Buffer<double> reduced;
};

}  // namespace gyrod::core
