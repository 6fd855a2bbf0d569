/// The two-speed estimator on real drives in real noise, against what must hold of it (docs/measured.md, "The drives"). Skipped where
/// GYROD_DATA is absent.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "support/joint_drive.hpp"

namespace gyrod::core {
namespace {

test::NoiseChoice noise_of(int imu, char axis, std::size_t start) {
  test::NoiseChoice noise;
  noise.file = "adis16405_imu" + std::to_string(imu) + "_static_100hz.csv.gz";
  noise.axis = static_cast<std::size_t>(axis - 'x');
  noise.start = start;
  return noise;
}

NoiseModel calibrated(const test::DriveRow& row) {
  return scaled(still_noise(row.still_dps).value(), kNoiseMargin);
}

class Scored {
 public:
  explicit Scored(const test::NoiseChoice& noise) : rows(test::drive_rows(noise)), figures_(rows.size()) {}

  /// With calibrated noise.
  const test::JointFigures& figures(std::size_t row) {
    if (!figures_[row]) figures_[row] = test::joint_figures(rows[row], calibrated(rows[row]), {});
    return *figures_[row];
  }

  std::vector<test::DriveRow> rows;

 private:
  std::vector<std::optional<test::JointFigures>> figures_;
};

/// Rows are read, and scored, once.
Scored& scored(const test::NoiseChoice& noise) {
  static std::map<std::tuple<std::string, std::size_t, std::size_t>, Scored> known;
  return known.try_emplace({noise.file, noise.axis, noise.start}, noise).first->second;
}

/// A level that is wrong, and no colour; or nothing at all.
NoiseModel believed_white(const test::DriveRow& row, double level) {
  if (level < 0.0) return {};
  return scaled(white_noise(noise_variance(still_noise(row.still_dps).value())), level);
}

constexpr double kNothing = -1.0;

struct Setting {
  const char* name;
  test::NoiseChoice noise;
  /// RMSE of every cell, in parts of the tuned Butterworth's. 1: ahead. Above 1: what the design allows, or what docs/measured.md says
  /// is not reached, rounded up to a whole per cent.
  double most = 1.0;
  /// 0: calibrated; kNothing: nothing is believed; else believed white, at this part of its level
  double white_level = 0.0;
  double rate_hz = 120.0;
  std::size_t window = 1024;
  std::string axes = "xyz";

