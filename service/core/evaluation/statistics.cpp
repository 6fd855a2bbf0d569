#include "core/evaluation/statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace gyrod::core {
namespace {

/// Over `length` samples each, which begin `step` samples apart; not finite where a sample is not.
std::vector<double> means(std::span<const double> x, std::size_t length, std::size_t step) {
  std::vector<double> means;
  for (std::size_t begin = 0; begin + length <= x.size(); begin += step) {
    const auto samples = x.subspan(begin, length);
    means.push_back(std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(length));
  }
  return means;
}

/// Sums of a term over batches; batches without a finite term do not count.
template <class Term>
struct BatchSums {
  double squares = 0.0;  ///< of the batches' sums
  std::size_t batches = 0;

  BatchSums(std::size_t size, std::size_t batch, const Term& term) {
    for (std::size_t begin = 0; begin < size; begin += batch) {
      double sum = 0.0;
      bool known = false;
      for (std::size_t t = begin; t < std::min(size, begin + batch); ++t) {
        const double value = term(t);
        if (!std::isfinite(value)) continue;
        sum += value;
        known = true;
      }
      if (!known) continue;
      squares += sum * sum;
      ++batches;
    }
  }
};

struct Means {
  double x = 0.0;
  double y = 0.0;
  double count = 0.0;
};

/// Over what is finite in both.
Means means_of(std::span<const double> x, std::span<const double> y) noexcept {
  Means means;
  for (std::size_t t = 0; t < x.size(); ++t) {
    if (!std::isfinite(x[t]) || !std::isfinite(y[t])) continue;
    means.x += x[t];
    means.y += y[t];
    means.count += 1.0;
  }
  if (means.count > 0.0) {
    means.x /= means.count;
    means.y /= means.count;
  }
  return means;
}

/// What a least-squares line and a correlation coefficient need to know.
struct PairSums {
  double count = 0.0;
  double x = 0.0;
  double y = 0.0;
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;

  void add(double x_value, double y_value) noexcept {
    count += 1.0;
    x += x_value;
    y += y_value;
    xx += x_value * x_value;
    yy += y_value * y_value;
    xy += x_value * y_value;
  }
  PairSums& operator-=(const PairSums& other) noexcept { return *this = combined(other, -1.0); }
  friend PairSums operator+(const PairSums& a, const PairSums& b) noexcept { return a.combined(b, 1.0); }
  /// Of the line y on x. Nothing where x does not vary by more than rounding makes of it.
  [[nodiscard]] std::optional<double> slope() const noexcept {
    const double variation = xx - x * x / count;
    if (!(variation > 1e-12 * xx)) return std::nullopt;
    return (xy - x * y / count) / variation;
  }
  /// NaN where one of the two does not vary so.
  [[nodiscard]] double coefficient() const noexcept {
    const double x_variation = xx - x * x / count;
    const double y_variation = yy - y * y / count;
    if (!(x_variation > 1e-12 * xx) || !(y_variation > 1e-12 * yy))
      return std::numeric_limits<double>::quiet_NaN();
    return (xy - x * y / count) / std::sqrt(x_variation * y_variation);
  }

 private:
  [[nodiscard]] PairSums combined(const PairSums& other, double sign) const noexcept {
    return {count + sign * other.count, x + sign * other.x,   y + sign * other.y,
            xx + sign * other.xx,       yy + sign * other.yy, xy + sign * other.xy};
  }
};

/// Of every batch, empty ones too, so that those of several shifts belong together; over what is finite in both, less its means.
std::vector<PairSums> pair_sums(std::span<const double> x, std::span<const double> y, std::size_t batch) {
  const Means means = means_of(x, y);
  std::vector<PairSums> sums((x.size() + batch - 1) / batch);
  for (std::size_t t = 0; t < x.size(); ++t) {
    if (std::isfinite(x[t]) && std::isfinite(y[t])) sums[t / batch].add(x[t] - means.x, y[t] - means.y);
  }
  return sums;
}

PairSums sum_of(std::span<const PairSums> batches) noexcept {
  return std::accumulate(batches.begin(), batches.end(), PairSums{});
}

/// Of a value, by the values without one of the batches each: sqrt((B - 1) / B sum_b (value_(-b) - value)^2). Infinite for less than two.
double jackknife_error(double value, std::span<const double> without) noexcept {
  if (without.size() < 2) return std::numeric_limits<double>::infinity();
  double squares = 0.0;
  for (const double other : without) squares += (other - value) * (other - value);
  const auto count = static_cast<double>(without.size());
  return std::sqrt(squares * (count - 1.0) / count);
}

/// Normal equations of a swing: of sine, cosine and 1.
struct SwingSums {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double count = 0.0;

  void add(double frequency, std::size_t t, double value) noexcept {
    const double phase = 2.0 * std::numbers::pi * frequency * static_cast<double>(t);
    const Eigen::Vector3d basis(std::sin(phase), std::cos(phase), 1.0);
    normal += basis * basis.transpose();
    right += value * basis;
    count += 1.0;
  }
  void add(const SwingSums& other, double sign) noexcept {
    normal += sign * other.normal;
    right += sign * other.right;
    count += sign * other.count;
  }
  /// One period, and one sample more than there are unknowns.
  [[nodiscard]] bool tells(double frequency) const noexcept {
    return count * frequency >= 1.0 && count >= 4.0;
  }
  [[nodiscard]] Eigen::Vector3d fit() const { return normal.ldlt().solve(right); }
};

/// Place of the greatest coefficient, between two of them by a parabola; nothing where one is not known.
std::optional<double> peak_of(std::span<const PairSums> sums) {
  std::vector<double> at;
  for (const PairSums& pairs : sums) at.push_back(pairs.coefficient());
  if (!std::ranges::all_of(at, [](double value) { return std::isfinite(value); })) return std::nullopt;
  const auto best = static_cast<std::size_t>(std::ranges::max_element(at) - at.begin());
  if (best == 0 || best + 1 == at.size()) return static_cast<double>(best);
  const double bend = at[best - 1] - 2.0 * at[best] + at[best + 1];
  const double shift = bend < 0.0 ? 0.5 * (at[best - 1] - at[best + 1]) / bend : 0.0;
  return static_cast<double>(best) + shift;
}

}  // namespace

