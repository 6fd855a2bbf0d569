// What the detector of rest takes for rest, against what is known of the motion, for docs/noise.md:
//
//   rest_study [DATA]
//
// DATA is the folder of recordings, ../shared/data unless given.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/evaluation/butterworth.hpp"
#include "core/noise/standstill_learner.hpp"
#include "core/simulation/simulated_gyro.hpp"
#include "files/record.hpp"

namespace {

using namespace gyrod;
using core::NoiseModel;

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

files::Record load(const std::filesystem::path& path, std::optional<double> rate = std::nullopt) {
  files::RecordOptions options;
  options.sample_rate_hz = rate;
  options.other_columns = true;
  return files::load_record(path.string(), options);
}

/// What is known of a recording's motion: at rest or not, at a time on the recording's clock.
using Truth = std::function<std::optional<bool>(double time_s)>;

struct RestTally {
  double rest = 0.0;        ///< truth, s
  double found = 0.0;       ///< of these
  double motion = 0.0;      ///< truth, s
  double false_rest = 0.0;  ///< of these
  double first = -1.0;      ///< s into the recording
  std::array<double, 6> verdicts{};
};

RestTally tally(const files::Record& record, const Truth& truth, bool with_accelerometer) {
  core::StandstillLearner learner(record.sample_rate_hz);
  const auto column = [&](const char* name) -> const std::vector<double>* {
    for (const char* unit : {"_mps2", "_g"}) {
      const auto found = record.others.find(std::string("accel_") + name + unit);
      if (found != record.others.end()) return &found->second;
    }
    return nullptr;
  };
  const std::array<const std::vector<double>*, 3> accel = {column("x"), column("y"), column("z")};
  core::Triple last{};
  RestTally result;
  const double period = 1.0 / record.sample_rate_hz;
  for (std::size_t n = 0; n < record.size(); ++n) {
    core::Triple rate{};
    for (std::size_t a = 0; a < 3; ++a) {
      rate[a] = record.gyro_radps[a][n];
      if (with_accelerometer && std::isfinite((*accel[a])[n])) last[a] = (*accel[a])[n];
    }
    learner.step(rate, with_accelerometer ? &last : nullptr);
    result.verdicts[static_cast<std::size_t>(learner.detector().verdict())] += period;
    const auto known = truth(record.first_stamp_s + record.time_s[n]);
    if (!known) continue;
    (*known ? result.rest : result.motion) += period;
    if (!learner.at_rest()) continue;
    (*known ? result.found : result.false_rest) += period;
    if (result.first < 0.0) result.first = record.time_s[n];
  }
  std::printf(
      "   %-8s at rest %8.1f s, found %8.1f; moving %7.1f s, false %5.1f; first after %5.1f s; learned %.0f "
      "s:",
      with_accelerometer ? "gyro+acc" : "gyro", result.rest, result.found, result.motion, result.false_rest,
      result.first, learner.rest_seconds());
  for (const NoiseModel& model : learner.models())
    std::printf(" %.4f", std::sqrt(core::noise_variance(model)) * kDegPerRad);
  std::printf(" dps\n      early %.0f frozen %.0f uneven %.0f wandering %.0f tone %.0f rest %.0f s\n",
              result.verdicts[0], result.verdicts[1], result.verdicts[2], result.verdicts[3],
              result.verdicts[4], result.verdicts[5]);
  return result;
}

void study_rest(const files::Record& record, const Truth& truth) {
  std::printf("%s, %.2f Hz\n", record.name.c_str(), record.sample_rate_hz);
  tally(record, truth, false);
  if (record.others.contains("accel_x_g") || record.others.contains("accel_x_mps2"))
    tally(record, truth, true);
}

/// The same sensors with a low-pass of their own, of second order, accelerometer and all.
void study_low_passed(const files::Record& record, const Truth& truth) {
  for (const double cutoff_hz : {42.0, 20.0, 10.0, 5.0, 2.5}) {
    files::Record slow = record;
    const auto sections = core::butterworth(2, cutoff_hz / record.sample_rate_hz);
    for (auto& axis : slow.gyro_radps) core::filter_forward(sections, axis);
    for (auto& [name, column] : slow.others) {
      if (!name.starts_with("accel_")) continue;
      for (std::size_t n = 1; n < column.size(); ++n)
        if (!std::isfinite(column[n])) column[n] = column[n - 1];
      core::filter_forward(sections, column);
    }
    char cutoff[32];
    std::snprintf(cutoff, sizeof cutoff, " behind %.1f Hz", cutoff_hz);
    slow.name += cutoff;
    study_rest(slow, truth);
  }
}

/// Parked below 0.1 m/s by RTK; within a second of any faster fix it moves.
Truth drive_truth(const std::filesystem::path& fixes) {
  std::ifstream file(fixes);
  std::string line;
  std::getline(file, line);
  std::vector<std::pair<double, double>> speeds;
  while (std::getline(file, line)) {
    std::ranges::replace(line, ',', ' ');
    std::istringstream words(line);
    std::array<double, 12> value{};
    for (double& v : value) words >> v;
    speeds.emplace_back(value[0], std::hypot(value[9], value[10], value[11]));
  }
  return [speeds](double t) -> std::optional<bool> {
    bool known = false;
    for (const auto& [time, speed] : speeds) {
      if (std::abs(time - t) > 1.0) continue;
      known = true;
      if (speed > 0.1) return false;
    }
    return known ? std::optional(true) : std::nullopt;
  };
}

void simulated(double vibration, double engine) {
  files::Record record;
  core::SimulatedGyroOptions options;
  options.drive.emplace();
  options.drive->road_vibration_radps = vibration;
  options.drive->engine_tone_radps = engine;
  options.seed = 11;
  core::SimulatedGyro gyro(options);
  const std::size_t size = 360'000;
  std::vector<bool> still(size);
  for (std::size_t n = 0; n < size; ++n) {
    const auto sample = gyro.next();
    record.time_s.push_back(static_cast<double>(n) / 100.0);
    bool zero = true;
    for (std::size_t a = 0; a < 3; ++a) {
      record.gyro_radps[a].push_back(sample.measured_radps[a]);
      zero = zero && std::abs(sample.truth_radps[a]) < 1e-6;
    }
    still[n] = zero;
  }
  record.sample_rate_hz = 100.0;
  record.name = "simulated hour, road vibration " + std::to_string(vibration) + ", engine " +
                std::to_string(engine) + " rad/s";
  study_rest(record, [&still](double t) -> std::optional<bool> {
    return still[std::min(static_cast<std::size_t>(std::lround(t * 100.0)), still.size() - 1)];
  });
}

/// The motion of a car's reference-grade gyro under the real noise of another sensor, times `factor`. The car stands, engine running,
/// at the beginning and the end: with more noise than engine that is rest, so only the drive between is asked for.
void noisy_drive(const files::Record& drive, const files::Record& still, double factor,
                 std::pair<double, double> moving) {
  files::Record record = drive;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto& reference = drive.others.at(std::string("ref_gyro_") + "xyz"[a] + "_dps");
    double last = 0.0;
    for (std::size_t n = 0; n < record.size(); ++n) {
      // The reference was lost for a moment.
      if (std::isfinite(reference[n])) last = reference[n] / kDegPerRad;
      record.gyro_radps[a][n] = last + factor * still.gyro_radps[a][n];
    }
  }
  record.name += ", reference and " + std::to_string(factor) + " times " + still.name;
  study_rest(record, [moving](double t) -> std::optional<bool> {
    return t > moving.first && t < moving.second ? std::optional(false) : std::nullopt;
  });
}

