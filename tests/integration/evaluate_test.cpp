/// `gyrod evaluate`: an error that is known is found; filters are tuned; what was run is told.
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluate_support.hpp"

namespace gyrod::testing {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

class Evaluate : public EvaluateRig {};

// Noise and bias: sqrt(0.2^2 + 0.05^2); 4000 samples of white noise: 1.1 %, three of these.
TEST_F(Evaluate, FindsTheErrorThatIsThere) {
  write_file("in.csv", Recording{}.text());
  const json all = figures("in.csv");
  const json raw = estimator(all, "raw")["lags"][0];
  EXPECT_NEAR(raw["rmse_dps"], std::hypot(0.2, 0.05), 0.007);
  EXPECT_NEAR(raw["bias_dps"], 0.05, 3.0 * 0.2 / std::sqrt(4000.0));
  EXPECT_NEAR(raw["scale_factor"], 1.0, 0.005);
  EXPECT_EQ(raw["samples"], 4000);  // from 20 s on
  EXPECT_NEAR(raw["rmse_without_bias_dps"], 0.2, 0.007);
  EXPECT_EQ(raw["normalised_error_without_bias"], nullptr);
  EXPECT_NEAR(estimator(all, "joint")["lags"][1]["normalised_error_without_bias"], 1.0, 0.5);
  EXPECT_NEAR(raw["angle_10s_rms_deg"], 0.5,
              0.1);  // bias times 10 s; noise adds up to 0.2 sqrt(1000)/100 = 0.06
  EXPECT_NEAR(estimator(all, "bias removed")["lags"][0]["rmse_dps"], 0.2, 0.007);
  EXPECT_NEAR(all["rows"][0]["noise_std_dps"], 0.2, 0.007);
}

// Every method is as far off as raw then, and every guard passes.
TEST_F(Evaluate, SaysThatRawAndTruthAreNotInTheSameUnit) {
  write_file("in.csv", Recording{.truth = "truth_z_radps"}.text());
  const std::string cautions = figures("in.csv", {"--no-turns", "--methods", "improved"})["cautions"].dump();
  EXPECT_THAT(cautions,
              AllOf(HasSubstr("raw is 0.017"), HasSubstr("times the truth")));  // pi / 180, but for noise
  write_file("in.csv", Recording{}.text());
  EXPECT_EQ(figures("in.csv", {"--no-turns", "--methods", "improved"})["cautions"], json::array());
}

TEST_F(Evaluate, TunedFiltersBeatRawAndGainByLag) {
  write_file("in.csv", Recording{}.text());
  const json all = figures("in.csv", {"--no-turns", "--methods", "improved"});
  const double raw = estimator(all, "raw")["lags"][0]["rmse_dps"];
  for (const char* name : {"Butterworth", "moving average", "Savitzky-Golay", "zero-phase Butterworth"}) {
    const json lags = estimator(all, name)["lags"];
    EXPECT_LT(lags[1]["rmse_dps"], 0.6 * raw) << name;
    EXPECT_LE(lags[1]["rmse_dps"], lags[0]["rmse_dps"]) << name;
    EXPECT_FALSE(lags[1]["tuning"].get<std::string>().empty());
  }
  EXPECT_EQ(estimator(all, "improved")["kind"], "method");
}

// Each method has filters beside it that may be as late as it is: at the lag of the configuration, and at once.
TEST_F(Evaluate, JudgesWhatTheDaemonPublishesAtItsOwnLagUnlessToldOtherwise) {
  write_file("in.csv", Recording{.samples = 3000}.text());
  write_file("gyrod.json", R"({"denoise": {"lag_samples": 8}})");
  const Result result = run({"evaluate", path("in.csv"), "--axis", "z", "--lag", "16", "--no-turns",
                             "--config", path("gyrod.json"), "-o", path("out")});
  ASSERT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  const json all = json::parse(read_file("out/evaluation.json"));
  EXPECT_EQ(all["lags_samples"], json({0, 8, 16}));
  EXPECT_EQ(all["own_lag_samples"], 8);
  std::vector<std::string> methods;
  for (const json& one : all["rows"][0]["estimators"]) {
    if (one["kind"] == "method") methods.push_back(one["name"]);
  }
  EXPECT_THAT(methods, ElementsAre("joint", "realtime", "improved"));
  const json realtime = estimator(all, "realtime")["lags"];
  EXPECT_EQ(realtime[2]["lag_samples"], 0);
  EXPECT_EQ(realtime[2]["lag_bound_samples"], 16);
  EXPECT_EQ(realtime[2]["rmse_dps"], realtime[0]["rmse_dps"]);
  EXPECT_LT(estimator(all, "joint")["lags"][1]["rmse_dps"], realtime[0]["rmse_dps"]);
  std::set<std::string> guarded;
  for (const json& one : all["rows"][0]["guards"]) guarded.insert(one["name"]);
  EXPECT_THAT(guarded,
              UnorderedElementsAre("joint", "realtime", "improved", "Butterworth", "Butterworth, lag 0"));
}

// Where windows simply take turns, second differences at seams are 23 times those elsewhere here.
TEST_F(Evaluate, OneDoesNotSeeWhereWindowsOfThePapersMethodMeet) {
  const Result drive =
      run({"simulate", "--motion", "drive", "--samples", "6000", "--unit", "dps", "-o", path("drive.csv")});
  ASSERT_EQ(drive.exit_code, ExitCode::kDone) << drive.err;
  const json all = figures("drive.csv", {"--no-turns", "--methods", "improved"});
  int judged = 0;
  for (const json& guard : all["rows"][0]["guards"]) {
    if (guard["name"] != "improved" || !guard["guard"].get<std::string>().starts_with("seam-")) continue;
    EXPECT_EQ(guard["verdict"], "pass") << guard;
    ++judged;
  }
  EXPECT_EQ(judged, 3);
}

TEST_F(Evaluate, WritesPageTablesAndTurns) {
  write_file("in.csv", Recording{}.text());
  const json all = figures("in.csv", {"--turn-repeats", "1", "--methods", "acf-emd,improved"});
  EXPECT_EQ(all["rows"][0]["turns"].size(), 9U);    // three turns, two methods and the Butterworth
  EXPECT_EQ(all["rows"][0]["guards"].size(), 27U);  // nine guards each
  EXPECT_THAT(read_file("out/evaluation.html"), AllOf(HasSubstr("Evaluation on"), HasSubstr("</html>")));
  EXPECT_THAT(read_file("out/evaluation.csv"),
              HasSubstr("axis,noise_scale,noise_std_dps,name,kind,lag_bound_samples"));
  EXPECT_THAT(read_file("out/guards.csv"), HasSubstr("slow-turn-gain"));
  EXPECT_THAT(read_file("out/turns.csv"), HasSubstr("half_delay_s"));
}

TEST_F(Evaluate, PrintsTheTable) {
  write_file("in.csv", Recording{}.text());
  const Result result = evaluate("in.csv", {"--no-turns"});
  EXPECT_EQ(result.exit_code, ExitCode::kDone);
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("RMSE, deg/s, by lag"), HasSubstr("less bias"), HasSubstr("normalised\n"),
                    ContainsRegex("\n  joint .* [0-9.]+ / [0-9.]+\n"), HasSubstr("Butterworth *"),
                    HasSubstr("swing-gain"), HasSubstr("tuned on the truth")));
}