std::optional<Measured> batch_mean(std::span<const double> x, std::size_t batch) {
  assert(batch >= 1);
  const Means means = means_of(x, x);
  const BatchSums sums(x.size(), batch, [&](std::size_t t) { return x[t] - means.x; });
  if (sums.batches < 2) return std::nullopt;
  return Measured{means.x, std::sqrt(sums.squares) / means.count};
}

std::optional<Measured> batch_slope(std::span<const double> x, std::span<const double> y, std::size_t batch) {
  assert(batch >= 1 && x.size() == y.size());
  const std::vector<PairSums> batches = pair_sums(x, y, batch);
  const PairSums all = sum_of(batches);
  const auto slope = all.slope();
  if (!slope) return std::nullopt;
  std::vector<double> without;
  for (const PairSums& left_out : batches) {
    if (left_out.count == 0.0) continue;
    PairSums others = all;
    others -= left_out;
    const auto other = others.slope();
    if (!other) return std::nullopt;
    without.push_back(*other);
  }
  if (without.size() < 2) return std::nullopt;
  return Measured{*slope, jackknife_error(*slope, without)};
}

std::optional<Measured> slow_slope(std::span<const double> x, std::span<const double> y, double rate_hz) {
  assert(x.size() == y.size() && rate_hz > 0.0);
  constexpr std::size_t kMeansPerSecond = 10;
  const auto second = static_cast<std::size_t>(std::max(1LL, std::llround(rate_hz)));
  const std::size_t step = std::max<std::size_t>(second / kMeansPerSecond, 1);
  if (x.size() < 2 * kBatchSeconds * second) return std::nullopt;
  return batch_slope(means(x, second, step), means(y, second, step), kBatchSeconds * second / step);
}

std::optional<bool> within(const Measured& deviation, double limit) noexcept {
  const double error = 2.0 * deviation.standard_error;
  const double size = std::abs(deviation.value);
  if (error > limit && !(size - error > limit)) return std::nullopt;
  return size <= limit;
}

std::optional<SwingResponse> swing_response(std::span<const double> change, SampleRange range,
                                            double frequency, double amplitude, std::size_t batch) {
  assert(amplitude > 0.0 && frequency > 0.0 && frequency < 0.5 && batch >= 1);
  const std::size_t end = std::min(range.end, change.size());
  std::vector<SwingSums> batches;
  SwingSums all;
  for (std::size_t begin = range.begin; begin < end; begin += batch) {
    SwingSums sums;
    for (std::size_t t = begin; t < std::min(end, begin + batch); ++t) {
      if (std::isfinite(change[t])) sums.add(frequency, t, change[t]);
    }
    if (sums.count == 0.0) continue;
    all.add(sums, 1.0);
    batches.push_back(sums);
  }
  if (!all.tells(frequency)) return std::nullopt;
  const Eigen::Vector3d fit = all.fit();
  SwingResponse response;
  response.gain = std::hypot(fit[0], fit[1]) / amplitude;
  response.delay_samples = std::atan2(-fit[1], fit[0]) / (2.0 * std::numbers::pi * frequency);
  std::vector<double> without;
  for (const SwingSums& left_out : batches) {
    SwingSums others = all;
    others.add(left_out, -1.0);
    if (!others.tells(frequency)) return response;
    const Eigen::Vector3d other = others.fit();
    without.push_back(std::hypot(other[0], other[1]) / amplitude);
  }
  response.standard_error = jackknife_error(response.gain, without);
  return response;
}

std::optional<Measured> correlation_peak(std::span<const double> truth, std::span<const double> estimate,
                                         SampleRange range, std::size_t max_lag, std::size_t batch) {
  assert(batch >= 1);
  const std::size_t size = std::min(truth.size(), estimate.size());
  const std::size_t begin = std::max(range.begin, max_lag);
  const std::size_t end = std::min(range.end, size > max_lag ? size - max_lag : 0);
  if (begin + 2 > end || max_lag < 1) return std::nullopt;
  const auto right = truth.subspan(begin, end - begin);
  std::vector<std::vector<PairSums>> batches;  // [shift][batch]
  std::vector<PairSums> all;
  for (std::size_t i = 0; i <= 2 * max_lag; ++i) {
    batches.push_back(pair_sums(right, estimate.subspan(begin + i - max_lag, end - begin), batch));
    all.push_back(sum_of(batches.back()));
  }
  const auto peak = peak_of(all);
  if (!peak || *peak <= 0.0 || *peak >= 2.0 * static_cast<double>(max_lag)) return std::nullopt;
  std::vector<double> without;
  for (std::size_t b = 0; b < batches.front().size(); ++b) {
    if (batches[max_lag][b].count == 0.0) continue;
    std::vector<PairSums> others = all;
    for (std::size_t i = 0; i < others.size(); ++i) others[i] -= batches[i][b];
    if (const auto other = peak_of(others)) without.push_back(*other);
  }
  return Measured{*peak - static_cast<double>(max_lag), jackknife_error(*peak, without)};
}

}  // namespace gyrod::core
