#include "core/evaluation/joints.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gyrod::core {
namespace {

constexpr std::size_t kFewest = 10;

/// Sizes of differences, at joints and elsewhere.
struct Sorted {
  std::vector<double> at;
  std::vector<double> elsewhere;

  void add(bool joint, double value) {
    if (std::isfinite(value)) (joint ? at : elsewhere).push_back(std::abs(value));
  }
};

double rms(const std::vector<double>& x) noexcept {
  double sum = 0.0;
  for (const double value : x) sum += value * value;
  return std::sqrt(sum / static_cast<double>(x.size()));
}

double quantile_95(std::vector<double> x) {
  const auto rank = static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(x.size() - 1));
  std::ranges::nth_element(x, x.begin() + rank);
  return x[static_cast<std::size_t>(rank)];
}

}  // namespace

std::optional<JointFigures> joint_figures(const Contender& contender, SampleRange range) {
  if (!contender.joints || contender.joints->period == 0) return std::nullopt;
  const auto [period, first] = *contender.joints;
  const auto is_first = [period = period, first = first](std::size_t t) {
    return t % period == first % period;
  };
  const std::vector<double>& e = contender.estimate;
  const std::size_t end = std::min(range.end, e.size());
  Sorted bends;
  Sorted steps;
  for (std::size_t t = range.begin + 1; t + 1 < end; ++t) {
    bends.add(is_first(t) || is_first(t + 1), e[t - 1] - 2.0 * e[t] + e[t + 1]);
    steps.add(is_first(t), e[t] - e[t - 1]);
  }
  if (steps.at.size() < kFewest || bends.elsewhere.size() < kFewest || rms(bends.elsewhere) <= 0.0)
    return std::nullopt;
  const double limit = quantile_95(bends.elsewhere);
  const double beyond =
      static_cast<double>(std::ranges::count_if(bends.at, [limit](double bend) { return bend > limit; }));
  JointFigures figures;
  figures.roughness = rms(bends.at) / rms(bends.elsewhere);
  figures.outlier_share = beyond / static_cast<double>(bends.at.size());
  // Two second differences belong to one joint: they are not independent.
  figures.outlier_standard_error = std::sqrt(0.05 * 0.95 / static_cast<double>(steps.at.size()));
  figures.worst_step = std::ranges::max(steps.at) / rms(steps.elsewhere);
  figures.worst_step_elsewhere = std::ranges::max(steps.elsewhere) / rms(steps.elsewhere);
  return figures;
}

}  // namespace gyrod::core
