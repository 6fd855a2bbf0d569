#include "core/evaluation/rivals.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/evaluation/butterworth.hpp"

namespace gyrod::core {
namespace {

struct Traits {
  std::string_view name;
  RivalParameter parameter;
  std::size_t order;
  bool causal;
};

constexpr std::array<Traits, kRivals> kTraits = {{
    {"raw", RivalParameter::kNone, 0, true},
    {"bias-removed", RivalParameter::kOffset, 0, true},
    {"butterworth-1", RivalParameter::kCutoff, 1, true},
    {"butterworth-2", RivalParameter::kCutoff, 2, true},
    {"butterworth-4", RivalParameter::kCutoff, 4, true},
    {"exponential", RivalParameter::kShare, 0, true},
    {"moving-average", RivalParameter::kSamples, 0, true},
    {"savitzky-golay", RivalParameter::kSamples, 2, true},
    {"alpha-beta", RivalParameter::kIndex, 0, true},
    {"one-euro", RivalParameter::kCutoff, 0, true},
    {"zero-phase-1", RivalParameter::kCutoff, 1, false},
    {"zero-phase-2", RivalParameter::kCutoff, 2, false},
    {"zero-phase-4", RivalParameter::kCutoff, 4, false},
}};

const Traits& traits(Rival rival) noexcept { return kTraits[static_cast<std::size_t>(rival)]; }

std::vector<double> exponential(double share, std::span<const double> x) {
  std::vector<double> y(x.begin(), x.end());
  for (std::size_t t = 1; t < y.size(); ++t) y[t] = y[t - 1] + share * (x[t] - y[t - 1]);
  return y;
}

/// x[t - k], where x[0] stands for all before it.
double before(std::span<const double> x, std::size_t t, std::size_t k) noexcept {
  return x[t - std::min(t, k)];
}

/// Sums over the last `length` samples, weighted by 1, k and k^2, k = 0 the newest. Moved on by differences and made anew every
/// `length` samples, so that rounding does not grow with the record.
class WindowMoments {
 public:
  WindowMoments(std::span<const double> x, std::size_t length) noexcept : x_(x), length_(length) {}

  void at(std::size_t t) noexcept {
    if (t % length_ == 0) {
      sum_anew(t);
      return;
    }
    const double oldest = before(x_, t - 1, length_ - 1);
    const auto n = static_cast<double>(length_);
    second = second + 2.0 * first + zeroth - n * n * oldest;
    first = first + zeroth - n * oldest;
    zeroth += x_[t] - oldest;
  }

  double zeroth = 0.0;
  double first = 0.0;
  double second = 0.0;

 private:
  void sum_anew(std::size_t t) noexcept {
    zeroth = first = second = 0.0;
    for (std::size_t k = 0; k < length_; ++k) {
      const double value = before(x_, t, k);
      const auto weight = static_cast<double>(k);
      zeroth += value;
      first += weight * value;
      second += weight * weight * value;
    }
  }

