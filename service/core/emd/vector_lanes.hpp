// Vector registers of the instruction set that the including kernel is compiled for. No include guard: each
// kernel includes it once, with GYROD_KERNEL its namespace and GYROD_LANES the number of doubles in a
// register.
namespace gyrod::core::GYROD_KERNEL {

constexpr std::size_t kLanes = GYROD_LANES;

/// kLanes doubles. Arithmetic is element by element, so that its bits do not depend on kLanes.
using Lanes = double __attribute__((vector_size(kLanes * sizeof(double))));
/// The same anywhere in memory.
using UnalignedLanes =
    double __attribute__((vector_size(kLanes * sizeof(double)), aligned(sizeof(double)), may_alias));
/// One knot of each kind.
using Pair = double __attribute__((vector_size(2 * sizeof(double))));
using UnalignedPair =
    double __attribute__((vector_size(2 * sizeof(double)), aligned(sizeof(double)), may_alias));

inline Lanes load(const double* from) noexcept { return *reinterpret_cast<const UnalignedLanes*>(from); }
inline void store(double* to, Lanes lanes) noexcept { *reinterpret_cast<UnalignedLanes*>(to) = lanes; }
inline Pair load_pair(const double* from) noexcept { return *reinterpret_cast<const UnalignedPair*>(from); }
inline void store_pair(double* to, Pair pair) noexcept { *reinterpret_cast<UnalignedPair*>(to) = pair; }

#if GYROD_LANES == 8

/// 0, 1, 2, ...
inline Lanes iota() noexcept { return Lanes{0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}; }

/// Bit i says a[i] > b[i].
inline std::uint64_t greater(Lanes a, Lanes b) noexcept { return _mm512_cmp_pd_mask(a, b, _CMP_GT_OQ); }

/// Pairs from, from + stride, from + 2 stride, ... side by side.
inline Lanes gather_pairs(const double* from, std::size_t stride) noexcept {
  const auto low = __builtin_shufflevector(load_pair(from), load_pair(from + stride), 0, 1, 2, 3);
  const auto high =
      __builtin_shufflevector(load_pair(from + 2 * stride), load_pair(from + 3 * stride), 0, 1, 2, 3);
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// The inverse of gather_pairs.
inline void scatter_pairs(double* to, std::size_t stride, Lanes lanes) noexcept {
  store_pair(to, __builtin_shufflevector(lanes, lanes, 0, 1));
  store_pair(to + stride, __builtin_shufflevector(lanes, lanes, 2, 3));
  store_pair(to + 2 * stride, __builtin_shufflevector(lanes, lanes, 4, 5));
  store_pair(to + 3 * stride, __builtin_shufflevector(lanes, lanes, 6, 7));
}

#elif GYROD_LANES == 4

inline Lanes iota() noexcept { return Lanes{0.0, 1.0, 2.0, 3.0}; }

inline std::uint64_t greater(Lanes a, Lanes b) noexcept {
  return static_cast<std::uint64_t>(_mm256_movemask_pd(_mm256_cmp_pd(a, b, _CMP_GT_OQ)));
}

inline Lanes gather_pairs(const double* from, std::size_t stride) noexcept {
  return __builtin_shufflevector(load_pair(from), load_pair(from + stride), 0, 1, 2, 3);
}

inline void scatter_pairs(double* to, std::size_t stride, Lanes lanes) noexcept {
  store_pair(to, __builtin_shufflevector(lanes, lanes, 0, 1));
  store_pair(to + stride, __builtin_shufflevector(lanes, lanes, 2, 3));
}

#else

inline Lanes iota() noexcept { return Lanes{0.0, 1.0}; }

inline std::uint64_t greater(Lanes a, Lanes b) noexcept {
#ifdef __SSE2__
  return static_cast<std::uint64_t>(_mm_movemask_pd(_mm_cmpgt_pd(a, b)));
#else
  return static_cast<std::uint64_t>(a[0] > b[0]) | static_cast<std::uint64_t>(a[1] > b[1]) << 1U;
#endif
}

inline Lanes gather_pairs(const double* from, std::size_t /*stride*/) noexcept { return load_pair(from); }
inline void scatter_pairs(double* to, std::size_t /*stride*/, Lanes lanes) noexcept { store_pair(to, lanes); }

#endif

}  // namespace gyrod::core::GYROD_KERNEL
