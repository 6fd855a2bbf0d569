// What an evaluation is made from: what is left out of two files, and what is said of it.
#include "app/evaluation_rows.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/noise/noise_model.hpp"
#include "support/scratch_folder.hpp"
#include "support/signals.hpp"

namespace gyrod {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

/// Row n as text; empty: there is none.
using Row = std::function<std::string(int)>;

class EvaluationRowsTest : public ::testing::Test {
 protected:
  static constexpr int kSamples = 3000;

  /// 100 Hz about z, with a truth, in deg/s.
  static std::string signal_row(int n) { return std::to_string(0.01 * n) + ",1.5,1.25\n"; }
  /// The rates of a sensor at rest.
  [[nodiscard]] std::string noise_row(int n) const {
    return std::to_string(0.01 * n) + "," + std::to_string(noise_[static_cast<std::size_t>(n)]) + "\n";
  }

  void write_signal(const Row& row = signal_row, int samples = kSamples) const {
    write("in.csv", "timestamp_s,gyro_z_dps,truth_z_dps\n", row, samples);
  }
  void write_noise(const Row& row) const { write("still.csv", "timestamp_s,gyro_z_dps\n", row, kSamples); }
  void write_noise() const {
    write_noise([this](int n) { return noise_row(n); });
  }

  [[nodiscard]] app::EvaluationInput input() const {
    app::EvaluationInput input;
    input.recording = folder_.path("in.csv");
    input.axes = {"z"};
    return input;
  }
  [[nodiscard]] app::EvaluationInput composite() const {
    app::EvaluationInput both = input();
    both.noise = folder_.path("still.csv");
    return both;
  }

  ScratchFolder folder_;

  void write(const std::string& name, std::string text, const Row& row, int samples) const {
    for (int n = 0; n < samples; ++n) text += row(n);
    folder_.write(name, text);
  }

