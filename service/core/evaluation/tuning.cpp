#include "core/evaluation/tuning.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

namespace gyrod::core {
namespace {

constexpr double kFastest = 0.499;  // cycles per sample, just below Nyquist's
constexpr double kNever = std::numeric_limits<double>::infinity();

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
  }
  std::vector<double> grid(options.grid_points);
  const double steps = static_cast<double>(options.grid_points - 1);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    grid[i] = std::exp(std::lerp(std::log(low), std::log(high), static_cast<double>(i) / steps));
  }
  grid.back() = high;
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
  if (rival == Rival::kRaw || rival == Rival::kBiasRemoved) {
    search.fixed(rival == Rival::kRaw ? 0.0 : mean_error(on));
    return search.take();
  }
  // Cut-off, in cycles per sample, that a step as large as the root mean square one adds.
  constexpr std::array<double, 8> kSeconds = {0.0, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0};
  const std::size_t seconds = rival == Rival::kOneEuro ? kSeconds.size() : 1;
  for (std::size_t i = 0; i < seconds; ++i) search.over_grid(kSeconds[i]);
  search.refine();
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
