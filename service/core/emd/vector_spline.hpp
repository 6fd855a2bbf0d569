// Second derivatives of both envelopes, of the vector kernels. Included as vector_lanes.hpp is.
//
// Knot k of one envelope is followed by knot k + 2, knots k + 1 belong to the other: the two systems lie
// interleaved in the same arrays, and every operation on neighbouring entries works on both.
namespace gyrod::core::GYROD_KERNEL {

/// The rows of the system
///   h_(k-2) sigma_(k-2) + 2 (h_(k-2) + h_k) sigma_k + h_k sigma_(k+2) = s_k - s_(k-2),
/// h_k = t_(k+2) - t_k, as reference_kernel.cpp has it, and unit rows for the two knots at either end
/// (natural spline) and up to `row_end`.
inline void set_up_system(SiftWorkspace& ws, std::size_t row_end) noexcept {
  const std::size_t count = ws.extrema.count();
  const double* const time = ws.time.data();
  const double* const value = ws.extrema.value.data() + ws.extrema.begin;
  double* const slope = ws.slope.data();
  double* const inverse_spacing = ws.inverse_spacing.data();
  double* const off_diagonal = ws.off_diagonal.data() + 2 * SiftWorkspace::kWarmUp;
  double* const diagonal = ws.diagonal.data() + 2 * SiftWorkspace::kWarmUp;
  double* const right_side = ws.right_side.data() + 2 * SiftWorkspace::kWarmUp;

  for (std::size_t k = 0; k < count - 2; k += kLanes) {
    const Lanes spacing = load(time + k + 2) - load(time + k);
    const Lanes inverse = 1.0 / spacing;
    store(off_diagonal + k, spacing);
    store(inverse_spacing + k, inverse);
    store(slope + k, (load(value + k + 2) - load(value + k)) * inverse);
  }
  for (std::size_t k = 2; k < count - 2; k += kLanes) {
    store(diagonal + k, 2.0 * (load(time + k + 2) - load(time + k - 2)));
    store(right_side + k, load(slope + k) - load(slope + k - 2));
  }
  const auto set_unit_row = [=](std::size_t k) noexcept {
    off_diagonal[k] = 0.0;
    diagonal[k] = 1.0;
    right_side[k] = 0.0;
  };
  set_unit_row(0);
  set_unit_row(1);
  // The coupling to the last knots, where sigma is zero: without it their rows are unit rows on both sides.
  off_diagonal[count - 4] = 0.0;
  off_diagonal[count - 3] = 0.0;
  for (std::size_t k = count - 2; k < row_end; ++k) {
    set_unit_row(k);
  }
}

/// Thomas algorithm on both systems side by side, for few knots.
inline void solve_in_sequence(SiftWorkspace& ws, std::size_t pairs) noexcept {
  const double* const off_diagonal = ws.off_diagonal.data() + 2 * SiftWorkspace::kWarmUp;
  const double* const diagonal = ws.diagonal.data() + 2 * SiftWorkspace::kWarmUp;
  const double* const right_side = ws.right_side.data() + 2 * SiftWorkspace::kWarmUp;
  double* const sigma_out = ws.sigma.data();
  double* const ratio_out = ws.mean_value.data();
  double* const reduced_out = ws.mean_sigma.data();

  Pair before{};
  Pair ratio{};
  Pair reduced{};
  for (std::size_t k = 0; k < 2 * pairs; k += 2) {
    const Pair after = load_pair(off_diagonal + k);
    const Pair inverse = 1.0 / (load_pair(diagonal + k) - before * ratio);
    reduced = (load_pair(right_side + k) - before * reduced) * inverse;
    ratio = after * inverse;
    before = after;
    store_pair(ratio_out + k, ratio);
    store_pair(reduced_out + k, reduced);
  }
  Pair sigma{};
  for (std::size_t k = 2 * pairs; k > 0; k -= 2) {
    sigma = load_pair(reduced_out + k - 2) - load_pair(ratio_out + k - 2) * sigma;
    store_pair(sigma_out + k - 2, sigma);
  }
}

/// The same in kChunks parts of `length` pairs at a time, side by side in registers: a single recursion waits
/// for its divisions. A part starts kWarmUp knots early (and comes back from kWarmUp knots late) from zero
/// instead of from the true value, whose trace shrinks by 2 + sqrt(3) a knot where knots are even, by 3 on
/// average wherever they are: to 5e-19 and below 1e-13, so that the result is Thomas' to rounding.
class ChunkedSolver {
 public:
  ChunkedSolver(SiftWorkspace& ws, std::size_t length) noexcept : ws_(ws), length_(length) {}

