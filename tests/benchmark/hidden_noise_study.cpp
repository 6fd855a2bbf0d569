// What is learned of a sensor's noise while it moves: behind a low-pass of its own, and of what passes for rest. And what that is worth. For docs/joint.md,
// docs/measured.md, docs/decisions/0012 and 0013:
//
//   GYROD_DATA=... hidden_noise_study [errors] [RATE LOW_PASS [z]]
//
// Motion of two cars' reference gyros, of a car's roof, and of hand-held sensors, resampled by lines, 90 s at most, and on the three axes the noise of imu1 x, imu1 y and
// imu4 x at rest, sample by sample, all behind a low-pass of second order. A line each: sample rate, low-pass (0: none), motion, scale of the noise; when it was
// learned, s, and its variance in parts of the true one on x, y, z; and likewise what was learned of what passed for rest, in the end, and its lines.
// With `errors` behind it, of these rows, once either has been in use for 5 s and in the last 60 % at most: the errors of gyro/denoised, rms deg/s, of the raw rates, without what was learned, with it, and
// calibrated at rest elsewhere; and the mean of error^2 over the published variance of the last three. On each axis. Of all sensors, or of one by its
// sample rate and low-pass, Hz; with z, the third axis has the noise of imu4 z, with a line at a fifth of the sample rate: where that is found, and how strong, in
// parts of the noise.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "app/offline_denoiser.hpp"
#include "core/evaluation/butterworth.hpp"
#include "core/noise/hidden_noise_learner.hpp"
#include "core/noise/standstill_learner.hpp"
#include "core/noise/still_noise.hpp"
#include "settings/noise_calibration.hpp"
#include "support/drive_rows.hpp"
#include "support/scratch_folder.hpp"

namespace {

using namespace gyrod;
using Axes = std::array<std::vector<double>, 3>;

constexpr double kDegPerRad = 180.0 / std::numbers::pi;
constexpr double kMostSeconds = 90.0;
constexpr double kJudgedFrom = 0.4;
constexpr double kSettling_s = 5.0;

struct Recording {
  std::string name;
  std::string file;
  double rate_hz;
};
const std::array<Recording, 6> kRecordings = {
    {{"06", "wid_car_trial06_xsensdot_120hz.csv.gz", 120.0},
     {"09", "wid_car_trial09_xsensdot_120hz.csv.gz", 120.0},
     {"0708", "drive0708_lsm6_100hz.csv.gz", 100.0},
     {"room1", "tumvi_room1_bmi160_200hz.csv.gz", 200.0},
     {"room3", "tumvi_room3_bmi160_200hz.csv.gz", 200.0},
     {"broad24", "broad_24_disturbed_tapping_A_286hz.csv.gz", 285.7}}};

/// deg/s, at another rate by lines.
Axes motion_of(const Recording& recording, double rate_hz) {
  const files::Record record = test::detail::load(recording.file, recording.rate_hz);
  Axes axes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto reference = record.others.find(std::string("ref_gyro_") + "xyz"[axis] + "_dps");
    std::vector<double> rates =
        reference != record.others.end() ? test::bridged(reference->second) : record.gyro_radps[axis];
    if (reference == record.others.end())
      for (double& rate : rates) rate *= kDegPerRad;
    const double step = recording.rate_hz / rate_hz;
    const auto count = static_cast<std::size_t>(
        std::min(static_cast<double>(rates.size() - 1) / step, kMostSeconds * rate_hz));
    for (std::size_t n = 0; n < count; ++n) {
      const double at = static_cast<double>(n) * step;
      const auto k = static_cast<std::size_t>(at);
      axes[axis].push_back(std::lerp(rates[k], rates[k + 1], at - static_cast<double>(k)));
    }
  }
  return axes;
}

