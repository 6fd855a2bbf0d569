/// A sensor's noise, learned, remembered or calibrated: in the daemon and offline.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/exit_code.hpp"
#include "rig.hpp"

namespace gyrod::testing {
namespace {

using app::ExitCode;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::vector<std::string> kEstimates = {"gyro_x_radps",     "gyro_y_radps",     "gyro_z_radps",
                                             "gyro_std_x_radps", "gyro_std_y_radps", "gyro_std_z_radps"};

class Noise : public Rig {
 protected:
  /// 40 s at rest, then 10 s of driving, as one recording.
  void make_drive() {
    ASSERT_EQ(run({"simulate", "--samples", "4000", "-o", path("still.csv")}).exit_code, 0);
    ASSERT_EQ(run({"simulate", "--motion", "drive", "--samples", "1000", "-o", path("moving.csv")}).exit_code,
              0);
    std::string text = "sequence,stamp_ns,gyro_x_radps,gyro_y_radps,gyro_z_radps\n";
    std::int64_t n = 0;
    for (const std::string file : {"still.csv", "moving.csv"}) {
      for (const std::string& rates :
           columns_of(path(file), {"gyro_x_radps", "gyro_y_radps", "gyro_z_radps"})) {
        text += std::to_string(n) + "," + std::to_string(n * 10'000'000) + "," + rates + "\n";
        ++n;
      }
    }
    write_file("drive.csv", text);
  }
  Result denoise(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"denoise", path("drive.csv"), "-o",          path("offline.csv"),
                                          "--std",   "--summary",       path("s.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  /// Through a daemon that keeps its noise in state.json. @return the daemon's log
  std::string live(std::size_t workers, std::size_t batch, const std::string& out) {
    const auto daemon = start_daemon({.workers = workers, .state_file = path("state.json")});
    const auto recorder = start_recorder(out, {"--sensor", "front", "--until-end"});
    const Result replayed = run_on_bus({"replay", path("drive.csv"), "--sensor", "front", "--speed", "max",
                                        "--batch", std::to_string(batch), "--wait", "60"});
    EXPECT_EQ(replayed.exit_code, 0) << replayed.err;
    EXPECT_EQ(recorder->wait(), app::kDone) << recorder->err();
    EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
    return daemon->err();
  }
  /// Row of the first sample whose noise was learned; the number of rows where none was.
  std::size_t learned_since(const std::string& file) const {
    const auto sources = columns_of(path(file), {"noise_source"});
    return static_cast<std::size_t>(std::ranges::find(sources, "2") - sources.begin());
  }
};

TEST_F(Noise, IsLearnedAtRestFromTheSameSampleOnLiveAndOfflineAndRememberedAfterARestart) {
  make_drive();
  const Result offline = denoise({});
  ASSERT_EQ(offline.exit_code, 0) << offline.err;
  EXPECT_THAT(offline.err,
              AllOf(HasSubstr("method joint"), HasSubstr("noise source standstill from sample")));
  const auto expected = columns_of(path("offline.csv"), kEstimates);

  live(2, 7, "first.csv");
  EXPECT_TRUE(columns_of(path("first.csv"), kEstimates) == expected);
  const std::size_t since = learned_since("first.csv");
  EXPECT_GT(since, 1000U) << "ten seconds of rest at least";
  EXPECT_LT(since, 4000U);
  std::filesystem::remove(path("state.json"));
  live(4, 64, "again.csv");
  EXPECT_EQ(learned_since("again.csv"), since);

  const std::string log = live(2, 7, "second.csv");
  EXPECT_THAT(log, HasSubstr("1 sensors remembered"));
  EXPECT_LT(learned_since("second.csv"), 200U) << "from the first model on";
}

TEST_F(Noise, OfflineReadsTheStateFileOfTheSensorThatItIsToldAndLeavesItAlone) {
  make_drive();
  live(2, 7, "first.csv");
  const std::string state = read_file("state.json");
  live(2, 7, "second.csv");
  write_file("state.json", state);
  const Result offline = denoise({"--config", config(), "--sensor", "front"});
  ASSERT_EQ(offline.exit_code, 0) << offline.err;
  EXPECT_TRUE(columns_of(path("offline.csv"), kEstimates) == columns_of(path("second.csv"), kEstimates));
  EXPECT_EQ(read_file("state.json"), state);
  write_file("state.json", "{");
  const Result damaged = denoise({"--config", config(), "--sensor", "front"});
  EXPECT_EQ(damaged.exit_code, ExitCode::kFileTrouble);
  EXPECT_THAT(damaged.err, HasSubstr("state.json"));
  EXPECT_EQ(read_file("state.json"), "{");
}

TEST_F(Noise, ADamagedStateFileIsPutAsideWithOneWarning) {
  write_file("state.json", "{\"gyrod_noise_state\": 1, \"sens");
  const auto daemon = start_daemon({.state_file = path("state.json")});
  EXPECT_EQ(stop_daemon(*daemon), 0);
  const std::string log = daemon->err();
  const std::size_t first = log.find("noise is learned anew");
  ASSERT_NE(first, std::string::npos) << log;
  EXPECT_EQ(log.find("noise is learned anew", first + 1), std::string::npos) << log;
  EXPECT_EQ(read_file("state.json.damaged"), "{\"gyrod_noise_state\": 1, \"sens");
}

TEST_F(Noise, OfACalibrationIsUsedFromTheFirstModelOn) {
  make_drive();
  ASSERT_EQ(run({"calibrate", path("drive.csv"), "-o", path("front.json"), "--sensor", "front"}).exit_code,
            0);
  const Result offline = denoise({"--noise", path("front.json")});
  ASSERT_EQ(offline.exit_code, 0) << offline.err;
  EXPECT_THAT(offline.err, AllOf(HasSubstr("noise source calibrated from sample 63 on"),
                                 ::testing::Not(HasSubstr("the calibration of its noise"))));
  EXPECT_THAT(read_file("s.json"), HasSubstr("\"source\": \"calibrated\""));
  ASSERT_EQ(run({"calibrate", "--noise-density", "0.05", "--rate", "200", "-o", path("fast.json")}).exit_code,
            0);
  EXPECT_THAT(
      denoise({"--noise", path("fast.json")}).err,
      HasSubstr("the calibration of its noise holds for 200.0 Hz; at 100.0 Hz only its mean density"));
  const Result other = denoise({"--noise", path("front.json"), "--sensor", "rear"});
  EXPECT_EQ(other.exit_code, ExitCode::kWrongUsage);
  EXPECT_THAT(other.err, AllOf(HasSubstr("front.json"), HasSubstr("'rear'")));
}

TEST_F(Noise, ACalibrationThatCannotBeUsedIsNamedWithTheReason) {
  write_file("drive.csv", noisy_recording(100));
  const Result missing = denoise({"--noise", path("none.json")});
  EXPECT_EQ(missing.exit_code, ExitCode::kFileTrouble);
  EXPECT_THAT(missing.err, HasSubstr("none.json"));
  write_file("bad.json", R"({"gyrod_noise": 1, "sample_rate_hz": -5, "axes": {}})");
  const Result bad = denoise({"--noise", path("bad.json")});
  EXPECT_EQ(bad.exit_code, ExitCode::kFileTrouble);
  EXPECT_THAT(bad.err, AllOf(HasSubstr("bad.json"), HasSubstr("sample_rate_hz is -5")));
  EXPECT_FALSE(std::filesystem::exists(path("offline.csv")));
  write_file("gyrod.json", R"({"noise": {"calibrations": "bad.json"}})");
  for (const std::string command : {"run", "validate"}) {
    const Result result = run({command, "--config", config()});
    EXPECT_EQ(result.exit_code, ExitCode::kWrongSettings) << command;
    EXPECT_THAT(result.err, AllOf(HasSubstr("noise.calibrations"), HasSubstr("bad.json")));
  }
}

}  // namespace
}  // namespace gyrod::testing