  std::span<const double> x_;
  std::size_t length_;
};

std::size_t length_of(double samples) noexcept { return static_cast<std::size_t>(std::llround(samples)); }

std::vector<double> moving_average(std::size_t length, std::span<const double> x) {
  std::vector<double> y(x.size());
  WindowMoments moments(x, length);
  for (std::size_t t = 0; t < x.size(); ++t) {
    moments.at(t);
    y[t] = moments.zeroth / static_cast<double>(length);
  }
  return y;
}

/// With u = k - m, m the middle of the window, the least-squares parabola is c0 + c1 u + c2 u^2, where odd powers do not mix with even:
///   c1 = sum u x / s2,   c2 = (n sum u^2 x - s2 sum x) / (n s4 - s2^2),   c0 = (sum x - c2 s2) / n,   s_j = sum u^j.
/// Source: Savitzky, Golay 1964, Analytical Chemistry 36(8).
std::vector<double> savitzky_golay(std::size_t length, std::size_t delay, std::span<const double> x) {
  const auto n = static_cast<double>(length);
  const double middle = (n - 1.0) / 2.0;
  const double s2 = n * (n * n - 1.0) / 12.0;
  const double s4 = s2 * (3.0 * n * n - 7.0) / 20.0;
  const double u = static_cast<double>(delay) - middle;
  std::vector<double> y(x.size());
  WindowMoments moments(x, length);
  for (std::size_t t = 0; t < x.size(); ++t) {
    moments.at(t);
    const double sum_u = moments.first - middle * moments.zeroth;
    const double sum_u2 = moments.second - 2.0 * middle * moments.first + middle * middle * moments.zeroth;
    const double c2 = (n * sum_u2 - s2 * moments.zeroth) / (n * s4 - s2 * s2);
    const double c0 = (moments.zeroth - c2 * s2) / n;
    y[t] = c0 + u * (sum_u / s2 + u * c2);
  }
  return y;
}

std::vector<double> alpha_beta(double index, std::span<const double> x) {
  const AlphaBeta gain = alpha_beta_of(index);
  std::vector<double> y(x.begin(), x.end());
  double slope = 0.0;  // per sample
  for (std::size_t t = 1; t < y.size(); ++t) {
    const double predicted = y[t - 1] + slope;
    const double innovation = x[t] - predicted;
    y[t] = predicted + gain.alpha * innovation;
    slope += gain.beta * innovation;
  }
  return y;
}

double rms_step(std::span<const double> x) noexcept {
  double sum = 0.0;
  for (std::size_t t = 1; t < x.size(); ++t) sum += (x[t] - x[t - 1]) * (x[t] - x[t - 1]);
  return x.size() < 2 ? 0.0 : std::sqrt(sum / static_cast<double>(x.size() - 1));
}

/// Share of an exponential average with this cut-off, as the One-Euro filter has it: 1 / (1 + fs / (2 pi fc)).
double share_of(double cutoff) noexcept {
  const double turn = 2.0 * std::numbers::pi * cutoff;
  return turn / (1.0 + turn);
}

/// Casiez, Roussel, Vogel 2012, CHI. The slope is smoothed with a cut-off of 0.01 cycles per sample: 1 Hz at 100 Hz.
std::vector<double> one_euro(double least_cutoff, double second, std::span<const double> x) {
  constexpr double kSlopeCutoff = 0.01;
  const double step = rms_step(x);
  const double per_slope = step > 0.0 ? second / step : 0.0;
  std::vector<double> y(x.begin(), x.end());
  double slope = 0.0;
  for (std::size_t t = 1; t < y.size(); ++t) {
    slope += share_of(kSlopeCutoff) * (x[t] - y[t - 1] - slope);
    y[t] = y[t - 1] + share_of(least_cutoff + per_slope * std::abs(slope)) * (x[t] - y[t - 1]);
  }
  return y;
}

std::vector<double> less(double offset, std::span<const double> x) {
  std::vector<double> y(x.begin(), x.end());
  for (double& value : y) value -= offset;
  return y;
}

std::vector<double> low_passed(const RivalSetting& setting, std::span<const double> x) {
  const auto sections = butterworth(traits(setting.rival).order, setting.parameter);
  if (!is_causal(setting.rival)) return filter_zero_phase(sections, setting.parameter, x);
  std::vector<double> y(x.begin(), x.end());
  filter_forward(sections, y);
  return y;
}

}  // namespace

std::string_view name_of(Rival rival) noexcept { return traits(rival).name; }

bool is_causal(Rival rival) noexcept { return traits(rival).causal; }

RivalParameter parameter_of(Rival rival) noexcept { return traits(rival).parameter; }

double pass_through_of(Rival rival) noexcept {
  constexpr double kWithoutEnd = std::numeric_limits<double>::infinity();
  switch (parameter_of(rival)) {
    case RivalParameter::kNone:
    case RivalParameter::kOffset:
      return 0.0;
    case RivalParameter::kCutoff:
      return rival == Rival::kOneEuro ? kWithoutEnd : 0.5;
    case RivalParameter::kShare:
    case RivalParameter::kSamples:
      return 1.0;
    case RivalParameter::kIndex:
      break;
  }
  return kWithoutEnd;
}

AlphaBeta alpha_beta_of(double tracking_index) noexcept {
  assert(tracking_index > 0.0);
  const double index = tracking_index;
  // (4 + L - sqrt(8 L + L^2)) / 4 without its cancellation for large L
  const double r = 4.0 / (4.0 + index + std::sqrt(8.0 * index + index * index));
  const double alpha = 1.0 - r * r;
  return {alpha, 2.0 * (2.0 - alpha) - 4.0 * r};
}

std::vector<double> rival_output(const RivalSetting& setting, std::span<const double> x) {
  if (x.empty()) return {};
  if (setting.rival == Rival::kBiasRemoved) return less(setting.parameter, x);
  if (setting.rival == Rival::kRaw || setting.parameter == pass_through_of(setting.rival))
    return {x.begin(), x.end()};
  switch (setting.rival) {
    case Rival::kExponential:
      return exponential(setting.parameter, x);
    case Rival::kMovingAverage:
      return moving_average(length_of(setting.parameter), x);
    case Rival::kSavitzkyGolay:
      return savitzky_golay(std::max<std::size_t>(3, length_of(setting.parameter)), setting.delay, x);
    case Rival::kAlphaBeta:
      return alpha_beta(setting.parameter, x);
    case Rival::kOneEuro:
      return one_euro(setting.parameter, setting.second, x);
    default:
      return low_passed(setting, x);
  }
}

std::vector<double> rival_estimate(const RivalSetting& setting, std::span<const double> x) {
  std::vector<double> y = rival_output(setting, x);
  const std::size_t delay = std::min(setting.delay, y.size());
  std::rotate(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(delay), y.end());
  std::fill(y.end() - static_cast<std::ptrdiff_t>(delay), y.end(), std::numeric_limits<double>::quiet_NaN());
  return y;
}

}  // namespace gyrod::core