/// deg/s, of a sensor at rest, from a sample on.
Axes noise_from(std::size_t start, std::size_t size, double scale, bool with_line) {
  const std::size_t third = with_line ? 2 : 0;
  static const std::array<std::vector<double>, 3> still = {
      test::detail::still_dps({}, 100.0), test::detail::still_dps({.axis = 1}, 100.0),
      test::detail::still_dps({.file = "adis16405_imu4_static_100hz.csv.gz", .axis = third}, 100.0)};
  Axes axes;
  for (std::size_t axis = 0; axis < 3; ++axis)
    axes[axis] = test::noise_of(std::span(still[axis]).subspan(start, size), scale);
  return axes;
}

void low_pass(Axes& axes, double cutoff) {
  if (cutoff == 0.0) return;
  for (auto& axis : axes) core::filter_forward(core::butterworth(2, cutoff), axis);
}

double mean_square(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum / static_cast<double>(values.size());
}

struct Answers final : app::RowHandler {
  void on_denoised(const std::string&, const std::array<double, 3>& rates,
                   const std::array<double, 3>& deviations) override {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rate[axis].push_back(kDegPerRad * rates[axis]);
      deviation[axis].push_back(kDegPerRad * deviations[axis]);
    }
  }
  void on_refused(const std::string&) override {}
  Axes rate;
  Axes deviation;
};

class Row {
 public:
  Row(const Recording& recording, double rate_hz, double low_pass_hz, double scale, bool with_line)
      : rate_hz_(rate_hz), truth_(motion_of(recording, rate_hz)) {
    constexpr std::size_t kCalibratedFrom = 260'000;
    const std::size_t size = truth_[0].size();
    const double cutoff = low_pass_hz / rate_hz;
    noise_ = noise_from(10'000, size, scale, with_line);
    still_ = noise_from(kCalibratedFrom, size, scale, with_line);
    for (Axes* axes : {&truth_, &noise_, &still_}) low_pass(*axes, cutoff);
    measured_ = truth_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t n = 0; n < size; ++n) measured_[axis][n] += noise_[axis][n];
    }
    std::printf("%4.0f %3.0f %-7s x%-3g |", rate_hz, low_pass_hz, recording.name.c_str(), scale);
  }

  /// @return first sample behind which it is known; 0 where it never is
  std::size_t learn() const {
    core::HiddenNoiseLearner in_motion(rate_hz_);
    core::StandstillLearner at_rest(rate_hz_);
    const std::size_t moving = learn(in_motion);
    const std::size_t resting = learn(at_rest);
    const core::NoiseModel& z = in_motion.models()[2];
    if (moving == 0)
      std::printf(" nothing learned");
    else if (core::is_usable(z) || z.line_count == 0)
      print_learned(moving, in_motion.models());
    else
      std::printf(" %5.1f s, line of z at %.1f Hz %.2f", static_cast<double>(moving) / rate_hz_,
                  rate_hz_ * z.line[0].cycles,
                  kDegPerRad * kDegPerRad * z.line[0].variance / mean_square(noise_[2]));
    if (resting > 0) {
      std::printf(" | at rest");
      print_learned(resting, at_rest.models());
      std::printf(", lines");
      for (const core::NoiseModel& model : at_rest.models()) std::printf(" %zu", model.line_count);
    }
    std::printf("\n");
    return moving == 0 ? resting : resting == 0 ? moving : std::min(moving, resting);
  }

  void print_errors(std::size_t known) const {
    const auto size = static_cast<double>(truth_[0].size());
    const auto begin = std::max(known + static_cast<std::size_t>(kSettling_s * rate_hz_),
                                static_cast<std::size_t>(kJudgedFrom * size));
    if (begin + known / 10 > truth_[0].size()) return;
    std::printf("    raw       ");
    for (const auto& axis : noise_)
      std::printf(" %6.3f", std::sqrt(mean_square(std::span(axis).subspan(begin))));
    std::printf("\n");
    settings::Settings guessing;
    guessing.noise.source = settings::NoiseSource::kImf1;
    print_error("guessed", guessing, begin);
    print_error("learned", {}, begin);
    testing::ScratchFolder folder;
    settings::NoiseCalibration calibration;
    calibration.sample_rate_hz = rate_hz_;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      calibration.models[axis] =
          core::scaled(core::still_noise(still_[axis]).value_or(core::NoiseModel{}), 1.0 / kDegPerRad);
    }
    folder.write("still.json", settings::calibration_text(calibration));
    settings::Settings calibrated;
    calibrated.noise.calibrations = folder.path("still.json");
    print_error("calibrated", calibrated, begin);
  }

 private:
  /// @return first sample behind which something is known; 0 where nothing ever is
  template <class Learner>
  std::size_t learn(Learner& learner) const {
    std::size_t known = 0;
    for (std::size_t n = 0; n < truth_[0].size(); ++n) {
      learner.step(
          {measured_[0][n] / kDegPerRad, measured_[1][n] / kDegPerRad, measured_[2][n] / kDegPerRad});
      if (known == 0 && (core::is_usable(learner.models()[0]) || learner.models()[2].line_count > 0))
        known = n;
    }
    return known;
  }

  void print_learned(std::size_t known, const std::array<core::NoiseModel, 3>& models) const {
    std::printf(" %5.1f s", static_cast<double>(known) / rate_hz_);
    if (!core::is_usable(models[0])) std::printf(", forgotten since");
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double variance = kDegPerRad * kDegPerRad * core::noise_variance(models[axis]);
      std::printf(" %5.2f", variance / mean_square(noise_[axis]));
    }
  }

  void print_error(const char* name, const settings::Settings& settings, std::size_t begin) const {
    Answers answers;
    app::DenoiseSummary summary;
    app::OfflineDenoiser denoiser(settings, answers, summary);
    for (std::size_t n = 0; n < truth_[0].size(); ++n) {
      files::RecordingRow row;
      row.sample.sequence = n;
      row.sample.stamp_ns = std::llround(static_cast<double>(n) * 1e9 / rate_hz_);
      for (std::size_t axis = 0; axis < 3; ++axis)
        row.sample.rate_radps[axis] = measured_[axis][n] / kDegPerRad;
      denoiser.push(row);
    }
    denoiser.finish();
    std::printf("    %-10s", name);
    std::array<double, 3> normalised{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double> error;
      for (std::size_t n = begin; n < truth_[axis].size(); ++n)
        error.push_back(answers.rate[axis][n] - truth_[axis][n]);
      normalised[axis] = mean_square(error) / mean_square(std::span(answers.deviation[axis]).subspan(begin));
      std::printf(" %6.3f", std::sqrt(mean_square(error)));
    }
    std::printf("  error^2 over variance %9.3g %9.3g %9.3g\n", normalised[0], normalised[1], normalised[2]);
    std::fflush(stdout);
  }

  double rate_hz_;
  Axes truth_;
  Axes noise_;
  Axes still_;
  Axes measured_;
};

}  // namespace

