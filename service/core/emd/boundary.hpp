/// How the envelopes continue beyond the first and last extremum.
#pragma once

#include "core/emd/sift_workspace.hpp"

namespace gyrod::core {

/// Knots of the envelopes to be evaluated: those whose following segment holds a sample.
struct SegmentRange {
  std::size_t first;  ///< last knot at or before sample 0, counted from extrema.begin
  std::size_t last;   ///< last knot before the last sample; the segment of a knot ends at the next one
};

/// Adds knots beyond both ends of ws.extrema, so that both envelopes cover every sample. Kinds go on
/// alternating.
///
/// - kMirror [Rilling2003]: four extrema reflected about the first one; about the end sample, then taken
///   as an extremum itself, where that sample lies beyond the second extremum or where the reflected ones
///   would not reach it.
/// - kLinear [Wu2009]: one knot of each kind at the end sample, on the line through the two nearest
///   extrema of the kind, but never inside the signal's end value.
///
/// @pre ws.extrema.count() >= 3
SegmentRange add_boundary_knots(SiftWorkspace& ws) noexcept;

}  // namespace gyrod::core
