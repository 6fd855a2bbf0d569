/// gyrod calibrate as a user runs it: the table, the file, and what it says of recordings that move.
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/exit_code.hpp"
#include "rig.hpp"

namespace gyrod::testing {
namespace {

using app::ExitCode;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

class CalibrateCommand : public Rig {
 protected:
  /// At 100 Hz: still for so long, then a drive of as long; white noise of 0.2 deg/s throughout.
  std::string recording(int still_s, int drive_s) {
    std::mt19937_64 bits(11);
    std::normal_distribution<double> normal(0.0, 0.2);
    std::ostringstream text;
    text << "timestamp_s,gyro_x_dps,gyro_y_dps,gyro_z_dps\n";
    for (int n = 0; n < 100 * (still_s + drive_s); ++n) {
      const double t = 0.01 * n;
      const double yaw = t < still_s ? 0.0 : 8.0 * std::sin(0.7 * (t - still_s));
      text << t << ',' << 0.5 + normal(bits) << ',' << normal(bits) << ',' << yaw + normal(bits) << '\n';
    }
    write_file("in.csv", text.str());
    return path("in.csv");
  }
  Result calibrate(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "calibrate");
    return run(arguments);
  }
};

TEST_F(CalibrateCommand, FindsTheStillPartAndItsNoise) {
  const Result result = calibrate({recording(60, 60), "-o", path("cal.json"), "--sensor", "front"});
  ASSERT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("in.csv: 60.0 s of 120.0 s at rest, 100 Hz"),
                                HasSubstr("still from 0.0 s to 60.0 s"), HasSubstr("deg/s/sqrt(Hz)"),
                                HasSubstr("for sensor front")));
  const Json document = Json::parse(read_file("cal.json"));
  EXPECT_EQ(document.at("sensor_id"), "front");
  EXPECT_EQ(document.at("origin").at("source"), "in.csv");
  EXPECT_NEAR(document.at("origin").at("still_s").get<double>(), 60.0, 1e-6);
  for (const char* axis : {"x", "y", "z"}) {
    // 0.2 to four standard errors of 0.93 %.
    EXPECT_NEAR(document.at("figures").at(axis).at("std_dps").get<double>(), 0.2, 0.2 * 0.037) << axis;
  }
  EXPECT_NEAR(document.at("axes").at("x").at("bias_radps").get<double>() * 180.0 / std::numbers::pi, 0.5,
              0.011);
}

/// Two minutes at rest with the engine on: 0.12 and 0.08 deg/s at 22.5 Hz on x and y, a quarter turn apart, in white noise of 0.2 deg/s.
std::string idling() {
  std::mt19937_64 bits(12);
  std::normal_distribution<double> normal(0.0, 0.2);
  std::ostringstream text;
  text << "timestamp_s,gyro_x_dps,gyro_y_dps,gyro_z_dps\n";
  for (int n = 0; n < 12'000; ++n) {
    const double t = 0.01 * n;
    const double turn = 2.0 * std::numbers::pi * 22.5 * t;
    text << t << ',' << 0.12 * std::sin(turn) + normal(bits) << ',' << 0.08 * std::cos(turn) + normal(bits)
         << ',' << normal(bits) << '\n';
  }
  return text.str();
}

TEST_F(CalibrateCommand, LeavesOutWhatAnEngineShakes) {
  write_file("idle.csv", idling());
  const Result result = calibrate({path("idle.csv"), "-o", path("cal.json")});
  ASSERT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  // 0.12 and 0.08 over the square root of two.
  EXPECT_THAT(result.out, HasSubstr("axes share a line at 22.5 Hz (x 0.08"));
  EXPECT_THAT(result.out, HasSubstr("deg/s, y 0.05"));
  EXPECT_THAT(result.out, HasSubstr("an engine or a fan, left out of the noise; --all-still takes it"));
  const Json document = Json::parse(read_file("cal.json"));
  EXPECT_FALSE(document.at("axes").at("x").contains("lines"));
  EXPECT_NEAR(document.at("figures").at("x").at("std_dps").get<double>(), 0.2, 0.2 * 0.027);
}

// A supply's line may be on all axes, too.
TEST_F(CalibrateCommand, TakesALineOfAllAxesOnTheUsersWord) {
  write_file("idle.csv", idling());
  const Result result = calibrate({path("idle.csv"), "-o", path("cal.json"), "--all-still"});
  ASSERT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  EXPECT_THAT(result.out, Not(HasSubstr("axes share")));
  EXPECT_THAT(result.out, HasSubstr("x has a narrow line at 22.5 Hz"));
}

TEST_F(CalibrateCommand, RefusesARecordingThatMovesAndSaysHowMuch) {
  const Result result = calibrate({recording(5, 60), "-o", path("cal.json")});
  EXPECT_EQ(result.exit_code, ExitCode::kFileTrouble);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("0.0 s of 65.0 s are at rest; of the rest"),
                    HasSubstr("expected 30 s at least"), HasSubstr("--all-still takes all of it as still")));
  EXPECT_FALSE(std::filesystem::exists(path("cal.json")));
}

TEST_F(CalibrateCommand, TakesThePartThatIsNamedOnTheUsersWord) {
  const Result result =
      calibrate({recording(5, 60), "-o", path("cal.json"), "--from", "20", "--to", "60", "--all-still"});
  ASSERT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  EXPECT_THAT(result.out, HasSubstr("40.0 s of 40.0 s at rest"));
}

