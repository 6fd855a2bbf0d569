/// What users see of the default method on recordings of cars and by hand: guards and navigation, as the subcommands print them (docs/measured.md,
/// "Guards"; docs/navigation.md). Skipped where GYROD_DATA is absent.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/exit_code.hpp"
#include "rig.hpp"
#include "support/data_folder.hpp"

namespace gyrod::testing {
namespace {

using app::ExitCode;
using nlohmann::json;

std::string recording(const std::string& name) { return (test::data_folder() / name).string(); }

bool have(const std::vector<std::string>& names) {
  for (const auto& name : names) {
    if (!std::filesystem::exists(recording(name))) return false;
  }
  return true;
}

class RealDrive : public Rig, public ::testing::WithParamInterface<const char*> {
 protected:
  /// Expects that no guard fails, and that no gain of slow motion is farther from 1 than the Butterworth's of the same delay by more than either is
  /// uncertain. @return how many were passed, of those that could be judged
  static int guards_passed(const json& evaluation) {
    int passed = 0;
    for (const json& row : evaluation.at("rows")) {
      for (const json& guard : row.at("guards")) {
        const bool realtime = guard.at("name") == "realtime";
        if (!realtime && guard.at("name") != "joint") continue;
        const std::string where =
            row.at("axis").get<std::string>() + " x " + row.at("noise_scale").dump() + ": " + guard.dump();
        const bool size = guard.at("guard") == "scale-factor";
        if (size) expect_size_of(row, guard, realtime ? "Butterworth, lag 0" : "Butterworth", where);
        // In noise of 1 deg/s what answers at once is allowed to give back as little as a Butterworth that does.
        if (!(realtime && size && row.at("noise_scale") > 1.0)) {
          EXPECT_NE(guard.at("verdict"), "fail") << where;
        }
        passed += guard.at("verdict") == "pass" ? 1 : 0;
      }
    }
    return passed;
  }

 private:
  static void expect_size_of(const json& row, const json& ours, const char* rival, const std::string& where) {
    const auto theirs = std::ranges::find_if(row.at("guards"), [&](const json& guard) {
      return guard.at("name") == rival && guard.at("guard") == "scale-factor";
    });
    ASSERT_NE(theirs, row.at("guards").end()) << where;
    const auto number = [](const json& guard, const char* key) { return guard.at(key).get<double>(); };
    const double uncertain = std::hypot(number(ours, "standard_error"), number(*theirs, "standard_error"));
    EXPECT_LE(std::abs(number(ours, "value") - 1.0),
              std::abs(number(*theirs, "value") - 1.0) + 2.0 * uncertain)
        << where << "; the Butterworth's: " << *theirs;
  }
};

// A car's reference gyro under the noise of an ADIS16405 of 0.35 deg/s, and of 0.3 and 3 times that. At 3 times realtime keeps all of them but the size of slow motion.
TEST_P(RealDrive, PassesAllGuards) {
  constexpr const char* kNoise = "adis16405_imu1_static_100hz.csv.gz";
  if (!have({GetParam(), kNoise})) GTEST_SKIP() << "no recordings in " << test::data_folder();
  int passed = 0;
  for (const char* axis : {"x", "y", "z"}) {
    const Result result = run({"evaluate",      recording(GetParam()),
                               "--noise",       recording(kNoise),
                               "--noise-axes",  "x",
                               "--axis",        axis,
                               "--rate",        "120",
                               "--noise-scale", "1,0.3,3",
                               "--from",        "2400",
                               "--to",          "9600",
                               "--lag",         "16",
                               "--methods",     "joint,realtime",
                               "--no-turns",    "-o",
                               path("guards")});
    ASSERT_EQ(result.exit_code, ExitCode::kDone) << result.err;
    passed += guards_passed(json::parse(read_file("guards/evaluation.json")));
  }
  EXPECT_GT(passed, 90) << "of 9 rows of joint and 9 of realtime, with eight guards or so each";
}

INSTANTIATE_TEST_SUITE_P(Cars, RealDrive,
                         ::testing::Values("wid_car_trial06_xsensdot_120hz.csv.gz",
                                           "wid_car_trial09_xsensdot_120hz.csv.gz"),
                         [](const auto& info) { return std::string(info.param).substr(8, 7); });

class RealNavigation : public Rig {
 protected:
  /// Position after 50 s from denoised rates is no worse than from raw ones by more than 2 %, on any of five starts.
  void expect_no_harm(const std::string& name, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {
        "navigate", recording(name),         "--schemes",       "raw,joint,realtime",
        "--json",   path("navigation.json"), "--delay-samples", "0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = run(arguments);
    ASSERT_EQ(result.exit_code, ExitCode::kDone) << result.err;
    const json runs = json::parse(read_file("navigation.json")).at("runs");
    ASSERT_EQ(runs.size(), 3U);
    const auto error = [&runs](std::size_t scheme, std::size_t start) {
      return runs[scheme].at("starts").at(start).at("position_m").at("horizontal").at("rmse").get<double>();
    };
    ASSERT_EQ(runs[0].at("scheme"), "raw");
    ASSERT_EQ(runs[0].at("starts").size(), 5U);
    for (std::size_t start = 0; start < 5; ++start) {
      for (const std::size_t scheme : {1U, 2U})
        EXPECT_LE(error(scheme, start), 1.02 * error(0, start))
            << name << ", " << runs[scheme].at("scheme") << ", start " << start;
    }
  }
};

// Nothing is known of that sensor's noise, and the engine runs while it is levelled.
TEST_F(RealNavigation, OfACarIsNoWorseThanRaw) {
  if (!have({"drive0708_lsm6_100hz.csv.gz", "drive0708_gnss_rtk_4hz.csv"}))
    GTEST_SKIP() << "no recordings in " << test::data_folder();
  expect_no_harm("drive0708_lsm6_100hz.csv.gz",
                 {"--truth", recording("drive0708_gnss_rtk_4hz.csv"), "--truth-offset", "-0.1"});
}

TEST_F(RealNavigation, ByHandIsNoWorseThanRaw) {
  const std::vector<std::string> rooms = {"tumvi_room1_bmi160_200hz.csv.gz",
                                          "tumvi_room3_bmi160_200hz.csv.gz"};
  if (!have(rooms)) GTEST_SKIP() << "no recordings in " << test::data_folder();
  for (const auto& room : rooms) expect_no_harm(room);
}

}  // namespace
}  // namespace gyrod::testing