 private:
  Signal noise_ = white_noise(kSamples, 5);
};

TEST_F(EvaluationRowsTest, HaveNothingToSayOfGoodFiles) {
  write_signal();
  write_noise();
  EXPECT_THAT(app::evaluation_rows(input()).cautions, IsEmpty());
  EXPECT_THAT(app::evaluation_rows(composite()).cautions, IsEmpty());
}

TEST_F(EvaluationRowsTest, TellWhatIsLostInEitherFile) {
  const auto spoiled = [](int n, const std::string& row) {
    if (n == 100 || n == 200) return std::string("nonsense\n");
    return n == 300 ? "3," + std::string(row.find("1.25") == std::string::npos ? "nan\n" : "nan,1\n") : row;
  };
  write_signal([&](int n) { return spoiled(n, signal_row(n)); });
  write_noise([&](int n) { return spoiled(n, noise_row(n)); });
  app::EvaluationInput given = composite();
  given.skip_broken_rows = true;
  const auto cautions = app::evaluation_rows(given).cautions;
  for (const char* name : {"in.csv", "still.csv"}) {
    EXPECT_THAT(cautions, Contains(AllOf(HasSubstr(name), HasSubstr("2 rows cannot be read and are left out"),
                                         HasSubstr("1 sample is refused"),
                                         HasSubstr("3 samples are bridged by straight lines"))));
  }
}

TEST_F(EvaluationRowsTest, TellOfALongGapInEitherFile) {
  const auto torn = [](int n, const std::string& row) { return n >= 2000 && n < 2100 ? "" : row; };
  write_signal([&](int n) { return torn(n, signal_row(n)); });
  write_noise([&](int n) { return torn(n, noise_row(n)); });
  const auto cautions = app::evaluation_rows(composite()).cautions;
  EXPECT_THAT(cautions,
              Contains(AllOf(HasSubstr("in.csv"), HasSubstr("1 long gap; the longest stretch is judged"),
                             HasSubstr("900 good samples are left out"))));
  EXPECT_THAT(cautions,
              Contains(AllOf(HasSubstr("still.csv"), HasSubstr("1 long gap; the longest stretch is used"))));
}

TEST_F(EvaluationRowsTest, TellThatTheRateOfTheNoiseIsAssumed) {
  write_signal();
  std::string text = "gyro_z_dps\n";
  for (int n = 0; n < kSamples; ++n) text += noise_row(n).substr(noise_row(n).find(',') + 1);
  folder_.write("still.csv", text);
  EXPECT_THAT(app::evaluation_rows(composite()).cautions,
              Contains(AllOf(HasSubstr("still.csv"), HasSubstr("assumed to be the signal's, 100.0 Hz"))));
  app::EvaluationInput given = composite();
  given.rate_hz = 100.0;
  EXPECT_THAT(app::evaluation_rows(given).cautions, IsEmpty());
}

TEST_F(EvaluationRowsTest, RefuseWhatTheLimitsRefuse) {
  write_signal([](int n) { return n == 50 ? "0.5,60,1\n" : signal_row(n); });
  app::EvaluationInput given = input();
  EXPECT_THAT(app::evaluation_rows(given).cautions, IsEmpty());
  given.max_rate_radps = 1.0;  // 57 deg/s
  EXPECT_THAT(app::evaluation_rows(given).cautions, Contains(HasSubstr("1 sample is refused")));
  given.max_bridged_samples = 0;
  EXPECT_THAT(app::evaluation_rows(given).cautions, Contains(HasSubstr("1 long gap")));
}

// Of 3000 samples of noise a signal of 800 takes those from 1000 on, in which the noise is ten times as strong.
TEST_F(EvaluationRowsTest, KnowTheNoiseFromBothSidesOfWhatIsAdded) {
  write_signal(signal_row, 800);
  write_noise([this](int n) {
    const double factor = n >= 1000 && n < 1800 ? 10.0 : 1.0;
    return std::to_string(0.01 * n) + "," +
           std::to_string(factor * std::stod(noise_row(n).substr(noise_row(n).find(',') + 1))) + "\n";
  });
  app::EvaluationInput given = composite();
  given.noise_start = 1000;
  given.noise_scales = {1.0, 3.0};
  const app::EvaluationRows all = app::evaluation_rows(given);
  EXPECT_EQ(all.spare_samples, 2200U);
  ASSERT_EQ(all.rows[0].noise.by, app::NoiseKnownBy::kSpareSamples);
  ASSERT_EQ(all.rows[1].noise.by, app::NoiseKnownBy::kSpareSamples);
  const double variance = core::noise_variance(all.rows[0].noise.course.front().model);
  // 2200 samples give a variance to 3 %; the margin of 2 % in level is 4 % in variance.
  EXPECT_NEAR(variance, 1.04, 0.12);
  EXPECT_NEAR(core::noise_variance(all.rows[1].noise.course.front().model), 9.0 * variance, 1e-9);
}

TEST_F(EvaluationRowsTest, KnowTheNoiseFromWhatLiesBetweenWhereItBeginsAgain) {
  write_signal(signal_row, 900);
  write_noise();
  app::EvaluationInput given = composite();
  given.noise_start = 2800;  // to the end, and the first 700
  EXPECT_EQ(app::evaluation_rows(given).spare_samples, 2100U);
  EXPECT_EQ(app::evaluation_rows(given).rows[0].noise.by, app::NoiseKnownBy::kSpareSamples);
  write_signal(signal_row, 1100);  // the first 900: 1900 are left, less than are needed
  EXPECT_EQ(app::evaluation_rows(given).spare_samples, 1900U);
  EXPECT_EQ(app::evaluation_rows(given).rows[0].noise.by, app::NoiseKnownBy::kNothing);
  write_signal();
  EXPECT_EQ(app::evaluation_rows(given).spare_samples, 0U);
}

/// A sensor's three axes, deg/s: motion n of axis i in the signal, noise of each axis of its own.
class EvaluationRowsOfThreeAxes : public EvaluationRowsTest {
 protected:
  EvaluationRowsOfThreeAxes() {
    const std::string header = "timestamp_s,gyro_x_dps,gyro_y_dps,gyro_z_dps\n";
    write(
        "in.csv", header,
        [](int n) {
          return row_of(n, {0.001 * n, 0.002 * n, 0.003 * n});
        },
        kSamples);
    write(
        "still.csv", header, [this](int n) { return row_of(n, noise_at(n)); }, kSamples);
    given_ = composite();
    given_.signal_is_truth = true;
    given_.axes = {"x", "z"};
    given_.known.source = settings::NoiseSource::kImf1;
  }

  static std::string row_of(int n, const std::array<double, 3>& rates) {
    std::string row = std::to_string(0.01 * n);
    for (const double rate : rates) row += "," + std::to_string(rate);
    return row + "\n";
  }
  [[nodiscard]] std::array<double, 3> noise_at(int n) const {
    std::array<double, 3> noise{};
    for (std::size_t axis = 0; axis < 3; ++axis) noise[axis] = axes_[axis][static_cast<std::size_t>(n)];
    return noise;
  }

  app::EvaluationInput given_;