  /// From what scored() has.
  [[nodiscard]] bool differs() const { return white_level != 0.0 || rate_hz != 120.0 || window != 1024; }
};

std::ostream& operator<<(std::ostream& out, const Setting& setting) { return out << setting.name; }

class JointDrives : public testing::TestWithParam<Setting> {};

TEST_P(JointDrives, AreAheadOfTheButterworthTunedOnTheirTruth) {
  const Setting& setting = GetParam();
  if (!test::has_drive_rows(setting.noise)) GTEST_SKIP() << "no recordings in " << test::data_folder();
  test::JointSetting on;
  on.window = setting.window;
  Scored& known = scored(setting.noise);
  for (std::size_t k = 0; k < known.rows.size(); ++k) {
    test::DriveRow row = known.rows[k];
    if (setting.axes.find("xyz"[row.axis]) == std::string::npos) continue;
    test::ByLag ours{};
    if (!setting.differs()) {
      ours = known.figures(k).rmse;
    } else {
      const NoiseModel noise =
          setting.white_level != 0.0 ? believed_white(row, setting.white_level) : calibrated(row);
      test::resample(row, setting.rate_hz);
      ours = test::joint_figures(row, noise, on).rmse;
    }
    const test::ByLag best = test::best_butterworth(row, on);
    for (std::size_t i = 0; i < ours.size(); ++i)
      EXPECT_LT(ours[i], setting.most * best[i]) << row.name << ", lag " << test::kJointLags[i];
  }
}

// Where z alone is judged, x and y are ahead by more (docs/measured.md). Not ahead: 09 z at 400 Hz, and the z axes under noise of imu2 y that is believed white
// and too weak, for which the design allows 10 %.
INSTANTIATE_TEST_SUITE_P(
    Settings, JointDrives,
    testing::Values(Setting{"imu1_x", noise_of(1, 'x', 0)},
                    Setting{"imu1_x_from_500000_on_z", noise_of(1, 'x', 500'000), 1.0, 0.0, 120.0, 1024, "z"},
                    Setting{"imu2_y", noise_of(2, 'y', 0)},
                    Setting{"imu2_y_from_200000", noise_of(2, 'y', 200'000)},
                    Setting{"imu4_x", noise_of(4, 'x', 0)}, Setting{"imu4_z", noise_of(4, 'z', 0)},
                    Setting{"imu4_z_from_200000_on_z", noise_of(4, 'z', 200'000), 1.0, 0.0, 120.0, 1024, "z"},
                    Setting{"imu1_z", noise_of(1, 'z', 0)}, Setting{"imu2_z", noise_of(2, 'z', 0)},
                    Setting{"level_20_percent_low", noise_of(1, 'x', 0), 1.0, 0.8},
                    Setting{"level_20_percent_high_on_z", noise_of(1, 'x', 0), 1.0, 1.2, 120.0, 1024, "z"},
                    Setting{"level_20_percent_low_of_imu4_x", noise_of(4, 'x', 0), 1.0, 0.8},
                    Setting{"level_20_percent_low_of_imu2_y", noise_of(2, 'y', 200'000), 1.02, 0.8, 120.0,
                            1024, "z"},
                    Setting{"nothing_known", noise_of(1, 'x', 0), 1.0, kNothing},
                    Setting{"nothing_known_of_imu4_x", noise_of(4, 'x', 0), 1.0, kNothing, 120.0, 1024, "z"},
                    Setting{"at_50_Hz", noise_of(1, 'x', 0), 1.0, 0.0, 50.0},
                    Setting{"at_200_Hz_on_z", noise_of(1, 'x', 0), 1.0, 0.0, 200.0, 1024, "z"},
                    Setting{"at_400_Hz_on_z", noise_of(1, 'x', 0), 1.01, 0.0, 400.0, 2048, "z"},
                    Setting{"window_512_on_z", noise_of(1, 'x', 0), 1.0, 0.0, 120.0, 512, "z"},
                    Setting{"window_2048_on_z", noise_of(1, 'x', 0), 1.0, 0.0, 120.0, 2048, "z"}),
    [](const auto& info) { return std::string(info.param.name); });

/// Worst cell of these rows, in parts of the tuned Butterworth's RMSE. @param name part of the row's name
double worst_of(const std::vector<test::DriveRow>& rows, const std::string& name,
                const test::JointSetting& setting = {}) {
  double worst = 0.0;
  for (const test::DriveRow& row : rows) {
    if (row.name.find(name) == std::string::npos) continue;
    const test::ByLag ours = test::joint_figures(row, calibrated(row), setting).rmse;
    const test::ByLag best = test::best_butterworth(row, setting);
    for (std::size_t i = 0; i < ours.size(); ++i) worst = std::max(worst, ours[i] / best[i]);
  }
  return worst;
}

// Moved by hand under three times the noise; the closest is y of room1, lag 4 (0.992 when this was written).
TEST(JointDrivesByHand, AreAheadOfTheButterworthTunedOnTheirTruth) {
  if (!test::has_hand_rows()) GTEST_SKIP() << "no recordings in " << test::data_folder();
  EXPECT_LT(worst_of(test::hand_rows(), "room1 y"), 1.0);
}

// A limit within the road's modes: taken whole, by their centres, they left up to 1.7 times the Butterworth's error with a limit of 5 Hz.
TEST(JointDrivesInABand, AreAheadOfTheButterworthTunedOnTheTruthWithinIt) {
  if (!test::has_drive_rows()) GTEST_SKIP() << "no recordings in " << test::data_folder();
  test::JointSetting setting;
  setting.max_signal_hz = 5.0;
  auto rows = test::drive_rows();
  for (test::DriveRow& row : rows) test::limit(row, setting.max_signal_hz);
  EXPECT_NEAR(worst_of(rows, "09", setting), 0.9, 0.1);
}

// A sine in the noise that is in its calibration, too, at 24 and 42 Hz: on z it cost up to twice the Butterworth's error when an AR(8) was all that was known of
// it. The worst cell was 0.984.
TEST(JointDrivesLine, AreAheadOfTheButterworthWhereASineIsKnown) {
  if (!test::has_drive_rows()) GTEST_SKIP() << "no recordings in " << test::data_folder();
  for (const double cycles : {0.2, 0.35}) {
    std::vector<test::DriveRow> rows = test::drive_rows();
    for (test::DriveRow& row : rows) test::add_sine(row, 0.5, cycles);
    EXPECT_LT(worst_of(rows, " z"), 1.0) << cycles;
  }
}

// The z axis of an MPU6050 has a line of a quarter of its power at 31 Hz, and so little noise that a road hides it: 0.998 is the worst cell.
TEST(JointDrivesLine, AreAheadOfTheButterworthInAQuietSensorsNoise) {
  const test::NoiseChoice noise = test::mpu6050_noise(2, 0);
  if (!test::has_drive_rows(noise)) GTEST_SKIP() << "no recordings in " << test::data_folder();
  EXPECT_LT(worst_of(test::drive_rows(noise), " y"), 1.0);
}

// Six drives of gyrod simulate: 0.79 is the worst cell of 108 (noise x 1).
TEST(JointDrivesSimulated, AreAheadOfTheButterworthTunedOnTheirTruth) {
  if (!test::has_drive_rows()) GTEST_SKIP() << "no recordings in " << test::data_folder();
  std::vector<test::DriveRow> rows = test::simulated_rows();
  std::erase_if(rows, [](const test::DriveRow& row) { return row.name.find(" at ") != std::string::npos; });
  ASSERT_EQ(rows.size(), 18U);
  EXPECT_LT(worst_of(rows, "sim"), 0.81);
}

// All of a roof shakes by more than the noise, for a moment alike in half of the bands: then noise of 0.37 deg/s was believed 9 times as strong, and the error
// was 1.5 times raw's until the end.
TEST(JointDrivesShaking, AreNoWorseThanTheButterworthTunedOnTheirTruth) {
  if (!test::has_shaking_rows()) GTEST_SKIP() << "no recordings in " << test::data_folder();
  EXPECT_LT(worst_of(test::shaking_rows(), "shaking"), 1.0);
}

// For half a minute six of eight bands are alike to a quarter, at ten times a weak noise: it was believed, and the error was twice raw's. The worst cell is 0.972.
TEST(JointDrivesShaking, AreNoWorseWhereBandsAreAlikeForHalfAMinute) {
  const test::NoiseChoice noise = noise_of(1, 'y', 0);
  if (!test::has_shaking_rows(noise)) GTEST_SKIP() << "no recordings in " << test::data_folder();
  EXPECT_LT(worst_of(test::shaking_rows(noise, 359.11), "z at 0.3"), 1.0);
}

// Smooth motion far above the noise ends at a frequency that a tuned filter knows: 1.20 with 32 samples of look-ahead.
TEST(JointDrivesSmooth, AreNotFarBehindTheButterworthTunedOnTheirTruth) {
  if (!test::has_drive_rows()) GTEST_SKIP() << "no recordings in " << test::data_folder();
  EXPECT_LT(worst_of(test::smooth_rows(), "smooth"), 1.22);
}

// A calibration of another sensor, or in another unit: the deviation is a tenth, or four times, of what it is. The worst cell was 1.003 and 0.983.
TEST(JointDrivesBelieved, MayBeWrongByAFactor) {
  if (!test::has_drive_rows()) GTEST_SKIP() << "no recordings in " << test::data_folder();
  for (const test::DriveRow& row : scored({}).rows) {
    if (row.axis == 0) continue;
    const test::ByLag best = test::best_butterworth(row, {});
    for (const double level : {0.1, 0.7, 4.0}) {
      for (const NoiseModel& noise : {scaled(calibrated(row), level), believed_white(row, level)}) {
        const test::ByLag ours = test::joint_figures(row, noise, {}).rmse;
        for (std::size_t i = 0; i < ours.size(); ++i)
          EXPECT_LT(ours[i], 1.01 * best[i]) << row.name << ", lag " << test::kJointLags[i] << ", " << level;
      }
    }
  }
}

/// Four seconds at 120 Hz.
std::vector<double> stretch(const std::vector<double>& all, std::size_t begin) {
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(begin);
  return {first, first + 480};
}

// From the drive's first sample to the first model's, and from samples in the middle of it. Raw has 1; what answered before had up to 3.9 at 50 Hz, on axes that shake.
TEST(JointDrivesBegin, WithAnswersThatAreHardlyWorseThanRawOnes) {
  if (!test::has_drive_rows()) GTEST_SKIP() << "no recordings in " << test::data_folder();
  for (const double rate : {50.0, 120.0}) {
    for (const std::size_t begin : {0U, 2556U, 4044U, 5652U, 7428U}) {
      for (test::DriveRow row : scored({}).rows) {
        row.truth_dps = stretch(row.truth_dps, begin);
        row.noisy_dps = stretch(row.noisy_dps, begin);
        test::resample(row, rate);
        test::JointSetting setting;
        setting.from_s = 0.0;
        setting.to_s = 96.0 / rate;
        const auto figures = test::joint_figures(row, calibrated(row), setting);
        const double raw = 0.347 * row.noise_scale;
        EXPECT_LT(figures.rmse[0], 1.4 * raw) << row.name << " at " << rate << " Hz from sample " << begin;
        EXPECT_LT(figures.rmse[4], 1.4 * raw) << row.name << " at " << rate << " Hz from sample " << begin;
      }
    }
  }
}

// The design's table, the rows of which were its un-tuned prototype's: no cell more than 3 % behind, and ahead in the mean.
TEST(JointDrivesPrototype, IsReachedInEveryCell) {
  if (!test::has_drive_rows()) GTEST_SKIP() << "no recordings in " << test::data_folder();
  Scored& known = scored({});
  double sum = 0.0;
  for (std::size_t k = 0; k < known.rows.size(); ++k) {
    const test::PrototypeRow* prototype = test::prototype_of(known.rows[k]);
    ASSERT_NE(prototype, nullptr) << known.rows[k].name;
    for (std::size_t i = 0; i < prototype->rmse.size(); ++i) {
      const std::size_t at = test::PrototypeRow::kLagIndex[i];
      const double ratio = known.figures(k).rmse[at] / prototype->rmse[i];
      EXPECT_LT(ratio, 1.03) << prototype->row << ", lag " << test::kJointLags[at];
      sum += std::log(ratio);
    }
  }
  EXPECT_LT(sum, 0.0);
}

// A minute at rest is nearly as good as a calibration (the design's limit: 3 %), also of noise of z axes, which has a line that has moved by then.
TEST(JointDrivesLearned, AreWithinTwoPercentOfCalibrated) {
  for (const auto& noise :
       {noise_of(1, 'x', 0), noise_of(4, 'x', 0), noise_of(2, 'z', 0), noise_of(4, 'z', 0)}) {
    if (!test::has_drive_rows(noise)) GTEST_SKIP() << "no recordings in " << test::data_folder();
    Scored& known = scored(noise);
    for (std::size_t k = 0; k < known.rows.size(); ++k) {
      const test::DriveRow& row = known.rows[k];
      const NoiseModel learned = scaled(test::learned_at_rest(row), kNoiseMargin);
      const test::ByLag ours = test::joint_figures(row, learned, {}).rmse;
      for (std::size_t i = 0; i < ours.size(); ++i)
        EXPECT_LT(ours[i], 1.02 * known.figures(k).rmse[i])
            << noise.file << ", " << row.name << ", lag " << test::kJointLags[i];
    }
  }
}

// The published variance is that of the error: right in the mean of rows, within a factor of 2 on each (0.63 to 1.58 when this was written).
TEST(JointDrivesVariance, IsThatOfTheError) {
  if (!test::has_drive_rows()) GTEST_SKIP() << "no recordings in " << test::data_folder();
  Scored& known = scored({});
  double sum = 0.0;
  for (std::size_t k = 0; k < known.rows.size(); ++k) {
    const double ratio = known.figures(k).normalised_error;
    EXPECT_GT(ratio, 0.5) << known.rows[k].name;
    EXPECT_LT(ratio, 2.0) << known.rows[k].name;
    sum += std::log(ratio);
  }
  EXPECT_NEAR(std::exp(sum / static_cast<double>(known.rows.size())), 1.0, 0.1);
}

}  // namespace
}  // namespace gyrod::core
