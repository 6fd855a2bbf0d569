// The sift of the vector kernels. Included as vector_lanes.hpp is.
//
// Between two neighbouring extrema both envelopes are single cubics, hence so is their mean: it is evaluated
// once a sample, not once for each envelope.
namespace gyrod::core::GYROD_KERNEL {

/// Value and sigma of the mean of the envelopes at every knot: its own envelope passes through the knot, the
/// other one is evaluated between the knots k - 1 and k + 1.
/// With a = (t_k - t_(k-1)) / h_(k-1) and b = 1 - a,
///   S(t_k) = b x_(k-1) + a x_(k+1) - a b h^2 ((1 + b) sigma_(k-1) + (1 + a) sigma_(k+1)).
inline void average_at_knots(SiftWorkspace& ws) noexcept {
  const std::size_t count = ws.extrema.count();
  const double* const time = ws.time.data();
  const double* const value = ws.extrema.value.data() + ws.extrema.begin;
  const double* const sigma = ws.sigma.data();
  const double* const inverse_spacing = ws.inverse_spacing.data();
  for (std::size_t k = 1; k + 1 < count; k += kLanes) {
    const Lanes left = load(time + k) - load(time + k - 1);
    const Lanes right = load(time + k + 1) - load(time + k);
    const Lanes inverse = load(inverse_spacing + k - 1);
    const Lanes a = left * inverse;
    const Lanes b = right * inverse;
    const Lanes sigma_left = load(sigma + k - 1);
    const Lanes sigma_right = load(sigma + k + 1);
    const Lanes chord = b * load(value + k - 1) + a * load(value + k + 1);
    const Lanes bow = left * right * ((1.0 + b) * sigma_left + (1.0 + a) * sigma_right);
    store(ws.mean_value.data() + k, 0.5 * (load(value + k) + (chord - bow)));
    store(ws.mean_sigma.data() + k, 0.5 * (load(sigma + k) + (b * sigma_left + a * sigma_right)));
  }
}

/// Coefficients of u and u^3, u = t - t_k, of the mean on [t_k, t_(k+1)]; those of 1 and u^2 are mean_value
/// and 3 mean_sigma. Knots of no width (kLinear has two at an end) give coefficients that are not used.
inline void set_up_segments(SiftWorkspace& ws) noexcept {
  const std::size_t count = ws.extrema.count();
  const double* const time = ws.time.data();
  const double* const value = ws.mean_value.data();
  const double* const sigma = ws.mean_sigma.data();
  for (std::size_t k = 0; k + 1 < count; k += kLanes) {
    const Lanes width = load(time + k + 1) - load(time + k);
    const Lanes inverse = 1.0 / width;
    const Lanes sigma_left = load(sigma + k);
    const Lanes sigma_right = load(sigma + k + 1);
    store(ws.linear.data() + k,
          (load(value + k + 1) - load(value + k)) * inverse - width * (2.0 * sigma_left + sigma_right));
    store(ws.cubic.data() + k, (sigma_right - sigma_left) * inverse);
  }
}

/// The mean at every sample, a register at a time from the start of each segment. What a segment writes
/// beyond its end the next one overwrites.
inline void evaluate_mean(SiftWorkspace& ws, SegmentRange segments) noexcept {
  const std::int32_t* const position2 = ws.extrema.position2.data() + ws.extrema.begin;
  double* const mean = ws.mean.data();
  const Lanes lane = iota();
  std::size_t i = 0;
  for (std::size_t k = segments.first; k <= segments.last; ++k) {
    const std::size_t end = k == segments.last ? ws.size : static_cast<std::size_t>(position2[k + 1] + 1) / 2;
    const double constant = ws.mean_value[k];
    const double linear = ws.linear[k];
    const double quadratic = 3.0 * ws.mean_sigma[k];
    const double cubic = ws.cubic[k];
    Lanes u = lane + (static_cast<double>(i) - ws.time[k]);
    for (std::size_t j = i; j < end; j += kLanes) {
      store(mean + j, constant + u * (linear + u * (quadratic + u * cubic)));
      u += static_cast<double>(kLanes);
    }
    i = end;
  }
}

inline void find_extrema(SiftWorkspace& ws) noexcept {
  compare_neighbours<false>(ws);
  collect_extrema(ws);
}

inline void sift(SiftWorkspace& ws) noexcept {
  const SegmentRange segments = add_boundary_knots(ws);
  const std::size_t count = ws.extrema.count();
  const std::int32_t* const position2 = ws.extrema.position2.data() + ws.extrema.begin;
  double* const time = ws.time.data();
  for (std::size_t k = 0; k < count; ++k) {
    time[k] = 0.5 * position2[k];
  }
  solve_splines(ws);
  average_at_knots(ws);
  set_up_segments(ws);
  evaluate_mean(ws, segments);
  compare_neighbours<true>(ws);
  collect_extrema(ws);
}

}  // namespace gyrod::core::GYROD_KERNEL
