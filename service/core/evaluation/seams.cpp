#include "core/evaluation/seams.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gyrod::core {
namespace {

constexpr std::size_t kFewest = 10;

double rms(const std::vector<double>& x) noexcept {
  double sum = 0.0;
  for (const double value : x) sum += value * value;
  return std::sqrt(sum / static_cast<double>(x.size()));
}

/// What a figure at the other places lets expect of one more: 4 standard deviations above their mean, and at least the largest. Chance exceeds that
/// at one of some 300 to 2000 places, the largest alone at one of as many as there are (docs/evaluate.md). 0 where there are none.
double by_chance(std::span<const double> others) noexcept {
  constexpr double kDeviations = 4.0;
  if (others.empty()) return 0.0;
  const auto count = static_cast<double>(others.size());
  double sum = 0.0;
  double squares = 0.0;
  for (const double x : others) {
    sum += x;
    squares += x * x;
  }
  const double mean = sum / count;
  const double variance = std::max(squares / count - mean * mean, 0.0);
  return std::max(mean + kDeviations * std::sqrt(variance), *std::ranges::max_element(others));
}

/// The same of the largest of many, by their logarithms; those that are 0 say nothing. 0 where all are.
double largest_by_chance(std::span<const double> others) {
  std::vector<double> logarithms;
  for (const double x : others) {
    if (x > 0.0) logarithms.push_back(std::log(x));
  }
  return logarithms.empty() ? 0.0 : std::exp(by_chance(logarithms));
}

/// Mean of something about second differences by the place in the period; a seam at place p lies in those about p and p - 1.
class BendMeans {
 public:
  explicit BendMeans(std::size_t period) : sums_(period), counts_(period) {}

  void add(std::size_t t, double value) noexcept {
    if (!std::isfinite(value)) return;
    sums_[t % sums_.size()] += value;
    counts_[t % sums_.size()] += 1.0;
    sum_ += value;
    count_ += 1.0;
  }

  /// @return at seams at this place; NaN where nothing is known
  [[nodiscard]] double at(std::size_t place) const noexcept { return sum_at(place) / count_at(place); }
  /// @return at() / the mean elsewhere; 0 where that says nothing
  [[nodiscard]] double ratio(std::size_t place) const noexcept {
    const double sum = sum_at(place);
    const double count = count_at(place);
    if (count == 0.0 || count == count_ || !(sum_ > sum)) return 0.0;
    return sum / count / ((sum_ - sum) / (count_ - count));
  }
  /// What a function of the place is at those that share no second difference with this one.
  template <class Figure>
  [[nodiscard]] std::vector<double> beside(std::size_t place, const Figure& figure) const {
    std::vector<double> others;
    for (std::size_t away = 2; away + 1 < sums_.size(); ++away) {
      const double x = figure((place + away) % sums_.size());
      if (std::isfinite(x)) others.push_back(x);
    }
    return others;
  }

 private:
  [[nodiscard]] std::size_t before(std::size_t place) const noexcept {
    return (place + sums_.size() - 1) % sums_.size();
  }
  [[nodiscard]] double sum_at(std::size_t place) const noexcept {
    return sums_[place] + sums_[before(place)];
  }
  [[nodiscard]] double count_at(std::size_t place) const noexcept {
    return counts_[place] + counts_[before(place)];
  }

  std::vector<double> sums_;
  std::vector<double> counts_;
  double sum_ = 0.0;
  double count_ = 0.0;
};

/// The largest step at each place of the period.
class LargestSteps {
 public:
  explicit LargestSteps(std::size_t period) : largest_(period) {}

  void add(std::size_t t, double step) noexcept {
    double& largest = largest_[t % largest_.size()];
    if (std::isfinite(step)) largest = std::max(largest, std::abs(step));
  }

  [[nodiscard]] double at(std::size_t place) const noexcept { return largest_[place]; }
  [[nodiscard]] std::vector<double> beside(std::size_t place) const {
    std::vector<double> others = largest_;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(place));
    return others;
  }

 private:
  std::vector<double> largest_;
};

/// The second difference.
double bend_of(std::span<const double> x, std::size_t t) noexcept { return x[t - 1] - 2.0 * x[t] + x[t + 1]; }

double quantile_95(std::vector<double> x) {
  const auto rank = static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(x.size() - 1));
  std::ranges::nth_element(x, x.begin() + rank);
  return x[static_cast<std::size_t>(rank)];
}

}  // namespace

std::optional<SeamFigures> seam_figures(const Contender& contender, std::span<const double> truth,
                                        SampleRange range) {
  if (!contender.seams || contender.seams->period == 0) return std::nullopt;
  const std::size_t period = contender.seams->period;
  const std::size_t place = contender.seams->first % period;
  const auto is_first = [period, place](std::size_t t) { return t % period == place; };
  const std::vector<double>& e = contender.estimate;
  const std::size_t end = std::min({range.end, e.size(), truth.size()});
  std::vector<double> bends;  // sizes of those where no seam is
  std::vector<double> steps;
  std::vector<double> at_seams;
  BendMeans squares(period);
  BendMeans of_truth(period);
  LargestSteps largest(period);
  for (std::size_t t = range.begin + 1; t + 1 < end; ++t) {
    const double bend = bend_of(e, t);
    if (std::isfinite(bend) && !is_first(t) && !is_first(t + 1)) bends.push_back(std::abs(bend));
    squares.add(t, bend * bend);
    const double true_bend = bend_of(truth, t);
    of_truth.add(t, true_bend * true_bend);
    const double step = e[t] - e[t - 1];
    largest.add(t, step);
    if (std::isfinite(step)) (is_first(t) ? at_seams : steps).push_back(step);
  }
  if (at_seams.size() < kFewest || bends.size() < kFewest || rms(bends) <= 0.0) return std::nullopt;
  const double limit = quantile_95(bends);
  BendMeans beyond(period);
  for (std::size_t t = range.begin + 1; t + 1 < end; ++t) {
    const double size = std::abs(bend_of(e, t));
    if (std::isfinite(size)) beyond.add(t, size > limit ? 1.0 : 0.0);
  }
  const auto roughness_at = [&squares](std::size_t at) { return std::sqrt(squares.ratio(at)); };
  const auto share_at = [&beyond](std::size_t at) { return beyond.at(at); };
  const double ordinary = rms(steps);
  SeamFigures figures;
  figures.roughness = roughness_at(place);
  figures.roughness_of_truth = std::sqrt(of_truth.ratio(place));
  figures.roughness_by_chance = by_chance(squares.beside(place, roughness_at));
  figures.outlier_share = share_at(place);
  // Two second differences belong to one seam: they are not independent.
  figures.outlier_standard_error = std::sqrt(0.05 * 0.95 / static_cast<double>(at_seams.size()));
  figures.outlier_share_by_chance = by_chance(beyond.beside(place, share_at));
  figures.worst_step = largest.at(place) / ordinary;
  figures.worst_step_by_chance = largest_by_chance(largest.beside(place)) / ordinary;
  return figures;
}

}  // namespace gyrod::core
