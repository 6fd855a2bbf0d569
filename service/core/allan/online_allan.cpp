#include "core/allan/online_allan.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "core/allan/degrees_of_freedom.hpp"
#include "core/signal/chi_squared.hpp"

namespace gyrod::core {
namespace {

/// Octaves whose clusters move on by one sample.
constexpr std::size_t kEverySample = std::size_t{std::countr_zero(kAllanShare)} + 1;

/// Terms of one cluster's length, m / s.
constexpr std::size_t lag_of(std::size_t octave) noexcept {
  return allan_cluster(octave) / allan_stride(octave);
}

double variance_of(const AllanSums& sums, std::size_t octave) noexcept {
  const double size = static_cast<double>(allan_cluster(octave));
  return sums.squares[octave] / (2.0 * size * size * static_cast<double>(sums.terms[octave]));
}

/// By the slope from the octave before, which lies nearest to -2, -1, 0 or 1.
PowerLaw kind_of(const AllanSums& sums, std::size_t octave) noexcept {
  if (octave == 0) return PowerLaw::kWhite;
  const double slope = std::log2(variance_of(sums, octave) / variance_of(sums, octave - 1));
  if (!std::isfinite(slope)) return PowerLaw::kWhite;
  if (slope < -1.5) return PowerLaw::kQuantization;
  if (slope < -0.5) return PowerLaw::kWhite;
  return slope < 0.5 ? PowerLaw::kFlicker : PowerLaw::kRandomWalk;
}

AllanPoint point_of(const AllanSums& sums, std::size_t octave, double sample_rate_hz, double confidence) {
  AllanPoint point;
  point.cluster_samples = allan_cluster(octave);
  point.tau_s = static_cast<double>(point.cluster_samples) / sample_rate_hz;
  point.terms = sums.terms[octave];
  point.deviation = std::sqrt(variance_of(sums, octave));
  // The correlation of terms depends on their distance in parts of a cluster alone.
  point.edf = equivalent_degrees_of_freedom(kind_of(sums, octave), lag_of(octave), point.terms);
  const double tail = 0.5 * (1.0 - confidence);
  point.lower = point.deviation * std::sqrt(point.edf / chi_squared_quantile(1.0 - tail, point.edf));
  point.upper = point.deviation * std::sqrt(point.edf / chi_squared_quantile(tail, point.edf));
  return point;
}

}  // namespace

void OnlineAllan::step(double rate) noexcept {
  if (!(std::abs(rate) <= kMostRate)) return interrupt();
  if (samples_ == 0) begin_stretch();
  angle_ += static_cast<std::uint64_t>(std::llround(rate / kQuantum));
  ++samples_;
  const std::size_t due =
      std::min(kEverySample + static_cast<std::size_t>(std::countr_zero(samples_)), kAllanOctaves);
  for (std::size_t j = 0; j < due; ++j) add(octaves_[j], lag_of(j), angle_);
}

void OnlineAllan::begin_stretch() noexcept {
  for (std::size_t j = 0; j < kAllanOctaves; ++j) {
    octaves_[j].held = 0;
    add(octaves_[j], lag_of(j), angle_);
  }
}

void OnlineAllan::add(Octave& octave, std::size_t lag, std::uint64_t angle) noexcept {
  constexpr auto kSize = static_cast<std::uint32_t>(2 * kAllanShare + 1);
  const auto back = [&octave](std::size_t steps) {
    const std::size_t place = octave.newest + kSize - steps;
    return octave.angles[place < kSize ? place : place - kSize];
  };
  octave.newest = octave.newest + 1 == kSize ? 0 : octave.newest + 1;
  octave.angles[octave.newest] = angle;
  octave.held = std::min(octave.held + 1, kSize);
  if (octave.held < 2 * lag + 1) return;
  const std::uint64_t difference = (angle - back(lag)) - (back(lag) - back(2 * lag));
  const double z = static_cast<double>(static_cast<std::int64_t>(difference)) * kQuantum;
  const double square = z * z;
  const double sum = octave.squares + square;
  octave.carry +=
      octave.squares >= square ? (octave.squares - sum) + square : (square - sum) + octave.squares;
  octave.squares = sum;
  ++octave.terms;
}

AllanSums OnlineAllan::sums() const noexcept {
  AllanSums all;
  for (std::size_t j = 0; j < kAllanOctaves; ++j) {
    all.squares[j] = octaves_[j].squares + octaves_[j].carry;
    all.terms[j] = octaves_[j].terms;
  }
  return all;
}

void OnlineAllan::restore(const AllanSums& sums) noexcept {
  *this = {};
  for (std::size_t j = 0; j < kAllanOctaves; ++j) {
    octaves_[j].squares = sums.squares[j];
    octaves_[j].terms = sums.terms[j];
  }
}

bool is_possible(const AllanSums& sums) noexcept {
  for (std::size_t j = 0; j < kAllanOctaves; ++j) {
    const bool has_terms = sums.terms[j] > 0;
    if (!std::isfinite(sums.squares[j]) || sums.squares[j] < 0.0) return false;
    if (!has_terms && sums.squares[j] != 0.0) return false;
    if (j > 0 && sums.terms[j] > sums.terms[j - 1]) return false;
  }
  return true;
}

std::vector<AllanPoint> allan_points(const AllanSums& sums, double sample_rate_hz, double confidence) {
  assert(sample_rate_hz > 0.0 && confidence > 0.0 && confidence < 1.0);
  std::vector<AllanPoint> points;
  for (std::size_t j = 0; j < kAllanOctaves && sums.terms[j] > 0; ++j)
    points.push_back(point_of(sums, j, sample_rate_hz, confidence));
  return points;
}

double allan_deviation_of(const AllanSums& sums, std::size_t octave) noexcept {
  return sums.terms[octave] > 0 ? std::sqrt(variance_of(sums, octave)) : 0.0;
}

}  // namespace gyrod::core
