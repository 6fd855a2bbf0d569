#include "core/emd/boundary.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace gyrod::core {
namespace {

/// A knot as seen from an end of the signal.
struct Knot {
  std::int32_t inward2 = 0;  ///< twice its distance from the end sample, positive inside the signal
  double value = 0.0;
};

/// Knots to be added at one end, nearest first.
struct AddedKnots {
  std::array<Knot, Extrema::kMaxAdded> knot{};
  std::size_t count = 0;

  void add(Knot next) noexcept { knot[count++] = next; }
};

/// One end of the signal: its last sample and the extrema in the order of their distance from it. Both ends
/// look alike, so that a rule is written once.
class SignalEnd {
 public:
  SignalEnd(const SiftWorkspace& ws, bool is_right) noexcept
      : extrema_(ws.extrema),
        last2_(2 * (static_cast<std::int32_t>(ws.size) - 1)),
        value_(is_right ? ws.signal[ws.size - 1] : ws.signal[0]),
        is_right_(is_right) {}

  [[nodiscard]] double value() const noexcept { return value_; }
  [[nodiscard]] std::size_t count() const noexcept { return extrema_.count(); }

  /// Converts between distance from this end and position; its own inverse.
  [[nodiscard]] std::int32_t flip(std::int32_t distance2) const noexcept {
    return is_right_ ? last2_ - distance2 : distance2;
  }

  /// The i-th extremum from the end. Past the far one the sequence is reflected there, so that few are
  /// enough.
  [[nodiscard]] Knot extremum(std::size_t i) const noexcept {
    if (i < count()) {
      const std::size_t at = is_right_ ? extrema_.end - 1 - i : extrema_.begin + i;
      return {flip(extrema_.position2[at]), extrema_.value[at]};
    }
    const Knot far = extremum(count() - 1);
    const Knot image = extremum(2 * (count() - 1) - i);
    return {2 * far.inward2 - image.inward2, image.value};
  }

 private:
  const Extrema& extrema_;
  std::int32_t last2_;
  double value_;
  bool is_right_;
};

/// Two of each kind: with the ends of a natural spline that far outside, they move the inside by 4 % at most.
constexpr std::size_t kMirrored = 4;

AddedKnots mirror(const SignalEnd& end) noexcept {
  const Knot first = end.extremum(0);
  const Knot second = end.extremum(1);
  const bool end_is_beyond =
      first.value > second.value ? end.value() <= second.value : end.value() >= second.value;
  const bool end_is_reached = 2 * first.inward2 <= end.extremum(kMirrored - 1).inward2;

  AddedKnots added;
  if (end_is_beyond || !end_is_reached) {
    added.add({0, end.value()});
    for (std::size_t i = 0; i < kMirrored; ++i) {
      const Knot knot = end.extremum(i);
      added.add({-knot.inward2, knot.value});
    }
  } else {
    for (std::size_t i = 1; i <= kMirrored; ++i) {
      const Knot knot = end.extremum(i);
      added.add({2 * first.inward2 - knot.inward2, knot.value});
    }
  }
  return added;
}

/// The line through two extrema of a kind at the end sample; level where there is only one of the kind.
double extrapolate(const SignalEnd& end, std::size_t near, std::size_t far) noexcept {
  const Knot a = end.extremum(near);
  if (far >= end.count()) {
    return a.value;
  }
  const Knot b = end.extremum(far);
  return a.value -
         (b.value - a.value) * (static_cast<double>(a.inward2) / static_cast<double>(b.inward2 - a.inward2));
}

AddedKnots extrapolate(const SignalEnd& end) noexcept {
  const double like_first = extrapolate(end, 0, 2);
  const double like_second = extrapolate(end, 1, 3);
  const bool first_is_maximum = end.extremum(0).value > end.extremum(1).value;
  AddedKnots added;
  if (first_is_maximum) {
    added.add({0, std::min(like_second, end.value())});
    added.add({0, std::max(like_first, end.value())});
  } else {
    added.add({0, std::max(like_second, end.value())});
    added.add({0, std::min(like_first, end.value())});
  }
  return added;
}

AddedKnots knots_beyond(const SignalEnd& end, BoundaryRule rule) noexcept {
  return rule == BoundaryRule::kMirror ? mirror(end) : extrapolate(end);
}

/// The segments that hold samples, searched from the ends, where they are a few knots away.
SegmentRange segments_with_samples(const Extrema& extrema, std::size_t size) noexcept {
  const std::int32_t* const position2 = extrema.position2.data() + extrema.begin;
  const std::int32_t last_sample2 = 2 * (static_cast<std::int32_t>(size) - 1);
  std::size_t first = 0;
  while (position2[first + 1] <= 0) {
    ++first;
  }
  std::size_t last = extrema.count() - 1;
  while (position2[last] >= last_sample2) {
    --last;
  }
  return {first, last};
}

}  // namespace

SegmentRange add_boundary_knots(SiftWorkspace& ws) noexcept {
  Extrema& extrema = ws.extrema;
  assert(extrema.count() >= 3);
  const SignalEnd left(ws, false);
  const SignalEnd right(ws, true);
  const AddedKnots before = knots_beyond(left, ws.boundary);
  const AddedKnots after = knots_beyond(right, ws.boundary);
  for (std::size_t i = 0; i < before.count; ++i) {
    --extrema.begin;
    extrema.position2[extrema.begin] = left.flip(before.knot[i].inward2);
    extrema.value[extrema.begin] = before.knot[i].value;
  }
  for (std::size_t i = 0; i < after.count; ++i) {
    extrema.position2[extrema.end] = right.flip(after.knot[i].inward2);
    extrema.value[extrema.end] = after.knot[i].value;
    ++extrema.end;
  }
  return segments_with_samples(extrema, ws.size);
}

}  // namespace gyrod::core
