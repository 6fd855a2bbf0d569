/// Rows on which estimators are compared: what a car's reference gyro measured, plus the noise of a sensor that lay still. Made from
/// the recordings of GYROD_DATA; whoever uses them skips where that folder is absent. Link gyrod_files.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/signal/interpolation.hpp"
#include "core/simulation/drive_motion.hpp"
#include "files/record.hpp"
#include "support/data_folder.hpp"

namespace gyrod::test {

/// Samples [kJudgedBegin, kJudgedEnd) are judged: 20 s to 80 s at 120 Hz, when every estimator has settled.
inline constexpr std::size_t kJudgedBegin = 2400;
inline constexpr std::size_t kJudgedEnd = 9600;

/// One recording and axis at one scale of the noise. All rates in deg/s.
struct DriveRow {
  std::string name;  ///< "06 x", "09 z at 0.3"
  std::string drive;
  std::size_t axis = 0;  ///< 0..2, of the reference gyro, not turned into the MEMS sensor's axes
  double noise_scale = 1.0;
  double rate_hz = 120.0;  ///< of the drive; the noise was recorded at 100 Hz and is taken sample by sample
  std::vector<double> truth_dps;  ///< NaN where the reference was lost
  std::vector<double>
      noisy_dps;  ///< finite: the truth, lost stretches bridged by straight lines, plus the noise
  std::vector<double> still_dps;  ///< another stretch of the same noise at the same scale, its mean removed
};

/// Which still recording is the noise, and where it starts.
struct NoiseChoice {
  std::string file = "adis16405_imu1_static_100hz.csv.gz";
  std::size_t axis = 0;
  std::size_t start = 0;
  std::size_t still_start = 500'000;  ///< far from the noise that is added
  std::size_t still_samples = 100'000;
};

/// Ten minutes of an MPU6050, calibrated on the last four.
inline NoiseChoice mpu6050_noise(std::size_t axis, std::size_t start) {
  NoiseChoice noise;
  noise.file = "mpu6050_static_10min_100hz.csv.gz";
  noise.axis = axis;
  noise.start = start;
  noise.still_start = 40'000;
  noise.still_samples = 25'000;
  return noise;
}

inline bool has_drive_rows(const NoiseChoice& noise = {}) {
  const auto there = [](const std::string& name) { return std::filesystem::exists(data_folder() / name); };
  return there("wid_car_trial06_xsensdot_120hz.csv.gz") && there("wid_car_trial09_xsensdot_120hz.csv.gz") &&
         there(noise.file);
}

/// NaN between two numbers becomes a straight line; NaN at an end the nearest number.
inline std::vector<double> bridged(std::vector<double> values) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::size_t last = kNone;
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!std::isfinite(values[n])) continue;
    const std::size_t first_lost = last == kNone ? 0 : last + 1;
    const double left = last == kNone ? values[n] : values[last];
    for (std::size_t lost = first_lost; lost < n; ++lost) {
      values[lost] = core::bridge(left, values[n], lost - first_lost, n - first_lost);
    }
    last = n;
  }
  for (std::size_t n = last + 1; last != kNone && n < values.size(); ++n) values[n] = values[last];
  return values;
}

/// The deviation of a stretch from its own mean, times `scale`.
inline std::vector<double> noise_of(std::span<const double> stretch, double scale) {
  double mean = 0.0;
  for (const double value : stretch) mean += value / static_cast<double>(stretch.size());
  std::vector<double> noise(stretch.begin(), stretch.end());
  for (double& value : noise) value = scale * (value - mean);
  return noise;
}