// All that decided on the numbers, and what nothing was known of.
TEST_F(Evaluate, RecordsWhatWasRun) {
  write_file("in.csv", Recording{.samples = 3000, .truth = "ref_gyro_x_dps"}.text());
  write_file("still.csv", Recording{.amplitude_dps = 0.0, .truth = ""}.text());
  write_file("gyrod.json", R"({"denoise": {"hop_samples": 64, "max_signal_hz": 20}})");
  const json own = figures("in.csv", {"--no-turns", "--methods", "realtime", "--truth-axes=z,y,-x",
                                      "--config", path("gyrod.json")});
  EXPECT_EQ(own["record"]["truth_axes"], json({{"z", "-x"}}));
  EXPECT_EQ(own["record"]["noise_axes"], nullptr);
  EXPECT_EQ(own["configuration"], json({{"methods", {"realtime"}},
                                        {"window_samples", 1024},
                                        {"hop_samples", 64},
                                        {"joint_window_samples", 1024},
                                        {"joint_hop_samples", 64},
                                        {"lag_samples", 16},
                                        {"max_signal_hz", 20.0},
                                        {"noise_source", "auto"},
                                        {"turn_repeats", nullptr}}));
  EXPECT_EQ(own["rows"][0]["noise_model"], "unknown");
  EXPECT_THAT(own["cautions"].dump(), HasSubstr("nothing is known of the noise"));

  const json added = figures("in.csv", {"--no-turns", "--methods", "realtime", "--signal-is-truth", "--noise",
                                        path("still.csv"), "--noise-axes=-z", "--noise-start", "500"});
  EXPECT_EQ(added["record"]["truth_axes"], nullptr);
  EXPECT_EQ(added["record"]["noise_axes"], json({{"z", "-z"}}));
  EXPECT_EQ(added["record"]["noise_start_sample"], 500);
  EXPECT_EQ(added["record"]["noise_spare_samples"], 3000);
  EXPECT_EQ(added["rows"][0]["noise_model"], "calibrated from the other samples of the noise file");
  ASSERT_EQ(added["cautions"].size(), 1U) << "noise of 0.2 deg/s is in what is taken for the truth";
  EXPECT_THAT(added["cautions"].dump(), HasSubstr("have noise of their own"));
}

