// Rest and motion of real sensors. The recordings are not part of the project; skipped where they are absent.
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/evaluation/butterworth.hpp"
#include "core/noise/hidden_noise_learner.hpp"
#include "core/noise/standstill_learner.hpp"
#include "files/record.hpp"
#include "support/data_folder.hpp"
#include "support/drive_rows.hpp"

namespace gyrod::core {
namespace {

namespace fs = std::filesystem;

/// Share of the recording that is taken for rest, behind a low-pass of second order where there is to be one. @return nothing where
/// there is no such recording
std::optional<double> share_at_rest(const std::string& name, StandstillLearner& learner,
                                    std::optional<double> low_pass_hz = std::nullopt) {
  const fs::path path = test::data_folder() / name;
  if (!fs::exists(path)) return std::nullopt;
  files::RecordOptions options;
  options.sample_rate_hz = learner.state().sample_rate_hz;
  files::Record record = files::load_record(path.string(), options);
  if (low_pass_hz) {
    for (auto& axis : record.gyro_radps)
      filter_forward(butterworth(2, *low_pass_hz / *options.sample_rate_hz), axis);
  }
  double found = 0.0;
  for (std::size_t n = 0; n < record.size(); ++n) {
    learner.step({record.gyro_radps[0][n], record.gyro_radps[1][n], record.gyro_radps[2][n]});
    found += learner.at_rest() ? 1.0 : 0.0;
  }
  return found / static_cast<double>(record.size());
}

/// A car's motion by its reference gyro, and the noise of an ADIS16405's x, y and z, so many times as strong. rad/s. @pre test::has_drive_rows()
std::array<std::vector<double>, 3> trial06_in_noise(double scale) {
  const files::Record record = test::detail::load("wid_car_trial06_xsensdot_120hz.csv.gz", 120.0);
  std::array<std::vector<double>, 3> axes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    axes[axis] = test::bridged(record.others.at(std::string("ref_gyro_") + "xyz"[axis] + "_dps"));
    const std::vector<double> still = test::detail::still_dps({.axis = axis}, 100.0);
    const std::vector<double> noise =
        test::noise_of(std::span(still).subspan(10'000, axes[axis].size()), scale);
    for (std::size_t n = 0; n < noise.size(); ++n)
      axes[axis][n] = (axes[axis][n] + noise[n]) * std::numbers::pi / 180.0;
  }
  return axes;
}

TEST(RestOfRecordings, AStillSensorIsFoundAtRestNearlyAlways) {
  StandstillLearner learner(100.0);
  const auto share = share_at_rest("adis16405_imu4_static_100hz.csv.gz", learner);
  if (!share) GTEST_SKIP() << "no recordings in " << test::data_folder();
  EXPECT_GT(*share, 0.99) << "with its shocks";
  // The data folder's README: 0.350, 0.370, 0.432 deg/s for run 1 of this sensor; run 4 is another piece of it.
  constexpr double kDegPerRad = 57.29577951308232;
  EXPECT_NEAR(std::sqrt(noise_variance(learner.models()[0])) * kDegPerRad, 0.350, 0.015);
  EXPECT_NEAR(std::sqrt(noise_variance(learner.models()[1])) * kDegPerRad, 0.370, 0.015);
  EXPECT_NEAR(std::sqrt(noise_variance(learner.models()[2])) * kDegPerRad, 0.432, 0.015);
}

// What a sensor with a DLPF of 20, 10, 5 Hz would say (docs/noise.md has the figures).
TEST(RestOfRecordings, AStillSensorIsFoundAtRestBehindALowPass) {
  for (const double low_pass_hz : {20.0, 10.0, 5.0}) {
    StandstillLearner learner(100.0);
    const auto share = share_at_rest("adis16405_imu1_static_100hz.csv.gz", learner, low_pass_hz);
    if (!share) GTEST_SKIP() << "no recordings in " << test::data_folder();
    EXPECT_GT(*share, 0.95) << low_pass_hz;
  }
}

TEST(RestOfRecordings, ACarIsNotAtRestWhileItsEngineRuns) {
  for (const auto& [name, rate] : {std::pair("drive0708_lsm6_100hz.csv.gz", 100.0),
                                   std::pair("wid_car_trial06_xsensdot_120hz.csv.gz", 120.0),
                                   std::pair("wid_car_trial09_xsensdot_120hz.csv.gz", 120.0)}) {
    for (const std::optional<double> low_pass_hz : {std::optional<double>{}, {20.0}, {10.0}, {5.0}}) {
      StandstillLearner learner(rate);
      const auto share = share_at_rest(name, learner, low_pass_hz);
      if (!share) GTEST_SKIP() << "no recordings in " << test::data_folder();
      EXPECT_EQ(*share, 0.0) << name << low_pass_hz.value_or(0.0);
      EXPECT_EQ(learner.revision(), 0U) << name << low_pass_hz.value_or(0.0);
    }
  }
}

// Under the noise of a loud sensor the end of WID trial 06 passes for rest, with an engine's line at 22.5 Hz in it, 0.46 and 0.30 deg/s on x and y.
TEST(RestOfRecordings, ACarsEngineIsNotLearnedAsTheSensorsLine) {
  for (const double scale : {2.0, 3.0}) {
    if (!test::has_drive_rows()) GTEST_SKIP() << "no recordings in " << test::data_folder();
    StandstillLearner learner(120.0);
    const auto axes = trial06_in_noise(scale);
    for (std::size_t n = 0; n < axes[0].size(); ++n) learner.step({axes[0][n], axes[1][n], axes[2][n]});
    EXPECT_GT(learner.rest_seconds(), 10.0) << scale;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      ASSERT_TRUE(is_usable(learner.models()[axis])) << scale;
      EXPECT_EQ(learner.models()[axis].line_count, 0U) << scale;
    }
    EXPECT_EQ(learner.models()[2].line_count, 1U) << "z has a line of its own";
  }
}

/// Lines of the axes' own that are known in the end.
std::array<std::size_t, 3> own_lines(const std::array<std::vector<double>, 3>& axes, double rate_hz) {
  HiddenNoiseLearner learner(rate_hz);
  for (std::size_t n = 0; n < axes[0].size(); ++n) learner.step({axes[0][n], axes[1][n], axes[2][n]});
  std::array<std::size_t, 3> count{};
  for (std::size_t axis = 0; axis < 3; ++axis) count[axis] = learner.models()[axis].line_count;
  return count;
}

// Of a z axis of an ADIS16405, at 20 Hz of 100, in a car, and in nothing that moves without one.
TEST(LinesOfRecordings, ASensorsIsFoundWhileItMoves) {
  if (!test::has_drive_rows()) GTEST_SKIP() << "no recordings in " << test::data_folder();
  for (const double scale : {0.3, 1.0}) {
    EXPECT_EQ(own_lines(trial06_in_noise(scale), 120.0), (std::array<std::size_t, 3>{0, 0, 1})) << scale;
  }
}

TEST(LinesOfRecordings, WhatMovesHasNone) {
  if (!test::has_hand_rows() || !test::has_shaking_rows())
    GTEST_SKIP() << "no recordings in " << test::data_folder();
  EXPECT_EQ(own_lines(test::detail::load(test::shaking_file(), 100.0).gyro_radps, 100.0),
            (std::array<std::size_t, 3>{}));
  for (const test::Motion& motion : test::hand_motions()) {
    EXPECT_EQ(own_lines(test::detail::load(motion.file, motion.rate_hz).gyro_radps, motion.rate_hz),
              (std::array<std::size_t, 3>{}))
        << motion.name;
  }
}

}  // namespace
}  // namespace gyrod::core