  /// @pre kWarmUp <= (kChunks - 1) * length
  void solve() noexcept {
    eliminate();
    substitute();
  }

 private:
  static constexpr std::size_t kRegisters = 2 * SiftWorkspace::kChunks / kLanes;
  static constexpr std::size_t kRow = SiftWorkspace::kRow;
  using Row = Lanes[kRegisters];

  /// First pair of the part that register r begins with, in doubles.
  [[nodiscard]] std::size_t offset(std::size_t r) const noexcept { return r * kLanes * length_; }

  /// Forward: pair j of every part at step j, warm-up first.
  /// Row j of the elimination holds pair j of all parts.
  void eliminate() noexcept {
    const double* const off_diagonal = ws_.off_diagonal.data();
    const double* const diagonal = ws_.diagonal.data();
    const double* const right_side = ws_.right_side.data();
    const std::size_t stride = 2 * length_;
    Row before{};
    Row ratio{};
    Row reduced{};
    const auto step = [&](std::size_t k) noexcept {
      for (std::size_t r = 0; r < kRegisters; ++r) {
        const std::size_t at = offset(r) + k;
        const Lanes after = gather_pairs(off_diagonal + at, stride);
        const Lanes inverse = 1.0 / (gather_pairs(diagonal + at, stride) - before[r] * ratio[r]);
        reduced[r] = (gather_pairs(right_side + at, stride) - before[r] * reduced[r]) * inverse;
        ratio[r] = after * inverse;
        before[r] = after;
      }
    };
    for (std::size_t j = 0; j < SiftWorkspace::kWarmUp; ++j) {
      step(2 * j);
    }
    for (std::size_t j = 0; j < length_; ++j) {
      step(2 * (SiftWorkspace::kWarmUp + j));
      for (std::size_t r = 0; r < kRegisters; ++r) {
        store(ws_.ratio.data() + j * kRow + r * kLanes, ratio[r]);
        store(ws_.reduced.data() + j * kRow + r * kLanes, reduced[r]);
      }
    }
  }

  /// Backward. Pair length + j of a part is pair j of the next: the same row, read one part further on.
  /// Beyond the last part a row holds zeros, and so does the solution there.
  void substitute() noexcept {
    const std::size_t stride = 2 * length_;
    Row sigma{};
    const auto step = [&](std::size_t row, std::size_t parts_on) noexcept {
      for (std::size_t r = 0; r < kRegisters; ++r) {
        const std::size_t at = row * kRow + r * kLanes + 2 * parts_on;
        sigma[r] = load(ws_.reduced.data() + at) - load(ws_.ratio.data() + at) * sigma[r];
      }
    };
    for (std::size_t j = length_ + SiftWorkspace::kWarmUp; j > length_; --j) {
      step((j - 1) % length_, (j - 1) / length_);
    }
    for (std::size_t j = length_; j > 0; --j) {
      step(j - 1, 0);
      for (std::size_t r = 0; r < kRegisters; ++r) {
        scatter_pairs(ws_.sigma.data() + offset(r) + 2 * (j - 1), stride, sigma[r]);
      }
    }
  }

  SiftWorkspace& ws_;
  std::size_t length_;
};

/// Writes ws.sigma for all knots of both envelopes.
inline void solve_splines(SiftWorkspace& ws) noexcept {
  /// Parts shorter than this spend more time on the warm-up than the sequence spends waiting. Part of the
  /// definition of the result, since the two ways round differently: the same in every kernel.
  constexpr std::size_t kShortestChunk = 6;
  const std::size_t pairs = (ws.extrema.count() + 1) / 2;
  const std::size_t length = (pairs + SiftWorkspace::kChunks - 1) / SiftWorkspace::kChunks;
  set_up_system(ws, 2 * SiftWorkspace::kChunks * length);
  if (length < kShortestChunk) {
    solve_in_sequence(ws, pairs);
  } else {
    ChunkedSolver(ws, length).solve();
  }
}

}  // namespace gyrod::core::GYROD_KERNEL