namespace detail {

inline files::Record load(const std::string& name, double rate_hz) {
  files::RecordOptions options;
  options.sample_rate_hz = rate_hz;
  options.other_columns = true;
  return files::load_record((data_folder() / name).string(), options);
}

inline std::string row_name(const std::string& drive, std::size_t axis, double scale) {
  const std::string name = drive + " " + "xyz"[axis];
  if (scale == 1.0) return name;
  return name + (scale < 1.0 ? " at 0.3" : " at 3");
}

/// A sensor's noise at rest, deg/s.
inline std::vector<double> still_dps(const NoiseChoice& noise, double rate_hz) {
  std::vector<double> still = load(noise.file, rate_hz).gyro_radps[noise.axis];
  for (double& value : still) value *= 180.0 / std::numbers::pi;
  return still;
}

/// The row of a truth.
inline DriveRow noisy_row(const std::string& drive, std::size_t axis, double rate_hz,
                          std::vector<double> truth_dps, std::span<const double> still,
                          const NoiseChoice& noise, double scale) {
  DriveRow row;
  row.name = row_name(drive, axis, scale);
  row.drive = drive;
  row.axis = axis;
  row.noise_scale = scale;
  row.rate_hz = rate_hz;
  row.truth_dps = std::move(truth_dps);
  row.noisy_dps = bridged(row.truth_dps);
  const auto added = noise_of(still.subspan(noise.start, row.noisy_dps.size()), scale);
  for (std::size_t n = 0; n < added.size(); ++n) row.noisy_dps[n] += added[n];
  row.still_dps = noise_of(still.subspan(noise.still_start, noise.still_samples), scale);
  return row;
}

}  // namespace detail

/// The 18 rows of two drives, three axes and noise scaled by 1, 0.3 and 3, in this order. All rows have the same noise.
/// @pre has_drive_rows(noise)
inline std::vector<DriveRow> drive_rows(const NoiseChoice& noise = {}) {
  constexpr double kRateHz = 120.0;
  const std::vector<double> still = detail::still_dps(noise, kRateHz);
  std::vector<DriveRow> rows;
  for (const double scale : {1.0, 0.3, 3.0}) {
    for (const std::string drive : {"06", "09"}) {
      const files::Record record = detail::load("wid_car_trial" + drive + "_xsensdot_120hz.csv.gz", kRateHz);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        auto truth = record.others.at(std::string("ref_gyro_") + "xyz"[axis] + "_dps");
        rows.push_back(detail::noisy_row(drive, axis, kRateHz, std::move(truth), still, noise, scale));
      }
    }
  }
  return rows;
}

/// A recording whose own rates serve as truth, and how it is called.
struct Motion {
  std::string name;
  std::string file;
  double rate_hz;
};

/// Sensors moved by hand, with knocks, at rest in between: motion unlike a car's.
inline const std::array<Motion, 5>& hand_motions() {
  static const std::array<Motion, 5> motions = {
      {{"room1", "tumvi_room1_bmi160_200hz.csv.gz", 200.0},
       {"room3", "tumvi_room3_bmi160_200hz.csv.gz", 200.0},
       {"broad02", "broad_02_undisturbed_slow_rotation_B_286hz.csv.gz", 285.7},
       {"broad10", "broad_10_undisturbed_slow_translation_A_286hz.csv.gz", 285.7},
       {"broad24", "broad_24_disturbed_tapping_A_286hz.csv.gz", 285.7}}};
  return motions;
}

inline bool has_hand_rows(const NoiseChoice& noise = {}) {
  const auto there = [](const std::string& name) { return std::filesystem::exists(data_folder() / name); };
  return there(noise.file) &&
         std::ranges::all_of(hand_motions(), [&there](const Motion& motion) { return there(motion.file); });
}

/// The 45 rows of five recordings, three axes and noise scaled by 1, 0.3 and 3: the rates as recorded, their own noise included, are the
/// truth. @pre has_hand_rows(noise)
inline std::vector<DriveRow> hand_rows(const NoiseChoice& noise = {}) {
  constexpr double kNoiseRateHz = 100.0;
  const std::vector<double> still = detail::still_dps(noise, kNoiseRateHz);
  std::vector<DriveRow> rows;
  for (const double scale : {1.0, 0.3, 3.0}) {
    for (const Motion& motion : hand_motions()) {
      const files::Record record = detail::load(motion.file, motion.rate_hz);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<double> truth = record.gyro_radps[axis];
        for (double& value : truth) value *= 180.0 / std::numbers::pi;
        rows.push_back(
            detail::noisy_row(motion.name, axis, motion.rate_hz, std::move(truth), still, noise, scale));
      }
    }
  }
  return rows;
}

inline const std::string& shaking_file() {
  static const std::string name = "drive0708_lsm6_100hz.csv.gz";
  return name;
}

inline bool has_shaking_rows(const NoiseChoice& noise = {}) {
  return std::filesystem::exists(data_folder() / noise.file) &&
         std::filesystem::exists(data_folder() / shaking_file());
}

