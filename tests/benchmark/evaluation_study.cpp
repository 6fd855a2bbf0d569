// Filters tuned on the truth, on a car's reference gyro plus the noise of a still one: RMSE in deg/s over samples 2400..9600.
//   GYROD_DATA=... evaluation_study          best causal Butterworth (order 1, 2, 4; any delay <= L) and best zero-phase one
//   GYROD_DATA=... evaluation_study --all    every rival by itself
//   GYROD_DATA=... evaluation_study --scale-factor
//       what a scale factor near 1 costs without look-ahead: the best causal linear filter of 96 samples, and the best of those that give back so
//       much of the truth in means over 1 s
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "core/evaluation/tuning.hpp"
#include "support/drive_rows.hpp"

namespace {

using gyrod::core::Rival;
using gyrod::core::TunedRival;

constexpr std::array<std::size_t, 3> kLags = {0, 8, 16};

std::vector<TunedRival> tuned(Rival rival, const gyrod::test::DriveRow& row) {
  const gyrod::core::TuningCase on{
      row.noisy_dps, row.truth_dps, {gyrod::test::kJudgedBegin, gyrod::test::kJudgedEnd}};
  return gyrod::core::tune(rival, on, kLags);
}

/// The better for each lag.
std::vector<TunedRival> best_of(std::initializer_list<Rival> rivals, const gyrod::test::DriveRow& row) {
  std::vector<TunedRival> best;
  for (const Rival rival : rivals) {
    const auto now = tuned(rival, row);
    if (best.empty()) best = now;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (now[i].rmse < best[i].rmse) best[i] = now[i];
    }
  }
  return best;
}

std::string words(const TunedRival& best, double rate_hz) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%s %.3g Hz d %zu",
                std::string(name_of(best.setting.rival)).c_str(), best.setting.parameter * rate_hz,
                best.setting.delay);
  return text.data();
}

void butterworth_rows(const std::vector<gyrod::test::DriveRow>& rows) {
  std::printf("%-12s %7s | %6s %6s %6s | %6s | filters\n", "row", "raw", "L = 0", "8", "16", "zero");
  for (const auto& row : rows) {
    const auto raw = tuned(Rival::kRaw, row);
    const auto causal = best_of({Rival::kButterworth1, Rival::kButterworth2, Rival::kButterworth4}, row);
    const auto zero = best_of({Rival::kZeroPhase1, Rival::kZeroPhase2, Rival::kZeroPhase4}, row);
    std::printf("%-12s %7.4f | %6.3f %6.3f %6.3f | %6.3f | %s; %s; %s; %s\n", row.name.c_str(), raw[0].rmse,
                causal[0].rmse, causal[1].rmse, causal[2].rmse, zero[0].rmse,
                words(causal[0], row.rate_hz).c_str(), words(causal[1], row.rate_hz).c_str(),
                words(causal[2], row.rate_hz).c_str(), words(zero[0], row.rate_hz).c_str());
  }
}

void all_rows(const std::vector<gyrod::test::DriveRow>& rows) {
  std::printf("%-12s %-16s %7s %7s %7s   parameter, second, delay at L = 16\n", "row", "rival", "L = 0", "8",
              "16");
  for (const auto& row : rows) {
    for (const Rival rival : gyrod::core::kAllRivals) {
      const auto best = tuned(rival, row);
      std::printf("%-12s %-16s %7.4f %7.4f %7.4f   %.4g, %.3g, %zu\n", row.name.c_str(),
                  std::string(name_of(rival)).c_str(), best[0].rmse, best[1].rmse, best[2].rmse,
                  best[2].setting.parameter, best[2].setting.second, best[2].setting.delay);
    }
  }
}

/// All causal linear filters of some samples on a row: their error is a quadratic form in the weights, and their scale factor, as the guard has it
/// (one less the slope of the means over 1 s, ten a second, of what is taken away on those of the truth), is linear in them.
class LinearFilters {
 public:
  explicit LinearFilters(const gyrod::test::DriveRow& row) {
    std::size_t known = 0;
    for (std::size_t now = gyrod::test::kJudgedBegin; now < gyrod::test::kJudgedEnd; ++now) {
      const double truth = row.truth_dps[now];
      if (!std::isfinite(truth)) continue;
      const Eigen::VectorXd delayed = delayed_to(now, row.noisy_dps);
      power_.noalias() += delayed * delayed.transpose();
      shared_ += truth * delayed;
      truth_power_ += truth * truth;
      ++known;
    }
    const auto samples = static_cast<double>(known);
    power_ /= samples;
    shared_ /= samples;
    truth_power_ /= samples;
    set_slopes(row);
  }

