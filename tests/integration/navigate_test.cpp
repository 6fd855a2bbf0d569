/// `gyrod navigate`: an exact sensor on an exact motion gives next to no error; what cannot be done is said.
#include <cmath>
#include <iomanip>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/exit_code.hpp"
#include "rig.hpp"
#include "support/exact_motion.hpp"

namespace gyrod::testing {
namespace {

using app::ExitCode;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

/// What a sensor on a boat-like motion writes, with its truth. 100 Hz.
struct Recording {
  Eigen::Vector3d gyro_bias_radps = Eigen::Vector3d::Zero();
  Eigen::Vector3d accel_bias_mps2 = Eigen::Vector3d::Zero();
  double noise_radps = 0.0;  ///< of the gyro, white, from a fixed seed
  bool moving = true;
  bool accelerometer = true;
  bool truth = true;
  std::pair<int, int> lost_rows = {0, 0};
  int samples = 3000;

  [[nodiscard]] ExactMotion motion() const {
    ExactMotion motion;
    motion.start = {48.0 * kDegree, 11.0 * kDegree, 500.0};
    if (!moving) {
      motion.euler_rad = {{{.mean = 0.02}, {.mean = -0.03}, {.mean = 0.0}}};
      return motion;
    }
    motion.velocity_mps = {{{.amplitude = 5.0, .period_s = 20.0}, {.amplitude = 3.0, .period_s = 13.0}, {}}};
    motion.euler_rad = {{{.amplitude = 0.2, .period_s = 7.0},
                         {.amplitude = 0.1, .period_s = 5.0},
                         {.mean = 1.0, .amplitude = 1.0, .period_s = 15.0}}};
    return motion;
  }

  [[nodiscard]] std::string text() const {
    std::string out = "timestamp_s,gyro_x_radps,gyro_y_radps,gyro_z_radps";
    if (accelerometer) out += ",accel_x_mps2,accel_y_mps2,accel_z_mps2";
    if (truth)
      out +=
          ",gt_roll_deg,gt_pitch_deg,gt_heading_deg,gt_lat_deg,gt_lon_deg,gt_h_m,gt_vn_mps,gt_ve_mps,gt_vd_"
          "mps";
    out += "\n";
    ExactWalk walk(motion());
    std::mt19937_64 random(7);
    std::normal_distribution<double> noise(0.0, 1.0);
    for (int n = 0; n < samples; ++n) {
      out += row(n, walk, noise_radps * Eigen::Vector3d(noise(random), noise(random), noise(random)));
      walk.advance(0.01);
    }
    return out;
  }