TEST_F(Evaluate, PutsWhatWasRunAboveTheTable) {
  write_file("in.csv", Recording{.samples = 3000, .truth = "ref_gyro_x_dps"}.text());
  write_file("still.csv", Recording{.amplitude_dps = 0.0, .truth = ""}.text());
  const Result result = evaluate(
      "in.csv", {"--no-turns", "--methods", "realtime", "--truth-axes=z,y,-x", "--noise", path("still.csv")});
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("truth ref_gyro_: z from -x\n"), HasSubstr("z from z, from sample 0 on"),
                    HasSubstr("judged: realtime on samples 0 to 3000; window 1024, hop 32, lag 16 "
                              "samples, signal of any frequency\n"),
                    HasSubstr("noise model calibrated from")));
}

TEST_F(Evaluate, LeavesNoTurnsOfAnotherRun) {
  write_file("in.csv", Recording{.samples = 3000}.text());
  static_cast<void>(figures("in.csv", {"--methods", "improved", "--turn-repeats", "1"}));
  EXPECT_NE(read_file("out/turns.csv"), "");
  static_cast<void>(figures("in.csv", {"--methods", "improved", "--no-turns"}));
  EXPECT_FALSE(std::filesystem::exists(path("out/turns.csv")));
}

TEST_F(Evaluate, WhatIsSaidTwiceIsJudgedOnce) {
  write_file("in.csv", Recording{.samples = 3000}.text());
  write_file("still.csv", Recording{.amplitude_dps = 0.0, .truth = ""}.text());
  const json all = figures("in.csv", {"--no-turns", "--axis", "z", "--methods", "realtime,improved,realtime",
                                      "--noise", path("still.csv"), "--noise-scale", "1,2,1"});
  ASSERT_EQ(all["rows"].size(), 2U);
  EXPECT_EQ(all["rows"][1]["noise_scale"], 2.0);
  EXPECT_EQ(all["rows"][0]["guards"].size(), 36U);  // two methods and a Butterworth for the lag of each
}

TEST_F(Evaluate, GivesTheSameNumbersTwice) {
  write_file("in.csv", Recording{.samples = 2500}.text());
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--methods", "improved", "--turn-repeats", "1"},
        std::vector<std::string>{"--methods", "joint", "--no-turns"}})
    EXPECT_EQ(evaluate("in.csv", more).out, evaluate("in.csv", more).out);
}

}  // namespace
}  // namespace gyrod::testing
