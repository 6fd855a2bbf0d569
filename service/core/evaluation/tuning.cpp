#include "core/evaluation/tuning.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

namespace gyrod::core {
namespace {

constexpr double kFastest = 0.499;       // cycles per sample, just below Nyquist's
constexpr double kFastestOneEuro = 1e2;  // of which a sample weighs 0.998
constexpr double kNever = std::numeric_limits<double>::infinity();
/// Least and largest cut-off, in cycles per sample, that One-Euro adds for a step as large as the root mean square one; besides none.
constexpr double kLeastSecond = 1e-3;
constexpr double kLargestSecond = 1e4;

struct Answer {
  double rmse = kNever;
  std::size_t delay = 0;
};

/// The least error of one filter for every bound: element d is the best with a delay of at most d.
std::vector<Answer> answers(RivalSetting setting, const TuningCase& on, std::size_t largest_delay) {
  std::vector<Answer> best(largest_delay + 1);
  const bool own_filter_each = setting.rival == Rival::kSavitzkyGolay;
  std::vector<double> y;
  for (std::size_t delay = 0; delay <= largest_delay; ++delay) {
    setting.delay = delay;
    if (delay == 0 || own_filter_each) y = rival_output(setting, on.noisy);
    const double rmse = delayed_rmse(y, delay, on.truth, on.range);
    best[delay] = {rmse, delay};
    if (delay > 0 && best[delay - 1].rmse <= rmse) best[delay] = best[delay - 1];
  }
  return best;
}

/// Every length with its neighbour: the middle of an even window lies between two samples, so that on a steep signal all odd ones
/// may be better than all even ones.
std::vector<double> whole_lengths(const std::vector<double>& grid) {
  std::vector<double> lengths;
  for (const double point : grid) {
    lengths.push_back(std::round(point));
    lengths.push_back(std::round(point) + 1.0);
  }
  std::ranges::sort(lengths);
  lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
  return lengths;
}

std::vector<double> logarithmic(double low, double high, std::size_t points) {
  std::vector<double> grid(points);
  const double steps = static_cast<double>(points - 1);
  for (std::size_t i = 0; i < points; ++i) {
    grid[i] = std::exp(std::lerp(std::log(low), std::log(high), static_cast<double>(i) / steps));
  }
  grid.back() = high;
  return grid;
}

/// Parameters are searched by their logarithm, from the first to the last of the grid.
std::vector<double> grid_of(Rival rival, const TuningOptions& options) {
  double low = options.slowest;
  double high = kFastest;
  if (parameter_of(rival) == RivalParameter::kSamples) {
    low = 1.0;
    high = static_cast<double>(options.longest_window);
  } else if (parameter_of(rival) == RivalParameter::kShare) {
    high = 1.0;
  } else if (parameter_of(rival) == RivalParameter::kIndex) {
    low = options.slowest * options.slowest;
    high = 1e2;
  } else if (rival == Rival::kOneEuro) {
    high = kFastestOneEuro;
  }
  const std::vector<double> grid = logarithmic(low, high, options.grid_points);
  return parameter_of(rival) == RivalParameter::kSamples ? whole_lengths(grid) : grid;
}

class Search {
 public:
  Search(Rival rival, const TuningCase& on, std::span<const std::size_t> bounds, const TuningOptions& options)
      : on_(on), bounds_(bounds), grid_(grid_of(rival, options)), best_(bounds.size()) {
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      best_[i] = {.lag_bound = bounds[i], .setting = {.rival = rival}, .rmse = kNever};
      if (is_causal(rival)) largest_ = std::max(largest_, bounds[i]);
    }
  }

  /// With no parameter to search.
  void fixed(double parameter) { offer({.rival = rival(), .parameter = parameter}, 0, bounds_.size()); }

  void over_grid(double second) {
    for (const double parameter : grid_) offer({rival(), parameter, second, 0}, 0, bounds_.size());
  }

  void refine() {
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
      if (!std::isfinite(best_[i].rmse)) continue;
      if (parameter_of(rival()) == RivalParameter::kSamples) {
        every_length(i);
      } else {
        golden_section(i);
      }
    }
  }

