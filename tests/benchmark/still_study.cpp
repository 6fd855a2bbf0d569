// Sensors at rest: how quiet the estimates are, and how soon a step of the bias comes through. The tables of docs/measured.md, "At rest".
//   GYROD_DATA=... still_study [calibrated|standstill] [repeats]
// For every axis of the three ADIS16405 recordings: the ten minutes after the first one, with the noise calibrated from samples 500 000 to
// 600 000, or learned at rest in that first minute. A step is added after 60 s; its response is the difference of two runs, with it and
// without it, so that the noise cancels, and the mean of `repeats` (8) stretches. Times are those of the samples that the estimates are
// of: joint delivers them 16 samples later.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/evaluated_methods.hpp"
#include "app/joint_contender.hpp"
#include "core/evaluation/statistics.hpp"
#include "core/noise/standstill_learner.hpp"
#include "core/noise/still_noise.hpp"
#include "core/signal/moments.hpp"
#include "files/record.hpp"
#include "settings/settings.hpp"
#include "support/drive_rows.hpp"

namespace {

using namespace gyrod;
using Estimator = std::function<std::vector<double>(std::span<const double>)>;

constexpr double kRateHz = 100.0;
constexpr std::size_t kMinute = 6000;
constexpr std::size_t kSettled = 2000;
constexpr std::size_t kStraight = 6000;
constexpr std::size_t kHold = 2000;
constexpr std::array<double, 2> kSteps_dps = {0.5, 0.05};

struct StillAxis {
  std::vector<double> dps;
  core::NoiseModel calibrated;  ///< (deg/s)^2, kNoiseMargin as strong as measured
  core::NoiseModel standstill;
};

std::array<StillAxis, 3> load(char imu) {
  files::RecordOptions options;
  options.sample_rate_hz = kRateHz;
  const std::string name = std::string("adis16405_imu") + imu + "_static_100hz.csv.gz";
  const files::Record record = files::load_record((test::data_folder() / name).string(), options);
  core::StandstillLearner learner(kRateHz);
  for (std::size_t n = 0; n < kMinute; ++n) {
    learner.step({record.gyro_radps[0][n], record.gyro_radps[1][n], record.gyro_radps[2][n]});
  }
  std::array<StillAxis, 3> axes;
  for (std::size_t i = 0; i < 3; ++i) {
    constexpr double kDegrees = 180.0 / std::numbers::pi;
    for (const double rate : record.gyro_radps[i]) axes[i].dps.push_back(rate * kDegrees);
    const auto elsewhere = core::still_noise(std::span(axes[i].dps).subspan(500'000, 100'000));
    axes[i].calibrated = core::scaled(elsewhere.value(), core::kNoiseMargin);
    axes[i].standstill = core::scaled(learner.models()[i], core::kNoiseMargin * kDegrees);
  }
  return axes;
}

std::array<Estimator, 3> estimators(const core::NoiseModel& noise, const settings::Settings& settings) {
  const auto joint = [noise](bool realtime) {
    app::JointRun run;
    run.noise[0] = app::known_throughout(noise);
    return [run, realtime](std::span<const double> dps) {
      const std::array answers = {app::JointAnswer{.realtime = realtime}};
      return app::joint_contenders(run, answers, 0, {dps}).front().estimate;
    };
  };
  const core::Method paper =
      app::evaluated_method({"improved", settings.engine.lag_samples}, {settings, kRateHz, {}});
  return {joint(false), joint(true),
          [paper](std::span<const double> dps) { return paper.run(dps).estimate; }};
}

/// Seconds until the mean response has 90 % of the step; nothing where it does not within the hold.
std::optional<double> time_of_90(const Estimator& estimate, std::span<const double> dps, double step_dps,
                                 std::size_t repeats) {
  std::vector<double> response(kHold, 0.0);
  for (std::size_t k = 0; k < repeats; ++k) {
    const auto stretch = dps.subspan(k * kMinute, kStraight + kHold + 100);
    std::vector<double> stepped(stretch.begin(), stretch.end());
    for (std::size_t n = kStraight; n < stepped.size(); ++n) stepped[n] += step_dps;
    const std::vector<double> without = estimate(stretch);
    const std::vector<double> with = estimate(stepped);
    for (std::size_t n = 0; n < kHold; ++n) response[n] += with[kStraight + n] - without[kStraight + n];
  }
  for (std::size_t n = 0; n < kHold; ++n) {
    if (response[n] >= 0.9 * step_dps * static_cast<double>(repeats)) return static_cast<double>(n) / kRateHz;
  }
  return std::nullopt;
}

void print_times(const std::array<Estimator, 3>& all, std::span<const double> dps, std::size_t repeats) {
  for (const double step : kSteps_dps) {
    std::printf(" |");
    for (const Estimator& estimate : all) {
      const auto time = time_of_90(estimate, dps, step, repeats);
      if (time)
        std::printf(" %5.2f", *time);
      else
        std::printf("  none");
    }
  }
}

void judge(const std::string& name, std::span<const double> dps, const core::NoiseModel& noise,
           std::size_t repeats) {
  const settings::Settings settings;
  const auto all = estimators(noise, settings);
  const auto record = dps.subspan(kMinute, 10 * kMinute);
  const auto judged = record.subspan(kSettled);
  const auto raw = core::batch_mean(judged, static_cast<std::size_t>(kRateHz)).value();
  std::printf("%-7s %.4f |", name.c_str(), std::sqrt(core::variance(judged)));
  std::array<double, 3> means{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::vector<double> estimate = all[i](record);
    const auto kept = std::span(estimate).subspan(kSettled);
    means[i] = core::mean(kept);
    std::printf(" %.4f", std::sqrt(core::variance(kept)));
  }
  std::printf(" |");
  for (const double mean : means) std::printf(" %6.3f", (mean - raw.value) / raw.standard_error);
  print_times(all, dps.subspan(kMinute), repeats);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string source = argc > 1 ? argv[1] : "calibrated";
  const std::size_t repeats = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 8;
  if ((source != "calibrated" && source != "standstill") || repeats == 0) {
    std::fprintf(stderr, "usage: still_study [calibrated|standstill] [repeats]\n");
    return 2;
  }
  if (!std::filesystem::exists(test::data_folder() / "adis16405_imu1_static_100hz.csv.gz")) {
    std::fprintf(stderr, "still_study: no recordings in %s\n", test::data_folder().c_str());
    return 1;
  }
  std::printf("noise %s; each: joint, realtime, paper\n", source.c_str());
  std::printf("%-7s %6s | %-20s | %-20s | %-17s | %-17s\n", "axis", "raw", "std, deg/s", "mean moved, in SE",
              "0.5 deg/s, s", "0.05 deg/s, s");
  for (const char imu : {'1', '2', '4'}) {
    const auto axes = load(imu);
    for (std::size_t i = 0; i < axes.size(); ++i) {
      judge(std::string("imu") + imu + " " + "xyz"[i], axes[i].dps,
            source == "calibrated" ? axes[i].calibrated : axes[i].standstill, repeats);
    }
  }
  return 0;
}
