/// `gyrod evaluate`: where truth and noise come from, and what is said of input that cannot be judged.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluate_support.hpp"

namespace gyrod::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// What goes in is seen by the raw rates; of the methods the one that takes the least time.
class EvaluateInput : public EvaluateRig {
 protected:
  json figures_of_raw(std::vector<std::string> more = {}) {
    more.insert(more.end(), {"--no-turns", "--methods", "improved"});
    return estimator(figures("in.csv", more), "raw")["lags"][0];
  }
};

TEST_F(EvaluateInput, AddsTheNoiseOfAStillRecordingAtEachScale) {
  write_file("in.csv", Recording{.noise_dps = 3.0}.text());
  write_file("still.csv",
             Recording{.bias_dps = 1.0, .amplitude_dps = 0.0, .stamps = false, .truth = ""}.text());
  const json all = figures("in.csv", {"--no-turns", "--methods", "improved", "--noise", path("still.csv"),
                                      "--noise-scale", "0.5,2", "--from", "0"});
  ASSERT_EQ(all["rows"].size(), 2U);
  // The recording's own noise and the still one's mean play no part; 6000 samples: 0.9 %, three of these.
  EXPECT_NEAR(estimator(all, "raw", 0)["lags"][0]["rmse_dps"], 0.1, 0.003);
  EXPECT_NEAR(estimator(all, "raw", 1)["lags"][0]["rmse_dps"], 0.4, 0.012);
  EXPECT_NEAR(estimator(all, "raw", 1)["lags"][0]["bias_dps"], 0.0, 1e-6);
}

// From a pipe it can be read only once, and it says its columns first. Without stamps it is taken at the signal's rate.
TEST_F(EvaluateInput, TakesTheNoiseFromStandardInput) {
  write_file("in.csv", Recording{}.text());
  write_file("still.csv", Recording{.amplitude_dps = 0.0, .stamps = false, .truth = ""}.text());
  const std::string command =
      "cat '" + path("still.csv") + "' | '" + binary() + "' evaluate '" + path("in.csv") +
      "' --axis z --methods improved --lag 0 --no-turns --from 0 --noise - -o '" + path("out") + "'";
  Process shell({"/bin/sh", "-c", command}, path(""), "shell");
  ASSERT_EQ(shell.wait(), ExitCode::kDone) << shell.err();
  const json piped = json::parse(read_file("out/evaluation.json"));
  EXPECT_EQ(piped["record"]["noise"], "standard input");
  EXPECT_NEAR(estimator(piped, "raw")["lags"][0]["rmse_dps"], 0.2, 0.006);
}

TEST_F(EvaluateInput, TakesTheSignalItselfForTheTruth) {
  write_file("in.csv", Recording{.noise_dps = 0.0, .truth = ""}.text());
  write_file("still.csv", Recording{.amplitude_dps = 0.0, .truth = ""}.text());
  EXPECT_NEAR(figures_of_raw({"--signal-is-truth", "--noise", path("still.csv")})["rmse_dps"], 0.2, 0.007);
}

TEST_F(EvaluateInput, TurnsTheTruthIntoTheSensorsFrame) {
  write_file("in.csv", Recording{.truth = "ref_gyro_x_dps"}.text());
  EXPECT_NEAR(figures_of_raw({"--truth-axes", "z,y,x"})["rmse_dps"], 0.206, 0.007);
  // Against minus itself: sqrt(0.2^2 + 0.05^2 + (2 5)^2 / 2).
  EXPECT_NEAR(figures_of_raw({"--truth-axes=z,y,-x"})["rmse_dps"], 7.074, 0.02);
}

// All spellings that a gyro's columns may have, in any case.
TEST_F(EvaluateInput, TakesTheTruthInAnyUnit) {
  write_file("in.csv", Recording{.truth = "Ref_Z_deg/s"}.text());
  EXPECT_NEAR(figures_of_raw({"--truth-columns", "Ref_"})["rmse_dps"], 0.206, 0.007);
}

TEST_F(EvaluateInput, CountsWhatTheTruthDoesNotKnow) {
  write_file("in.csv", Recording{.lost_from = 3000, .lost_to = 3100}.text());
  const json raw = figures_of_raw();
  EXPECT_EQ(raw["lost_truth_samples"], 100);
  EXPECT_EQ(raw["samples"], 3900);
}

TEST_F(EvaluateInput, SaysWhatIsWrong) {
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
      {{}, {"--lag", "300"}, ExitCode::kWrongUsage, "expected at most 32 for joint"},
      {{},
       {"--lag", "300", "--methods", "improved"},
       ExitCode::kWrongUsage,
       "expected at most 256 for improved"},
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

TEST_F(EvaluateInput, CannotReadBothFromStandardInput) {
  const Result result = run({"evaluate", "-", "--noise", "-"});
  EXPECT_EQ(result.exit_code, ExitCode::kWrongUsage);
  EXPECT_THAT(result.err, HasSubstr("cannot both be standard input"));
}

// The limits of the configuration hold for what is read: 0.05 rad/s are 2.9 deg/s of the swing's 5.
TEST_F(EvaluateInput, RefusesWhatTheConfigurationRefuses) {
  write_file("in.csv", Recording{.samples = 3000}.text());
  write_file("gyrod.json", R"({"limits": {"max_rate_radps": 0.05}})");
  const Result result = evaluate(
      "in.csv", {"--no-turns", "--methods", "realtime", "--from", "0", "--config", path("gyrod.json")});
  EXPECT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("caution: "), HasSubstr("samples are refused")));
}

}  // namespace
}  // namespace gyrod::testing
