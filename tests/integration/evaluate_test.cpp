/// `gyrod evaluate`: an error that is known is found; filters are tuned; what cannot be done is said.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/exit_code.hpp"
#include "rig.hpp"

namespace gyrod::testing {
namespace {

using app::ExitCode;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

/// One axis, 100 Hz: a slow swing, measured with white noise of 0.2 deg/s and a bias of 0.05 deg/s.
struct Recording {
  int samples = 6000;
  double rate_hz = 100.0;
  double noise_dps = 0.2;
  double bias_dps = 0.05;
  double amplitude_dps = 5.0;
  bool stamps = true;
  std::string_view truth = "truth_z_dps";
  int lost_from = 0;
  int lost_to = 0;

  [[nodiscard]] std::string text() const {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal(0.0, 1.0);
    std::ostringstream out;
    out.precision(17);
    out << (stamps ? "timestamp_s," : "") << "gyro_z_dps" << (truth.empty() ? "" : ",") << truth << '\n';
    for (int n = 0; n < samples; ++n) {
      const double right = amplitude_dps * std::sin(2.0 * std::numbers::pi * 0.1 * n / rate_hz);
      if (stamps) out << n / rate_hz << ',';
      out << right + bias_dps + noise_dps * normal(random);
      if (!truth.empty() && n >= lost_from && n < lost_to) out << ",nan";
      if (!truth.empty() && (n < lost_from || n >= lost_to)) out << ',' << right;
      out << '\n';
    }
    return out.str();
  }
};

class Evaluate : public Rig {
 protected:
  Result evaluate(const std::string& file, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"evaluate", path(file), "--axis", "z", "--lag", "0,16"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  /// @return the JSON
  json figures(const std::string& file, std::vector<std::string> more = {"--no-turns"}) {
    more.insert(more.end(), {"-o", path("out")});
    const Result result = evaluate(file, more);
    EXPECT_EQ(result.exit_code, ExitCode::kDone) << result.err;
    return result.exit_code == ExitCode::kDone ? json::parse(read_file("out/evaluation.json")) : json();
  }
  static json estimator(const json& all, const std::string& name, std::size_t row = 0) {
    for (const json& one : all["rows"][row]["estimators"]) {
      if (one["name"] == name) return one;
    }
    ADD_FAILURE() << "no estimator " << name;
    return {};
  }
};

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

TEST_F(Evaluate, TunedFiltersBeatRawAndGainByLag) {
  write_file("in.csv", Recording{}.text());
  const json all = figures("in.csv");
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

// Where windows simply take turns, second differences at joints are 23 times those elsewhere here.
TEST_F(Evaluate, OneDoesNotSeeWhereWindowsOfThePapersMethodMeet) {
  const Result drive =
      run({"simulate", "--motion", "drive", "--samples", "6000", "--unit", "dps", "-o", path("drive.csv")});
  ASSERT_EQ(drive.exit_code, ExitCode::kDone) << drive.err;
  const json all = figures("drive.csv");
  for (const json& guard : all["rows"][0]["guards"]) {
    if (guard["name"] == "improved" && guard["guard"].get<std::string>().starts_with("joint-")) {
      EXPECT_EQ(guard["verdict"], "pass") << guard;
    }
  }
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

TEST_F(Evaluate, AddsTheNoiseOfAStillRecordingAtEachScale) {
  write_file("in.csv", Recording{.noise_dps = 3.0}.text());
  write_file("still.csv",
             Recording{.bias_dps = 1.0, .amplitude_dps = 0.0, .stamps = false, .truth = ""}.text());
  const json all = figures(
      "in.csv", {"--no-turns", "--noise", path("still.csv"), "--noise-scale", "0.5,2", "--from", "0"});
  ASSERT_EQ(all["rows"].size(), 2U);
  // The recording's own noise and the still one's mean play no part; 6000 samples: 0.9 %, three of these.
  EXPECT_NEAR(estimator(all, "raw", 0)["lags"][0]["rmse_dps"], 0.1, 0.003);
  EXPECT_NEAR(estimator(all, "raw", 1)["lags"][0]["rmse_dps"], 0.4, 0.012);
  EXPECT_NEAR(estimator(all, "raw", 1)["lags"][0]["bias_dps"], 0.0, 1e-6);
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
  EXPECT_EQ(added["cautions"], json::array());
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
  static_cast<void>(figures("in.csv", {"--methods", "realtime", "--turn-repeats", "1"}));
  EXPECT_NE(read_file("out/turns.csv"), "");
  static_cast<void>(figures("in.csv", {"--methods", "realtime", "--no-turns"}));
  EXPECT_FALSE(std::filesystem::exists(path("out/turns.csv")));
}

// From a pipe it can be read only once, and it says its columns first. Without stamps it is taken at the signal's rate.
TEST_F(Evaluate, TakesTheNoiseFromStandardInput) {
  write_file("in.csv", Recording{}.text());
  write_file("still.csv", Recording{.amplitude_dps = 0.0, .stamps = false, .truth = ""}.text());
  const std::string command =
      "cat '" + path("still.csv") + "' | '" + binary() + "' evaluate '" + path("in.csv") +
      "' --axis z --methods realtime --lag 0 --no-turns --from 0 --noise - -o '" + path("out") + "'";
  Process shell({"/bin/sh", "-c", command}, path(""), "shell");
  ASSERT_EQ(shell.wait(), ExitCode::kDone) << shell.err();
  const json piped = json::parse(read_file("out/evaluation.json"));
  EXPECT_EQ(piped["record"]["noise"], "standard input");
  EXPECT_NEAR(estimator(piped, "raw")["lags"][0]["rmse_dps"], 0.2, 0.006);
}

TEST_F(Evaluate, TakesTheSignalItselfForTheTruth) {
  write_file("in.csv", Recording{.noise_dps = 0.0, .truth = ""}.text());
  write_file("still.csv", Recording{.amplitude_dps = 0.0, .truth = ""}.text());
  const json all = figures("in.csv", {"--no-turns", "--signal-is-truth", "--noise", path("still.csv")});
  EXPECT_NEAR(estimator(all, "raw")["lags"][0]["rmse_dps"], 0.2, 0.007);
}

TEST_F(Evaluate, TurnsTheTruthIntoTheSensorsFrame) {
  write_file("in.csv", Recording{.truth = "ref_gyro_x_dps"}.text());
  EXPECT_NEAR(
      estimator(figures("in.csv", {"--no-turns", "--truth-axes", "z,y,x"}), "raw")["lags"][0]["rmse_dps"],
      0.206, 0.007);
  // Against minus itself: sqrt(0.2^2 + 0.05^2 + (2 5)^2 / 2).
  EXPECT_NEAR(
      estimator(figures("in.csv", {"--no-turns", "--truth-axes=z,y,-x"}), "raw")["lags"][0]["rmse_dps"],
      7.074, 0.02);
}

// All spellings that a gyro's columns may have, in any case.
TEST_F(Evaluate, TakesTheTruthInAnyUnit) {
  write_file("in.csv", Recording{.truth = "Ref_Z_deg/s"}.text());
  const json all = figures("in.csv", {"--no-turns", "--methods", "realtime", "--truth-columns", "Ref_"});
  EXPECT_NEAR(estimator(all, "raw")["lags"][0]["rmse_dps"], 0.206, 0.007);
}

TEST_F(Evaluate, CountsWhatTheTruthDoesNotKnow) {
  write_file("in.csv", Recording{.lost_from = 3000, .lost_to = 3100}.text());
  const json raw = estimator(figures("in.csv"), "raw")["lags"][0];
  EXPECT_EQ(raw["lost_truth_samples"], 100);
  EXPECT_EQ(raw["samples"], 3900);
}

TEST_F(Evaluate, SaysWhatIsWrong) {
  struct Case {
    Recording recording;
    std::vector<std::string> more;
    int exit_code;
    const char* words;
  };
  write_file("fast.csv", Recording{.rate_hz = 200.0, .amplitude_dps = 0.0, .truth = ""}.text());
  write_file("tiny.csv", Recording{.samples = 50, .amplitude_dps = 0.0, .truth = ""}.text());
  write_file("still.csv", Recording{.amplitude_dps = 0.0, .truth = ""}.text());
  const std::string still = path("still.csv");
  const std::string fast = path("fast.csv");
  const std::string tiny = path("tiny.csv");
  const std::vector<Case> cases = {
      {{.truth = ""}, {}, ExitCode::kFileTrouble, "no truth to compare with"},
      {{}, {"--truth-columns", "gt_"}, ExitCode::kFileTrouble, "expected columns gt_x_UNIT"},
      {{.lost_from = 2000, .lost_to = 6000},
       {},
       ExitCode::kFileTrouble,
       "is not known between samples 2000 and 6000"},
      {{.lost_from = 0, .lost_to = 6000}, {}, ExitCode::kFileTrouble, "truth_z_dps holds no number"},
      {{.truth = "truth_z_rpm"}, {}, ExitCode::kFileTrouble, "truth_z_rpm does not end in a unit"},
      {{.truth = "truth_z"}, {}, ExitCode::kFileTrouble, "radps, mradps, dps, mdps, dph"},
      {{}, {"--axis", "x,z"}, ExitCode::kFileTrouble, "axis x is missing: there is no column truth_x_UNIT"},
      {{}, {"--axis", "x,z"}, ExitCode::kFileTrouble, "--axis z judges what has a truth"},
      {{.samples = 50}, {}, ExitCode::kFileTrouble, "holds 50 good samples"},
      {{.stamps = false}, {}, ExitCode::kFileTrouble, "--rate"},
      {{.truth = "gyro_z_noise"}, {}, ExitCode::kFileTrouble, "UNIT one of radps"},
      {{}, {"--noise", fast}, ExitCode::kFileTrouble, "nothing is resampled"},
      {{}, {"--noise", tiny}, ExitCode::kFileTrouble, "holds 50 good samples"},
      {{}, {"--noise", path("none.csv")}, ExitCode::kFileTrouble, "none.csv"},
      {{}, {"--signal-is-truth"}, ExitCode::kWrongUsage, "needs --noise"},
      {{}, {"--noise-scale", "2"}, ExitCode::kWrongUsage, "need --noise"},
      {{},
       {"--signal-is-truth", "--noise", still, "--truth-columns", "truth_"},
       ExitCode::kWrongUsage,
       "excludes --truth-columns"},
      {{},
       {"--signal-is-truth", "--noise", still, "--truth-axes", "x,y,z"},
       ExitCode::kWrongUsage,
       "excludes --truth-columns"},
      {{},
       {"--noise", still, "--noise-start", "6000"},
       ExitCode::kWrongUsage,
       "beyond the 6000 good samples"},
      {{}, {"--from", "5950"}, ExitCode::kWrongUsage, "at least 100"},
      {{}, {"--from", "soon"}, ExitCode::kWrongUsage, "expected samples, as 2400"},
      {{}, {"--lag", "300"}, ExitCode::kWrongUsage, "joint takes at most 32"},
      {{}, {"--lag", "300", "--methods", "improved"}, ExitCode::kWrongUsage, "takes at most 256"},
      {{}, {"--methods", "magic"}, ExitCode::kWrongUsage, "magic"},
      {{}, {"-o", path("in.csv")}, ExitCode::kFileTrouble, "in.csv"},
  };
  for (const Case& one : cases) {
    write_file("in.csv", one.recording.text());
    const Result result = evaluate("in.csv", one.more);
    EXPECT_EQ(result.exit_code, one.exit_code) << one.words << '\n' << result.err;
    EXPECT_THAT(result.err, HasSubstr(one.words));
  }
}

TEST_F(Evaluate, CannotReadBothFromStandardInput) {
  const Result result = run({"evaluate", "-", "--noise", "-"});
  EXPECT_EQ(result.exit_code, ExitCode::kWrongUsage);
  EXPECT_THAT(result.err, HasSubstr("cannot both be standard input"));
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

// The limits of the configuration hold for what is read: 0.05 rad/s are 2.9 deg/s of the swing's 5.
TEST_F(Evaluate, RefusesWhatTheConfigurationRefuses) {
  write_file("in.csv", Recording{.samples = 3000}.text());
  write_file("gyrod.json", R"({"limits": {"max_rate_radps": 0.05}})");
  const Result result = evaluate(
      "in.csv", {"--no-turns", "--methods", "realtime", "--from", "0", "--config", path("gyrod.json")});
  EXPECT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("caution: "), HasSubstr("samples are refused")));
}

TEST_F(Evaluate, GivesTheSameNumbersTwice) {
  write_file("in.csv", Recording{.samples = 3000}.text());
  EXPECT_EQ(evaluate("in.csv", {"--turn-repeats", "1"}).out, evaluate("in.csv", {"--turn-repeats", "1"}).out);
}

}  // namespace
}  // namespace gyrod::testing
