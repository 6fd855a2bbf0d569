#include "core/noise/own_lines.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numeric>

#include "core/noise/noise_lines.hpp"
#include "core/noise/same_noise.hpp"
#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

// What these are good for: docs/decisions/0013.
constexpr double kLeastBlockSegments = 8.0;
constexpr double kLeastBlockSeconds = 15.0;
/// In bins.
constexpr double kLeastWidth = 0.5;
constexpr std::size_t kMostOfAnAxis = 2;
constexpr double kMostPhase = 0.5;
constexpr double kFewestPhases = kLeastBlockSegments - 2.0;
constexpr double kMostBelow = 1.2;
constexpr double kSteadyLine = 2.0;
/// How far a line wanders between two blocks, in parts of its frequency.
constexpr double kSamePlace = 0.025;
constexpr std::array<bool, kSensorAxes> kAllAxes = {true, true, true};

/// Bins of a line: half its height and a taper's reach to either side.
struct Bins {
  std::size_t first;
  std::size_t last;
};

Bins bins_of(const SpectralLine& line) noexcept {
  constexpr auto kSegment = static_cast<double>(kNoiseSegment);
  const double reach = std::max(1.0, line.half_width * kSegment);
  const double middle = line.cycles * kSegment;
  const auto first = static_cast<std::size_t>(std::lround(std::max(middle - reach, 1.0)));
  const auto last = static_cast<std::size_t>(std::lround(middle + reach));
  return {first, std::min(last, kNoiseBins - 1)};
}

double sum_of(const NoiseSpectrum& spectrum, const Bins& bins) noexcept {
  double sum = 0.0;
  for (std::size_t k = bins.first; k <= bins.last; ++k) sum += spectrum[k];
  return sum;
}

bool is_finite(const AxisSums& sums) noexcept {
  double sum = 0.0;
  for (const NoiseSpectrum& power : sums.power) sum = std::accumulate(power.begin(), power.end(), sum);
  return std::isfinite(sum);
}

const SpectralLine* same_line(const NoiseModel& model, const SpectralLine& line) noexcept {
  const auto lines = model.lines();
  const auto found = std::ranges::find_if(lines, [&line](const SpectralLine& one) {
    return std::abs(one.cycles - line.cycles) <= kSamePlace * line.cycles;
  });
  return found == lines.end() ? nullptr : &*found;
}

}  // namespace

void OwnLines::retime(double segment_seconds) noexcept {
  assert(segment_seconds > 0.0);
  block_segments_ = std::max(kLeastBlockSegments, kLeastBlockSeconds / segment_seconds);
  most_segments_ = std::max(2.0 * block_segments_, kNoiseMemorySeconds / segment_seconds);
  all_ = {};
  log_ = {};
  later_ = {};
  later_segments_ = 0.0;
  block_ = {};
  in_block_ = 0.0;
  candidates_ = lines_ = {};
  interrupt();
}

bool OwnLines::add(const AxisTransforms& segment, const AxisSums& sums) noexcept {
  if (!is_finite(sums)) {
    interrupt();
    return false;
  }
  const double kept = std::min(all_.segments[0], most_segments_ - 1.0);
  all_.blend(sums, kAllAxes, most_segments_);
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    for (std::size_t k = 0; k < kNoiseBins; ++k) {
      block_[axis][k] += sums.power[axis][k];
      const double logarithm = portable_log(std::max(sums.power[axis][k], 1e-300));
      log_[axis][k] = (kept * log_[axis][k] + logarithm) / (kept + 1.0);
    }
  }
  follow_phase(segment);
  in_block_ += 1.0;
  return in_block_ >= block_segments_ && end_block();
}

void OwnLines::follow_phase(const AxisTransforms& segment) noexcept {
  if (since_gap_ >= 2) {
    const double kept = std::min(later_segments_, most_segments_ - 1.0);
    later_segments_ = kept + 1.0;
    for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
      for (std::size_t k = 0; k < kNoiseBins; ++k) {
        const std::complex<double> now = segment[axis][k];
        const std::complex<double> then = last_[1][axis][k];
        const std::complex<double> product{now.real() * then.real() + now.imag() * then.imag(),
                                           now.imag() * then.real() - now.real() * then.imag()};
        later_[axis][k] = (kept * later_[axis][k] + product) / later_segments_;
      }
    }
  }
  last_[1] = last_[0];
  last_[0] = segment;
  ++since_gap_;
}

bool OwnLines::end_block() noexcept {
  const auto before = lines_;
  for (std::size_t axis = 0; axis < kSensorAxes; ++axis) {
    const NoiseModel now = candidates(axis);
    lines_[axis] = {};
    for (const SpectralLine& line : now.lines()) {
      if (same_line(candidates_[axis], line) != nullptr) lines_[axis].line[lines_[axis].line_count++] = line;
    }
    candidates_[axis] = now;
  }
  block_ = {};
  in_block_ = 0.0;
  return lines_ != before;
}

NoiseModel OwnLines::candidates(std::size_t axis) const noexcept {
  NoiseModel found;
  const SpectrumParts parts = take_lines(all_.power[axis], all_.segments[axis]);
  if (parts.line_count > kMostOfAnAxis || later_segments_ < kFewestPhases) return found;
  for (std::size_t i = 0; i < parts.line_count; ++i) {
    if (is_own(axis, parts.line[i], parts.rest)) found.line[found.line_count++] = parts.line[i];
  }
  return found;
}

bool OwnLines::is_own(std::size_t axis, const SpectralLine& line, const NoiseSpectrum& floor) const noexcept {
  if (line.half_width * static_cast<double>(kNoiseSegment) < kLeastWidth) return false;
  const Bins bins = bins_of(line);
  if (all_.shared(axis, bins.first, bins.last) > 0.0) return false;
  double below = 0.0;
  double phase = 0.0;
  double weight = 0.0;
  for (std::size_t k = bins.first; k <= bins.last; ++k) {
    const double power = all_.power[axis][k];
    below += power * (portable_log(power) - log_[axis][k]);
    phase += std::sqrt(std::norm(later_[axis][k]));
    weight += power;
  }
  if (!(phase < kMostPhase * weight && below <= kMostBelow * weight)) return false;
  const double floors = sum_of(floor, bins);
  const double all = sum_of(all_.power[axis], bins) - floors;
  const double now = sum_of(block_[axis], bins) / in_block_ - floors;
  return now <= kSteadyLine * all && now * kSteadyLine >= all;
}

}  // namespace gyrod::core
