#include "core/evaluation/seams.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gyrod::core {
namespace {

constexpr std::size_t kFewest = 10;

/// Sizes of differences, at seams and elsewhere.
struct Sorted {
  std::vector<double> at;
  std::vector<double> elsewhere;

  void add(bool seam, double value) {
    if (std::isfinite(value)) (seam ? at : elsewhere).push_back(std::abs(value));
  }
};

double rms(const std::vector<double>& x) noexcept {
  double sum = 0.0;
  for (const double value : x) sum += value * value;
  return std::sqrt(sum / static_cast<double>(x.size()));
}

/// Sums of squares by the place in the period; a seam at place p lies in the second differences about p and p - 1.
class Roughness {
 public:
  explicit Roughness(std::size_t period) : squares_(period), counts_(period) {}

  void add(std::size_t t, double bend) {
    if (!std::isfinite(bend)) return;
    const std::size_t place = t % squares_.size();
    squares_[place] += bend * bend;
    counts_[place] += 1.0;
    all_ += bend * bend;
    count_ += 1.0;
  }

  /// @return rms at seams at this place / rms elsewhere; 0 where that says nothing
  [[nodiscard]] double at(std::size_t place) const noexcept {
    const std::size_t before = (place + squares_.size() - 1) % squares_.size();
    const double squares = squares_[place] + squares_[before];
    const double count = counts_[place] + counts_[before];
    if (count == 0.0 || count == count_ || !(all_ > squares)) return 0.0;
    return std::sqrt(squares / count / ((all_ - squares) / (count_ - count)));
  }

  /// The largest at places that share no second difference with this one.
  [[nodiscard]] double largest_beside(std::size_t place) const noexcept {
    double largest = 0.0;
    for (std::size_t away = 2; away + 1 < squares_.size(); ++away)
      largest = std::max(largest, at((place + away) % squares_.size()));
    return largest;
  }

 private:
  std::vector<double> squares_;
  std::vector<double> counts_;
  double all_ = 0.0;
  double count_ = 0.0;
};

/// The largest step at each place of the period.
class LargestSteps {
 public:
  explicit LargestSteps(std::size_t period) : largest_(period) {}

  void add(std::size_t t, double step) {
    double& largest = largest_[t % largest_.size()];
    if (std::isfinite(step)) largest = std::max(largest, std::abs(step));
  }

  [[nodiscard]] double at(std::size_t place) const noexcept { return largest_[place]; }

  /// @return what those at the other places let expect of this one; 0 where nothing moves there
  [[nodiscard]] double by_chance(std::size_t place) const noexcept {
    constexpr double kDeviations = 3.0;
    double count = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    double largest = 0.0;
    for (std::size_t p = 0; p < largest_.size(); ++p) {
      if (p == place || !(largest_[p] > 0.0)) continue;
      const double x = std::log(largest_[p]);
      count += 1.0;
      sum += x;
      squares += x * x;
      largest = std::max(largest, largest_[p]);
    }
    if (count == 0.0) return 0.0;
    const double mean = sum / count;
    const double variance = std::max(squares / count - mean * mean, 0.0);
    return std::max(std::exp(mean + kDeviations * std::sqrt(variance)), largest);
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
  const auto [period, first] = *contender.seams;
  const auto is_first = [period = period, first = first](std::size_t t) {
    return t % period == first % period;
  };
  const std::vector<double>& e = contender.estimate;
  const std::size_t end = std::min({range.end, e.size(), truth.size()});
  Sorted bends;
  Sorted steps;
  Roughness roughness(period);
  Roughness of_truth(period);
  LargestSteps largest(period);
  for (std::size_t t = range.begin + 1; t + 1 < end; ++t) {
    const double bend = bend_of(e, t);
    bends.add(is_first(t) || is_first(t + 1), bend);
    roughness.add(t, bend);
    of_truth.add(t, bend_of(truth, t));
    steps.add(is_first(t), e[t] - e[t - 1]);
    largest.add(t, e[t] - e[t - 1]);
  }
  if (steps.at.size() < kFewest || bends.elsewhere.size() < kFewest || rms(bends.elsewhere) <= 0.0)
    return std::nullopt;
  const double limit = quantile_95(bends.elsewhere);
  const double beyond =
      static_cast<double>(std::ranges::count_if(bends.at, [limit](double bend) { return bend > limit; }));
  SeamFigures figures;
  figures.roughness = roughness.at(first % period);
  figures.roughness_of_truth = of_truth.at(first % period);
  figures.roughness_beside = roughness.largest_beside(first % period);
  figures.outlier_share = beyond / static_cast<double>(bends.at.size());
  // Two second differences belong to one seam: they are not independent.
  figures.outlier_standard_error = std::sqrt(0.05 * 0.95 / static_cast<double>(steps.at.size()));
  const double ordinary = rms(steps.elsewhere);
  figures.worst_step = largest.at(first % period) / ordinary;
  figures.worst_step_by_chance = largest.by_chance(first % period) / ordinary;
  return figures;
}

}  // namespace gyrod::core