  /// For a filter with two parameters, of which the grid is this fine: to the best of eight neighbours, and nearer where none is better.
  void refine_both(double second_ratio) {
    constexpr int kHalvings = 8;
    const double ratio = grid_[1] / grid_[0];
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
      if (!std::isfinite(best_[i].rmse)) continue;
      RivalSetting centre = best_[i].setting;
      centre.second = std::max(centre.second, kLeastSecond);
      double step = 0.5;  // in parts of the grid's
      for (int halving = 0; halving < kHalvings; ++halving, step *= 0.5) {
        walk(i, centre, std::pow(ratio, step), std::pow(second_ratio, step));
      }
    }
  }

  [[nodiscard]] std::vector<TunedRival> take() {
    for (TunedRival& tuned : best_) {
      if (!std::isfinite(tuned.rmse)) tuned.rmse = std::numeric_limits<double>::quiet_NaN();
    }
    return std::move(best_);
  }

 private:
  [[nodiscard]] Rival rival() const noexcept { return best_.front().setting.rival; }

  /// Takes a filter for the bounds [from, to) for which it is better than what they have. @return its error at the bound `from`
  double offer(const RivalSetting& setting, std::size_t from, std::size_t to) {
    const bool one = to - from == 1;
    const std::vector<Answer> all = answers(setting, on_, one ? std::min(bounds_[from], largest_) : largest_);
    const auto answer = [&](std::size_t i) { return all[std::min(bounds_[i], all.size() - 1)]; };
    for (std::size_t i = from; i < to; ++i) {
      if (!(answer(i).rmse < best_[i].rmse)) continue;
      best_[i].rmse = answer(i).rmse;
      best_[i].setting = setting;
      best_[i].setting.delay = answer(i).delay;
    }
    return answer(from).rmse;
  }

  /// The grid's neighbours of the best point.
  [[nodiscard]] std::pair<double, double> neighbours(std::size_t i) const {
    const auto at = std::ranges::lower_bound(grid_, best_[i].setting.parameter);
    const auto below = at == grid_.begin() ? at : at - 1;
    const auto above = at + 1 == grid_.end() ? at : at + 1;
    return {*below, *above};
  }

  /// Moves on as long as one of the neighbours is better; they are so far as the ratios say.
  void walk(std::size_t i, RivalSetting& centre, double ratio, double second_ratio) {
    constexpr int kFarthest = 32;
    for (int moves = 0; moves < kFarthest; ++moves) {
      const RivalSetting from = centre;
      const double error = best_[i].rmse;
      for (const double along : {1.0 / ratio, 1.0, ratio}) {
        for (const double across : {1.0 / second_ratio, 1.0, second_ratio}) {
          const double parameter = std::clamp(along * from.parameter, grid_.front(), grid_.back());
          const double second = across * from.second;
          offer({rival(), parameter, second < kLeastSecond ? 0.0 : second, 0}, i, i + 1);
        }
      }
      if (!(best_[i].rmse < error)) return;
      centre = best_[i].setting;
    }
  }

  void every_length(std::size_t i) {
    const auto [low, high] = neighbours(i);
    const auto first = static_cast<std::size_t>(std::ceil(low));
    const auto last = static_cast<std::size_t>(std::floor(high));
    for (std::size_t length = first; length <= last; ++length)
      offer({rival(), static_cast<double>(length), 0.0, 0}, i, i + 1);
  }

  void golden_section(std::size_t i) {
    constexpr int kSteps = 16;  // the bracket shrinks by 0.618^16 = 4.5e-4
    constexpr double kGolden = 1.0 / std::numbers::phi;
    const double second = best_[i].setting.second;
    const auto error = [&](double log_parameter) {
      return offer({rival(), std::exp(log_parameter), second, 0}, i, i + 1);
    };
    auto [low, high] = neighbours(i);
    low = std::log(low);
    high = std::log(high);
    double left = high - kGolden * (high - low);
    double right = low + kGolden * (high - low);
    double left_error = error(left);
    double right_error = error(right);
    for (int step = 0; step < kSteps; ++step) {
      if (left_error <= right_error) {
        high = right;
        right = left;
        right_error = left_error;
        left = high - kGolden * (high - low);
        left_error = error(left);
      } else {
        low = left;
        left = right;
        left_error = right_error;
        right = low + kGolden * (high - low);
        right_error = error(right);
      }
    }
  }

  const TuningCase& on_;
  std::span<const std::size_t> bounds_;
  std::vector<double> grid_;
  std::vector<TunedRival> best_;
  std::size_t largest_ = 0;
};

/// Over cut-offs that a step adds, none and such that are half a decade apart.
void search_both(Search& search) {
  constexpr std::size_t kSeconds = 15;
  const std::vector<double> seconds = logarithmic(kLeastSecond, kLargestSecond, kSeconds);
  search.over_grid(0.0);
  for (const double second : seconds) search.over_grid(second);
  search.refine_both(seconds[1] / seconds[0]);
}

/// The offset that leaves no mean error: nobody can remove a bias better.
double mean_error(const TuningCase& on) noexcept {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t t = on.range.begin; t < std::min(on.range.end, on.truth.size()); ++t) {
    if (!std::isfinite(on.truth[t])) continue;
    sum += on.noisy[t] - on.truth[t];
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

double delayed_rmse(std::span<const double> y, std::size_t delay, std::span<const double> truth,
                    SampleRange range) noexcept {
  const std::size_t reach = y.size() > delay ? y.size() - delay : 0;
  const std::size_t end = std::min({range.end, truth.size(), reach});
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t t = range.begin; t < end; ++t) {
    const double error = y[t + delay] - truth[t];
    if (!std::isfinite(error)) continue;
    sum += error * error;
    ++count;
  }
  return count == 0 ? kNever : std::sqrt(sum / static_cast<double>(count));
}

std::vector<TunedRival> tune(Rival rival, const TuningCase& on, std::span<const std::size_t> lag_bounds,
                             const TuningOptions& options) {
  assert(on.noisy.size() == on.truth.size() && !lag_bounds.empty() && options.grid_points >= 3);
  Search search(rival, on, lag_bounds, options);
  if (rival == Rival::kBiasRemoved) {
    search.fixed(mean_error(on));
  } else if (rival == Rival::kOneEuro) {
    search_both(search);
  } else if (rival != Rival::kRaw) {
    search.over_grid(0.0);
    search.refine();
  }
  search.fixed(pass_through_of(rival));
  return search.take();
}

Method method_of(const TunedRival& tuned) {
  const RivalSetting setting = tuned.setting;
  const auto run = [setting](std::span<const double> noisy) {
    Contender contender;
    contender.name = name_of(setting.rival);
    contender.lag_samples = setting.delay;
    contender.estimate = rival_estimate(setting, noisy);
    return contender;
  };
  return {std::string(name_of(setting.rival)), setting.delay, run};
}

}  // namespace gyrod::core