  [[nodiscard]] Eigen::VectorXd best() const { return power_.ldlt().solve(shared_); }
  [[nodiscard]] Eigen::VectorXd best_with(double scale_factor) const {
    const Eigen::LDLT<Eigen::MatrixXd> factors(power_);
    const Eigen::VectorXd direction = factors.solve(slopes_);
    const Eigen::VectorXd weights = factors.solve(shared_);
    return weights + direction * (scale_factor - this->scale_factor(weights)) / slopes_.dot(direction);
  }
  [[nodiscard]] double rmse(const Eigen::VectorXd& weights) const {
    return std::sqrt(truth_power_ - 2.0 * shared_.dot(weights) + weights.dot(power_ * weights));
  }
  [[nodiscard]] double scale_factor(const Eigen::VectorXd& weights) const {
    return 1.0 - slopes_(0) + slopes_.dot(weights);
  }

 private:
  static constexpr Eigen::Index kTaps = 96;

  /// x[now], x[now - 1], ...
  static Eigen::VectorXd delayed_to(std::size_t now, const std::vector<double>& x) {
    Eigen::VectorXd delayed(kTaps);
    for (Eigen::Index k = 0; k < kTaps; ++k) delayed(k) = x[now - static_cast<std::size_t>(k)];
    return delayed;
  }
  /// Where the truth was lost for a sample, nothing is known of the seconds that hold it.
  void set_slopes(const gyrod::test::DriveRow& row) {
    const auto second = static_cast<std::size_t>(std::lround(row.rate_hz));
    std::vector<double> truths;
    std::vector<Eigen::VectorXd> means;
    for (std::size_t begin = gyrod::test::kJudgedBegin; begin + second <= gyrod::test::kJudgedEnd;
         begin += second / 10) {
      double truth = 0.0;
      Eigen::VectorXd delayed = Eigen::VectorXd::Zero(kTaps);
      for (std::size_t now = begin; now < begin + second; ++now) {
        truth += row.truth_dps[now] / static_cast<double>(second);
        delayed += delayed_to(now, row.noisy_dps) / static_cast<double>(second);
      }
      if (!std::isfinite(truth)) continue;
      truths.push_back(truth);
      means.push_back(delayed);
    }
    Eigen::VectorXd moved = Eigen::Map<const Eigen::VectorXd>(truths.data(), std::ssize(truths));
    moved.array() -= moved.mean();
    for (std::size_t i = 0; i < means.size(); ++i)
      slopes_ += moved(static_cast<Eigen::Index>(i)) / moved.squaredNorm() * means[i];
  }

  Eigen::MatrixXd power_ = Eigen::MatrixXd::Zero(kTaps, kTaps);
  Eigen::VectorXd shared_ = Eigen::VectorXd::Zero(kTaps);
  double truth_power_ = 0.0;
  Eigen::VectorXd slopes_ = Eigen::VectorXd::Zero(kTaps);  ///< of the delayed samples' means on the truth's
};

void scale_factor_rows(const std::vector<gyrod::test::DriveRow>& rows) {
  constexpr std::array kScaleFactors = {0.943, 0.979, 0.995};
  std::printf("%-12s | %14s | RMSE with", "row", "best: RMSE, sf");
  for (const double wanted : kScaleFactors) std::printf(" %.3f ", wanted);
  for (const auto& row : rows) {
    const LinearFilters filters(row);
    const Eigen::VectorXd best = filters.best();
    std::printf("\n%-12s | %7.4f %6.3f | %9s", row.name.c_str(), filters.rmse(best),
                filters.scale_factor(best), "");
    for (const double wanted : kScaleFactors) std::printf(" %6.4f", filters.rmse(filters.best_with(wanted)));
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (!gyrod::test::has_drive_rows()) {
    std::fprintf(stderr, "evaluation_study: no recordings in %s\n", gyrod::test::data_folder().c_str());
    return 1;
  }
  const auto rows = gyrod::test::drive_rows();
  const std::string wanted = argc > 1 ? argv[1] : "";
  if (wanted == "--all") {
    all_rows(rows);
  } else if (wanted == "--scale-factor") {
    scale_factor_rows(rows);
  } else {
    butterworth_rows(rows);
  }
  return 0;
}