 private:
  [[nodiscard]] std::string row(int n, const ExactWalk& walk, const Eigen::Vector3d& noise) const {
    const core::InertialSample sample = walk.sample();
    const core::NavigationState state = walk.state();
    std::string out = number(0.01 * n);
    append(out, sample.rate_radps + gyro_bias_radps + noise);
    if (accelerometer) append(out, sample.specific_force_mps2 + accel_bias_mps2);
    const bool lost = n >= lost_rows.first && n < lost_rows.second;
    if (truth && lost) out += ",nan,nan,nan,nan,nan,nan,nan,nan,nan";
    if (truth && !lost) {
      const core::EulerAngles euler = core::euler_of(state.attitude);
      append(out, Eigen::Vector3d(euler.roll_rad, euler.pitch_rad, euler.heading_rad) / kDegree);
      append(out, {state.position.latitude_rad / kDegree, state.position.longitude_rad / kDegree,
                   state.position.height_m});
      append(out, state.velocity_mps);
    }
    return out + "\n";
  }
  static std::string number(double value) {
    std::ostringstream text;
    text << std::setprecision(17) << value;
    return text.str();
  }
  static void append(std::string& out, const Eigen::Vector3d& values) {
    for (const double value : values) out += "," + number(value);
  }
};

class Navigate : public Rig {
 protected:
  Result navigate(const Recording& recording, const std::vector<std::string>& more = {}) {
    write_file("in.csv", recording.text());
    std::vector<std::string> arguments = {"navigate", path("in.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  /// Navigates 10 s stretches without biases. @return the JSON
  json figures(const Recording& recording, std::vector<std::string> more) {
    more.insert(more.end(), {"--duration", "10", "--json", path("out.json")});
    const Result result = navigate(recording, more);
    EXPECT_EQ(result.exit_code, ExitCode::kDone) << result.err;
    return result.exit_code == ExitCode::kDone ? json::parse(read_file("out.json")) : json();
  }
};

// Trapezoids over 10 ms of rates of 0.5 rad/s at 1 rad/s are off by 1e-5 of them: some 1e-4 deg and mm after 10 s.
TEST_F(Navigate, AnExactSensorHasNextToNoError) {
  const json all = figures({}, {"--schemes", "raw", "--bias", "none", "--starts", "3"});
  ASSERT_EQ(all["starts"].size(), 3U);
  ASSERT_EQ(all["runs"].size(), 1U);
  const json& pooled = all["runs"][0]["pooled"];
  EXPECT_EQ(pooled["attitude_deg"]["roll"]["samples"], 3000);
  for (const char* axis : {"roll", "pitch", "heading"})
    EXPECT_LT(pooled["attitude_deg"][axis]["max_abs"], 2e-3);
  for (const char* axis : {"north", "east", "down"}) {
    EXPECT_LT(pooled["velocity_mps"][axis]["max_abs"], 2e-3);
    EXPECT_LT(pooled["position_m"][axis]["max_abs"], 1e-2);
  }
}

TEST_F(Navigate, FindsBiasesFromTheTruth) {
  Recording recording;
  recording.gyro_bias_radps = {0.01, -0.02, 0.03};
  recording.accel_bias_mps2 = {0.1, 0.2, -0.3};
  const json all = figures(recording, {"--schemes", "raw", "--starts", "1"});
  const json& start = all["runs"][0]["starts"][0];
  EXPECT_NEAR(start["gyro_bias_radps"][1], -0.02, 1e-4);
  EXPECT_NEAR(start["accel_bias_mps2"][2], -0.3, 2e-3);
  EXPECT_LT(all["runs"][0]["pooled"]["rotation_deg"]["total"]["max_abs"], 0.01);
}

// A constant bias of 1 mrad/s about z: 10 mrad = 0.573 deg after 10 s, half of that on average. Swinging by 0.2 rad
// turns the axis to and fro, which takes 1 to 2 % off.
TEST_F(Navigate, ABiasThatIsNotTakenOffIsSeen) {
  Recording recording;
  recording.gyro_bias_radps = {0.0, 0.0, 1e-3};
  const json all = figures(recording, {"--schemes", "raw", "--starts", "1", "--bias", "none"});
  const json& total = all["runs"][0]["pooled"]["rotation_deg"]["total"];
  EXPECT_NEAR(total["max_abs"], 0.573, 0.01);
  EXPECT_NEAR(total["mean"], 0.2865, 0.005);
}

TEST_F(Navigate, LostTruthIsSkippedCountedAndShown) {
  Recording recording;
  recording.lost_rows = {800, 1000};
  const std::vector<std::string> more = {"--schemes", "raw", "--start", "5", "--bias", "none"};
  const json all = figures(recording, more);
  EXPECT_EQ(all["starts"][0]["lost_samples"], 200);
  EXPECT_EQ(all["starts"][0]["compared_samples"], 800);
  EXPECT_EQ(all["runs"][0]["pooled"]["position_m"]["north"]["samples"], 800);
  EXPECT_THAT(navigate(recording, {"--schemes", "raw", "--start", "5", "--duration", "10"}).out,
              HasSubstr("200 skipped where it is lost"));
  // A start within the gap moves to its end.
  EXPECT_DOUBLE_EQ(figures(recording, {"--schemes", "raw", "--start", "9"})["starts"][0]["start_s"], 10.0);
}

// At rest, levelled: pitch, roll, biases come from the 10 s before; an exact sensor then stays where it is.
TEST_F(Navigate, AStillSensorStaysWhereItIs) {
  Recording recording;
  recording.moving = recording.truth = false;
  recording.gyro_bias_radps = {0.01, -0.02, 0.03};
  recording.accel_bias_mps2 = {0.0, 0.0, -0.3};
  const json all = figures(
      recording, {"--still", "--schemes", "raw", "--starts", "2", "--latitude", "48", "--height", "500"});
  const json& pooled = all["runs"][0]["pooled"];
  EXPECT_LT(pooled["rotation_deg"]["total"]["max_abs"], 1e-6);
  EXPECT_LT(pooled["position_m"]["horizontal"]["max_abs"], 1e-4);
  EXPECT_NEAR(all["runs"][0]["starts"][0]["gyro_bias_radps"][0], 0.01,
              1e-5);  // but for the earth's rate and tilt
}

TEST_F(Navigate, DenoisedRatesAreShownAtTheirStampsAndLate) {
  Recording recording;
  recording.noise_radps = 0.005;
  const json all = figures(recording, {"--schemes", "raw,acf-emd", "--starts", "1", "--delay-samples", "8"});
  ASSERT_EQ(all["runs"].size(), 3U);
  EXPECT_EQ(all["runs"][1]["scheme"], "acf-emd");
  EXPECT_EQ(all["runs"][1]["delay_samples"], 0);
  EXPECT_EQ(all["runs"][2]["delay_samples"], 8);
  // 80 ms late at rates of 0.4 rad/s: some degrees, far more than the lag-compensated row.
  const auto error = [&](std::size_t run) -> double {
    return all["runs"][run]["pooled"]["rotation_deg"]["total"]["rmse"];
  };
  EXPECT_GT(error(2), 5.0 * error(1));
}

// What is published by default is compared by default; in one piece there is no method joint.
TEST_F(Navigate, ComparesWhatTheDaemonPublishesUnlessToldOtherwise) {
  const auto schemes = [this](std::vector<std::string> more) {
    more.insert(more.end(), {"--starts", "1", "--delay-samples", "0"});
    std::vector<std::string> names;
    const json all = figures({}, more);
    for (const json& one : all["runs"]) names.push_back(one["scheme"]);
    return names;
  };
  EXPECT_THAT(schemes({}), ElementsAre("raw", "joint", "realtime", "improved"));
  EXPECT_THAT(schemes({"--whole-record"}), ElementsAre("raw", "acf-emd", "improved"));
  write_file("late.json",
             R"({"denoise": {"method": "paper", "lag_samples": 64}, "noise": {"source": "imf1"}})");
  EXPECT_THAT(schemes({"--config", path("late.json")}), ElementsAre("raw", "acf-emd", "improved"));
}

TEST_F(Navigate, TruthInAFileHasItsOwnTimes) {
  Recording recording;
  recording.truth = false;
  std::string truth = "timestamp_s,roll_deg,pitch_deg,heading_deg,vn_mps,ve_mps,vd_mps\n";
  ExactWalk walk(recording.motion());
  for (int n = 0; n < 3000; ++n) {
    if (n % 25 == 7) {
      const core::EulerAngles euler = core::euler_of(walk.state().attitude);
      std::ostringstream row;
      row << std::setprecision(17) << 0.01 * n + 0.1;
      for (const double angle : {euler.roll_rad, euler.pitch_rad, euler.heading_rad})
        row << "," << angle / kDegree;
      for (const double v : walk.state().velocity_mps) row << "," << v;
      truth += row.str() + "\n";
    }
    walk.advance(0.01);
  }
  write_file("truth.csv", truth);
  // Its clock is 0.1 s ahead. The start lies on one of its samples: between two the straight line would be off.
  const json all = figures(recording, {"--schemes", "raw", "--bias", "none", "--truth", path("truth.csv"),
                                       "--truth-offset", "-0.1", "--start", "5.07"});
  const json& pooled = all["runs"][0]["pooled"];
  EXPECT_NEAR(pooled["velocity_mps"]["east"]["samples"].get<int>(), 39.5,
              0.6);  // the last one lies on the edge
  EXPECT_LT(pooled["rotation_deg"]["total"]["max_abs"], 5e-3);
  EXPECT_LT(pooled["velocity_mps"]["east"]["max_abs"], 5e-3);
  EXPECT_FALSE(pooled.contains("position_m"));
}

TEST_F(Navigate, ListsAreTakenWithCommasOrOneByOneAndLeaveTheFileAlone) {
  write_file("in.csv", Recording{}.text());
  const Result result = run({"navigate", "--schemes", "raw", "--duration", "5", "--start", "1,2.5", "--start",
                             "4", path("in.csv"), "--json", path("out.json")});
  ASSERT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  EXPECT_EQ(json::parse(read_file("out.json"))["starts"].size(), 3U);
}

TEST_F(Navigate, WritesTheErrorsSampleBySample) {
  const json all = figures({}, {"--schemes", "raw", "--start", "2", "--csv", path("errors.csv")});
  const auto rows = columns_of(path("errors.csv"), {"scheme", "start_s"});
  EXPECT_EQ(rows.size(), 1000U);
  EXPECT_EQ(rows.front(), "raw,2");
}

TEST_F(Navigate, SaysWhatItCannotDoWithout) {
  const auto expect = [this](const Recording& recording, const std::vector<std::string>& more, int exit_code,
                             const ::testing::Matcher<std::string>& message) {
    const Result result = navigate(recording, more);
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_THAT(result.err, message);
  };
  Recording bare;
  bare.accelerometer = false;
  expect(bare, {}, ExitCode::kFileTrouble, AllOf(HasSubstr("no accelerometer"), HasSubstr("accel_x_UNIT")));
  Recording blind;
  blind.truth = false;
  expect(blind, {}, ExitCode::kFileTrouble, AllOf(HasSubstr("no truth"), HasSubstr("--still")));
  expect({}, {"--truth", "ref"}, ExitCode::kFileTrouble, AllOf(HasSubstr("'ref'"), HasSubstr("'gt_'")));
  expect({}, {"--truth", path("none.csv")}, ExitCode::kFileTrouble, HasSubstr("none.csv"));
  expect({}, {"--start", "99"}, ExitCode::kWrongUsage,
         AllOf(HasSubstr("--start"), HasSubstr("99"), HasSubstr("29.99")));
  expect({}, {"--start", "10"}, ExitCode::kFileTrouble, AllOf(HasSubstr("29.99 s"), HasSubstr("--duration")));
  expect({}, {}, ExitCode::kFileTrouble, AllOf(HasSubstr("29.99 s"), HasSubstr("50 s")));
  expect(blind, {"--bias", "truth", "--still"}, ExitCode::kFileTrouble, HasSubstr("--bias"));
  expect({}, {"--still", "--truth", "gt"}, ExitCode::kWrongUsage, HasSubstr("--still"));
  expect({}, {"--schemes", "raw,best"}, ExitCode::kWrongUsage, HasSubstr("best"));
}

TEST_F(Navigate, WithoutTimeColumnTheRateHasToBeGiven) {
  std::string text = "gyro_x_dps,gyro_y_dps,gyro_z_dps,accel_x_g,accel_y_g,accel_z_g\n";
  for (int n = 0; n < 2000; ++n) text += "0.1,0.2,0.3,0,0,-1\n";
  write_file("in.csv", text);
  const std::vector<std::string> arguments = {
      "navigate", path("in.csv"), "--still", "--duration", "5", "--level-seconds", "5", "--schemes", "raw"};
  const Result without = run(arguments);
  EXPECT_EQ(without.exit_code, ExitCode::kFileTrouble);
  EXPECT_THAT(without.err, HasSubstr("rate"));
  std::vector<std::string> with = arguments;
  with.insert(with.end(), {"--rate", "100"});
  EXPECT_EQ(run(with).exit_code, ExitCode::kDone);
}

}  // namespace
}  // namespace gyrod::testing