 private:
  std::array<Signal, 3> axes_{white_noise(kSamples, 11), white_noise(kSamples, 12),
                              white_noise(kSamples, 13)};
};

// What is not judged is as loud as it would be: y has its own signal, and three times its own noise.
TEST_F(EvaluationRowsOfThreeAxes, HaveAllThatTheSensorMeasuresWhereNothingIsKnown) {
  given_.noise_scales = {3.0};
  const app::EvaluationRows all = app::evaluation_rows(given_);
  ASSERT_EQ(all.rows.size(), 2U);
  ASSERT_NE(all.rows[0].sensor, nullptr);
  EXPECT_EQ(all.rows[0].sensor, all.rows[1].sensor);
  const app::SensorAxes& sensor = *all.rows[0].sensor;
  EXPECT_EQ(sensor.noisy_dps[0], all.rows[0].noisy_dps);
  EXPECT_EQ(sensor.noisy_dps[2], all.rows[1].noisy_dps);
  double mean = 0.0;
  for (int n = 0; n < kSamples; ++n) mean += noise_at(n)[1] / kSamples;
  for (const int n : {0, 1000, kSamples - 1}) {
    EXPECT_NEAR(sensor.noisy_dps[1][static_cast<std::size_t>(n)], 0.002 * n + 3.0 * (noise_at(n)[1] - mean),
                1e-5);
  }
  EXPECT_FALSE(all.judged_alone);
}

TEST_F(EvaluationRowsOfThreeAxes, HaveWhatIsToldOfAxesThatAreNotJudged) {
  settings::NoiseCalibration level;
  level.sample_rate_hz = 100.0;
  level.models.fill(core::white_noise(1e-4));
  level.models[1] = core::white_noise(4e-4);
  given_.known = {settings::NoiseSource::kCalibrated, "cal.json", level};
  const app::EvaluationRows all = app::evaluation_rows(given_);
  ASSERT_NE(all.rows[0].sensor, nullptr) << "a level alone is not all that there is to know";
  const auto variance = [&](std::size_t axis) {
    return core::noise_variance(app::known_at(all.rows[0].sensor->noise[axis], 1));
  };
  EXPECT_GT(variance(0), 0.0);
  EXPECT_NEAR(variance(1), 4.0 * variance(0), 1e-9);
}

TEST_F(EvaluationRowsOfThreeAxes, NeedNoOtherAxisWhereTheNoiseIsKnown) {
  settings::NoiseCalibration colour;
  colour.sample_rate_hz = 100.0;
  core::NoiseModel model = core::white_noise(1e-4);
  model.colour_variance = 1e-5;
  model.colour_order = 1;
  model.colour[0] = 0.5;
  colour.models.fill(model);
  given_.known = {settings::NoiseSource::kCalibrated, "cal.json", colour};
  for (const app::EvaluationRow& row : app::evaluation_rows(given_).rows) EXPECT_EQ(row.sensor, nullptr);
}

// Noise that axes share would be taken for motion.
TEST_F(EvaluationRowsOfThreeAxes, AreJudgedAloneWhereTheyAreGivenTheSameNoise) {
  given_.noise_axes = {"x", "y", "-y"};
  const app::EvaluationRows all = app::evaluation_rows(given_);
  EXPECT_TRUE(all.judged_alone);
  for (const app::EvaluationRow& row : all.rows) EXPECT_EQ(row.sensor, nullptr);
}

TEST_F(EvaluationRowsTest, DoNotBeginBeyondTheNoise) {
  write_signal();
  write_noise();
  app::EvaluationInput given = composite();
  given.noise_start = 2999;
  EXPECT_EQ(app::evaluation_rows(given).samples, 3000U);
  given.noise_start = 3000;
  EXPECT_THAT(
      [&] { static_cast<void>(app::evaluation_rows(given)); },
      ThrowsMessage<CLI::ValidationError>(AllOf(HasSubstr("--noise-start"), HasSubstr("3000 good samples"))));
}

// 1 Hz and 20 Hz, of which a limit of 5 Hz leaves the former: known but for what the low-pass reaches at the ends, 8 / 0.05 samples, and beside what is
// lost for longer than 5 samples.
TEST_F(EvaluationRowsTest, AskForWhatIsWithinTheSignalBand) {
  const auto slow = [](int n) { return std::sin(2.0 * std::numbers::pi * 0.01 * n); };
  const auto fast = [](int n) { return 0.5 * std::sin(2.0 * std::numbers::pi * 0.2 * n); };
  write_signal([&](int n) {
    const bool lost = n == 700 || (n >= 1500 && n < 1510);
    const std::string truth = lost ? "nan" : std::to_string(slow(n) + fast(n));
    return std::to_string(0.01 * n) + "," + std::to_string(slow(n) + fast(n) + 0.25) + "," + truth + "\n";
  });
  app::EvaluationInput limited = input();
  limited.max_signal_hz = 5.0;
  const app::EvaluationRow row = app::evaluation_rows(limited).rows[0];
  ASSERT_EQ(row.truth_dps.size(), static_cast<std::size_t>(kSamples));
  for (int n = 0; n < kSamples; ++n) {
    const double truth = row.truth_dps[static_cast<std::size_t>(n)];
    const bool known = (n >= 160 && n < 1500 - 160) || (n >= 1510 + 160 && n < kSamples - 160);
    ASSERT_EQ(std::isfinite(truth), known) << n;
    ASSERT_NEAR(known ? truth : slow(n), slow(n), 0.006) << n;
    EXPECT_NEAR(row.noise_dps[static_cast<std::size_t>(n)], 0.0, 1e-5) << "of the whole truth";
  }
}

}  // namespace
}  // namespace gyrod