void rest(const std::filesystem::path& data) {
  const Truth always = [](double) { return std::optional(true); };
  const Truth never = [](double) { return std::optional(false); };
  const auto study_both = [](const files::Record& record, const Truth& truth) {
    study_rest(record, truth);
    study_low_passed(record, truth);
  };
  for (const char* imu : {"imu1", "imu2", "imu4"})
    study_both(load(data / ("adis16405_" + std::string(imu) + "_static_100hz.csv.gz"), 100.0), always);
  study_both(load(data / "mpu6050_static_10min_100hz.csv.gz", 100.0), always);
  study_both(load(data / "drive0708_lsm6_100hz.csv.gz"), drive_truth(data / "drive0708_gnss_rtk_4hz.csv"));
  for (const char* trial : {"06", "09"})
    study_both(load(data / ("wid_car_trial" + std::string(trial) + "_xsensdot_120hz.csv.gz")), never);
  const auto still = load(data / "adis16405_imu1_static_100hz.csv.gz", 100.0);
  const auto trial06 = load(data / "wid_car_trial06_xsensdot_120hz.csv.gz");
  const auto trial09 = load(data / "wid_car_trial09_xsensdot_120hz.csv.gz");
  for (const double factor : {0.3, 1.0, 3.0}) {
    noisy_drive(trial06, still, factor, {12.0, 56.0});
    noisy_drive(trial09, still, factor, {24.0, 110.0});
  }
  for (const char* broad :
       {"02_undisturbed_slow_rotation_B", "10_undisturbed_slow_translation_A", "24_disturbed_tapping_A"}) {
    const auto record = load(data / ("broad_" + std::string(broad) + "_286hz.csv.gz"));
    const auto& movement = record.others.at("movement");
    study_both(record, [&](double t) -> std::optional<bool> {
      const double n = std::round((t - record.first_stamp_s) * record.sample_rate_hz);
      return movement[std::min(static_cast<std::size_t>(std::max(n, 0.0)), movement.size() - 1)] == 0.0;
    });
  }
  for (const char* room : {"room1", "room3"})
    study_both(load(data / ("tumvi_" + std::string(room) + "_bmi160_200hz.csv.gz")), never);
  simulated(0.003, 0.0);
  simulated(0.0, 0.0);
  simulated(0.003, 0.01);
}

}  // namespace

int main(int argc, char** argv) {
  rest(argc > 1 ? argv[1] : "../shared/data");
  return 0;
}