/// Nine rows of a sensor on a car's roof, 200 s at most; from where it has idled for 30 s it drives off, and shakes by up to 10 deg/s at all frequencies.
/// Three axes and noise scaled by 1, 0.3 and 3; the rates as recorded are the truth. @pre has_shaking_rows(noise)
inline std::vector<DriveRow> shaking_rows(const NoiseChoice& noise = {}, double begin_s = 30.0) {
  constexpr double kRateHz = 100.0;
  constexpr std::ptrdiff_t kMostSamples = 20'000;
  const std::vector<double> still = detail::still_dps(noise, kRateHz);
  const files::Record record = detail::load(shaking_file(), kRateHz);
  std::vector<DriveRow> rows;
  for (const double scale : {1.0, 0.3, 3.0}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& rates = record.gyro_radps[axis];
      const auto size = static_cast<std::ptrdiff_t>(rates.size());
      const auto first = std::min(static_cast<std::ptrdiff_t>(begin_s * kRateHz), size);
      std::vector<double> truth(rates.begin() + first, rates.begin() + std::min(first + kMostSamples, size));
      for (double& value : truth) value *= 180.0 / std::numbers::pi;
      rows.push_back(detail::noisy_row("shaking", axis, kRateHz, std::move(truth), still, noise, scale));
    }
  }
  return rows;
}

/// Smooth motion far above the noise, deg/s: a swell on x, roundabouts of 90 degrees on y, slow bends of a motorway on z.
inline std::vector<double> smooth_motion(std::size_t axis, double rate_hz, std::size_t size) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  std::vector<double> x(size);
  for (std::size_t n = 0; n < size; ++n) {
    const double t = static_cast<double>(n) / rate_hz;
    const auto tone = [t](double amplitude, double frequency_hz, double phase) {
      return amplitude * std::sin(kTurn * frequency_hz * t + phase);
    };
    if (axis == 0) {
      x[n] = tone(8.0, 0.11, 0.0) + tone(3.0, 0.17, 1.0) + tone(1.5, 0.29, 2.0);
    } else if (axis == 1) {  // 6 s of every 12, to the left and to the right, raised cosines
      const double within = std::fmod(t, 12.0);
      const double side = std::fmod(t, 24.0) < 12.0 ? 1.0 : -1.0;
      x[n] = within < 6.0 ? side * 15.0 * (1.0 - std::cos(kTurn * within / 6.0)) : 0.0;
    } else {
      x[n] = tone(2.0, 0.021, 0.0) + tone(1.0, 0.047, 1.0);
    }
  }
  return x;
}

/// Nine rows of smooth_motion(), 100 s, three axes and noise scaled by 1, 0.3 and 3. @pre the noise's file is there
inline std::vector<DriveRow> smooth_rows(const NoiseChoice& noise = {}) {
  constexpr double kNoiseRateHz = 100.0;
  constexpr double kRateHz = 120.0;
  const std::vector<double> still = detail::still_dps(noise, kNoiseRateHz);
  std::vector<DriveRow> rows;
  for (const double scale : {1.0, 0.3, 3.0}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto truth = smooth_motion(axis, kRateHz, 12'000);
      rows.push_back(detail::noisy_row("smooth", axis, kRateHz, std::move(truth), still, noise, scale));
    }
  }
  return rows;
}

/// Simulated drives, seeds 1 to 6, 100 Hz, 90 s: 54 rows of three axes and noise scaled by 1, 0.3 and 3. @pre the noise's file is there
inline std::vector<DriveRow> simulated_rows(const NoiseChoice& noise = {}) {
  constexpr double kRateHz = 100.0;
  const std::vector<double> still = detail::still_dps(noise, kRateHz);
  std::vector<DriveRow> rows;
  for (const double scale : {1.0, 0.3, 3.0}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      core::DriveMotion motion({}, kRateHz, seed);
      std::array<std::vector<double>, 3> truth;
      for (int n = 0; n < 9000; ++n) {
        const auto rate = motion.next();
        for (std::size_t axis = 0; axis < 3; ++axis)
          truth[axis].push_back(rate[axis] * 180.0 / std::numbers::pi);
      }
      for (std::size_t axis = 0; axis < 3; ++axis)
        rows.push_back(detail::noisy_row("sim" + std::to_string(seed), axis, kRateHz, std::move(truth[axis]),
                                         still, noise, scale));
    }
  }
  return rows;
}

}  // namespace gyrod::test