TEST_F(CalibrateCommand, TakesTheFiguresOfADataSheet) {
  const Result result = calibrate({"--noise-density", "0.05", "--rate", "100", "-o", path("cal.json")});
  ASSERT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  // 0.05 sqrt(100 / 2) = 0.3536 and 60 * 0.05 / sqrt(2) = 2.121.
  EXPECT_THAT(result.out, AllOf(HasSubstr("0.3536"), HasSubstr("0.05000"), HasSubstr("2.121"),
                                HasSubstr("for all sensors")));
  const Result three = calibrate({"--arw", "1,2,3", "--rate", "100", "-o", "-"});
  ASSERT_EQ(three.exit_code, ExitCode::kDone) << three.err;
  EXPECT_NEAR(Json::parse(three.out).at("figures").at("z").at("arw_deg_per_sqrt_h").get<double>(), 3.0, 1e-9);
}

// 0.005 sqrt(200 / 2) = 0.05 deg/s without the filter, of which sqrt(0.42 pi / sqrt(8)) = 0.683 is left.
TEST_F(CalibrateCommand, TakesTheLowPassOfADataSheet) {
  const Result result = calibrate(
      {"--noise-density", "0.005", "--bandwidth", "42", "--rate", "200", "--sensor", "mpu", "-o", "-"});
  ASSERT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  const Json made = Json::parse(result.out);
  EXPECT_NEAR(made.at("figures").at("z").at("std_dps").get<double>(), 0.0342, 0.0007);
  EXPECT_THAT(result.out, HasSubstr("bandwidth 42 Hz"));
  const Result alone = calibrate({recording(60, 0), "--bandwidth", "42", "-o", "-"});
  EXPECT_EQ(alone.exit_code, ExitCode::kWrongUsage);
  EXPECT_THAT(alone.err, HasSubstr("--bandwidth is for --noise-density or --arw"));
}

TEST_F(CalibrateCommand, WritesOverNoRecording) {
  const std::string input = recording(60, 0);
  const std::string before = read_file("in.csv");
  std::filesystem::create_symlink(input, path("link.csv"));
  for (const std::string& output : {input, path("link.csv"), path("./in.csv")}) {
    const Result result = calibrate({input, "-o", output});
    EXPECT_EQ(result.exit_code, ExitCode::kWrongUsage) << output;
    EXPECT_THAT(result.err, HasSubstr("--output: is the same file as the input, " + input));
    EXPECT_EQ(run({"denoise", input, "-o", output}).exit_code, ExitCode::kWrongUsage);
  }
  EXPECT_EQ(read_file("in.csv"), before);
}

TEST_F(CalibrateCommand, SaysWhatItLeavesOut) {
  recording(60, 0);
  const std::string text = read_file("in.csv");
  std::istringstream rows(text);
  std::string row;
  std::getline(rows, row);
  std::ostringstream with_holes;
  with_holes << row << ",accel_x_mps2,accel_y_mps2,accel_z_mps2\n";
  for (int n = 0; std::getline(rows, row); ++n) {
    // Three are missing one by one; the accelerometer fails for half a second.
    if (n == 1000 || n == 2000 || n == 3000) continue;
    with_holes << row << (n / 50 == 20 ? ",nan,0,9.81\n" : ",0,0,9.81\n");
  }
  write_file("holes.csv", with_holes.str());
  const Result result = calibrate({path("holes.csv"), "-o", path("cal.json")});
  ASSERT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  EXPECT_THAT(result.err, AllOf(HasSubstr("3 samples of short gaps bridged by a straight line"),
                                HasSubstr("rest is judged without the accelerometer: "),
                                HasSubstr("accel_x_mps2 has no number for more than 16 samples in a row")));
  EXPECT_THAT(result.out, HasSubstr("60.0 s of 60.0 s at rest"));
}

// What a name ending in .gz is written as, it is read as.
TEST_F(CalibrateCommand, WritesACompressedCalibrationThatCanBeRead) {
  const std::string input = recording(60, 0);
  ASSERT_EQ(calibrate({input, "-o", path("cal.json.gz")}).exit_code, ExitCode::kDone);
  const Result result = run({"denoise", input, "-o", path("out.csv"), "--noise", path("cal.json.gz")});
  EXPECT_EQ(result.exit_code, ExitCode::kDone) << result.err;
}

TEST_F(CalibrateCommand, SaysWhatIsWrongWithTheCommandLine) {
  const auto complaint = [this](const std::vector<std::string>& arguments) {
    const Result result = calibrate(arguments);
    EXPECT_EQ(result.exit_code, ExitCode::kWrongUsage);
    return result.err;
  };
  EXPECT_THAT(complaint({"-o", "x"}), HasSubstr("expected either a recording or --noise-density or --arw"));
  EXPECT_THAT(complaint({"--arw", "2", "-o", "x"}), HasSubstr("--rate is missing"));
  EXPECT_THAT(complaint({"--arw", "2,2", "--rate", "100", "-o", "x"}), HasSubstr("2 values given"));
  EXPECT_THAT(complaint({"--arw", "2", "--noise-density", "1", "--rate", "100", "-o", "x"}),
              HasSubstr("expected one of them"));
  EXPECT_THAT(complaint({"in.csv", "--from", "100", "--to", "50", "-o", "x"}),
              HasSubstr("--from: 100 is not before --to 50"));
  EXPECT_THAT(complaint({"--noise-density", "-1", "--rate", "100", "-o", "x"}),
              HasSubstr("expected a number from"));
}

TEST_F(CalibrateCommand, WritesWhatTheConfigurationTakes) {
  ASSERT_EQ(calibrate({"--arw", "2", "--rate", "100", "-o", path("cal.json")}).exit_code, ExitCode::kDone);
  write_file("gyrod.json", R"({"noise": {"source": "calibrated", "calibrations": "cal.json"}})");
  const Result result = run({"validate", "--config", path("gyrod.json")});
  EXPECT_EQ(result.exit_code, ExitCode::kDone) << result.err;
}

}  // namespace
}  // namespace gyrod::testing