int main(int argc, char** argv) {
  const bool errors = argc > 1 && std::string(argv[1]) == "errors";
  const int one = errors ? 2 : 1;
  const auto wanted = [&](double rate_hz, double low_pass_hz) {
    return argc <= one + 1 || (rate_hz == std::stod(argv[one]) && low_pass_hz == std::stod(argv[one + 1]));
  };
  const std::array<std::pair<double, double>, 14> sensors = {{{1000, 188},
                                                              {1000, 98},
                                                              {1000, 41},
                                                              {500, 41},
                                                              {400, 92},
                                                              {400, 41},
                                                              {250, 41},
                                                              {200, 42},
                                                              {200, 20},
                                                              {100, 20},
                                                              {400, 0},
                                                              {200, 0},
                                                              {100, 0},
                                                              {50, 0}}};
  for (const auto& [rate_hz, low_pass_hz] : sensors) {
    if (!wanted(rate_hz, low_pass_hz)) continue;
    for (const Recording& recording : kRecordings) {
      for (const double scale : {0.3, 1.0, 3.0}) {
        const Row row(recording, rate_hz, low_pass_hz, scale, argc > one + 2);
        const std::size_t known = row.learn();
        std::fflush(stdout);
        if (errors && known > 0) row.print_errors(known);
      }
    }
  }
}
