/// Bad input at the command line: exit code and a message that names what is wrong.
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
using ::testing::Not;

class CommandLine : public Rig {
 protected:
  /// Runs `denoise` on a file with this text. @return its result; OUT must not be there
  Result denoise(const std::string& text, const std::vector<std::string>& more = {}) {
    write_file("in.csv", text);
    std::vector<std::string> arguments = {"denoise", path("in.csv"), "-o", path("out.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  void expect_refused(const std::string& text, const ::testing::Matcher<std::string>& message) {
    const Result result = denoise(text);
    EXPECT_EQ(result.exit_code, ExitCode::kFileTrouble) << result.err;
    EXPECT_THAT(result.err, message);
    EXPECT_FALSE(std::filesystem::exists(path("out.csv"))) << "half a result is none";
  }
  void expect_invalid(const std::string& json, const ::testing::Matcher<std::string>& message) {
    write_file("bad.json", json);
    for (const std::string command : {"validate", "run"}) {
      const Result result = run({command, "--config", path("bad.json")});
      EXPECT_EQ(result.exit_code, ExitCode::kWrongSettings) << command;
      EXPECT_THAT(result.err, AllOf(HasSubstr("bad.json"), message));
    }
  }
};

constexpr const char* kHeader = "timestamp_s,gyro_x_radps,gyro_y_radps,gyro_z_radps\n";

TEST_F(CommandLine, WrongUsageIsExitCode2) {
  EXPECT_EQ(run({}).exit_code, ExitCode::kWrongUsage);
  EXPECT_EQ(run({"denoice"}).exit_code, ExitCode::kWrongUsage);
  EXPECT_EQ(run({"denoise"}).exit_code, ExitCode::kWrongUsage);
  EXPECT_EQ(
      run({"denoise", path("in.csv"), "-o", path("out.csv"), "--method", "paper", "--estimate", "realtime"})
          .exit_code,
      ExitCode::kWrongUsage)
      << "the paper's method has no estimate without look-ahead";
  EXPECT_EQ(run({"replay", "x.csv", "--sensor", "imu", "--speed", "fast"}).exit_code, ExitCode::kWrongUsage);
  EXPECT_EQ(run({"replay", "x.csv", "--sensor", "imu", "--batch", "0"}).exit_code, ExitCode::kWrongUsage);
}

TEST_F(CommandLine, AnUnknownCommandIsNamedBesideThoseThatAre) {
  const Result result = run({"denoice", "in.csv"});
  EXPECT_EQ(result.exit_code, ExitCode::kWrongUsage);
  EXPECT_THAT(result.err,
              AllOf(HasSubstr("'denoice'"), HasSubstr("run validate denoise"), HasSubstr("simulate")));
}

TEST_F(CommandLine, AFlagOutOfItsRangeIsNamedWithItsValueAndTheRange) {
  Result result = run({"simulate", "-o", path("out.csv"), "--bias", "nan"});
  EXPECT_EQ(result.exit_code, ExitCode::kWrongUsage);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--bias"), HasSubstr("'nan'"), HasSubstr("expected a number")));
  result = run({"simulate", "--batch", "1025"});
  EXPECT_EQ(result.exit_code, ExitCode::kWrongUsage);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--batch"), HasSubstr("'1025'"), HasSubstr("1 to 1024")));
}

TEST_F(CommandLine, AnEngineThatWouldNotBeHeardIsRefused) {
  Result result = run({"simulate", "-o", path("out.csv"), "--motion", "still", "--engine-tone", "2"});
  EXPECT_EQ(result.exit_code, ExitCode::kWrongUsage);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--engine-tone"), HasSubstr("--motion drive")));
  result = run({"simulate", "-o", path("out.csv"), "--motion", "drive", "--engine-tone", "2",
                "--engine-tone-hz", "50"});
  EXPECT_EQ(result.exit_code, ExitCode::kWrongUsage);
  EXPECT_THAT(result.err, AllOf(HasSubstr("--engine-tone-hz"), HasSubstr("50")));
}

TEST_F(CommandLine, HelpAndVersionAreExitCode0) {
  EXPECT_THAT(run({"--version"}).out, HasSubstr("gyrod 0."));
  for (const std::string command : {"run", "validate", "denoise", "decompose", "allan", "navigate", "report",
                                    "replay", "record", "simulate"}) {
    const Result help = run({command, "--help"});
    EXPECT_EQ(help.exit_code, ExitCode::kDone);
    EXPECT_THAT(help.out, HasSubstr("gyrod " + command)) << "help shows an example";
  }
}

TEST_F(CommandLine, ARecordingThatCannotBeUsedIsNamedWithTheReason) {
  expect_refused("", AllOf(HasSubstr("in.csv"), HasSubstr("empty")));
  expect_refused(kHeader, HasSubstr("in.csv"));
  expect_refused("a,b\n1,2\n", AllOf(HasSubstr("gyro_x"), HasSubstr("a")));
  expect_refused("timestamp_s,gyro_x_radps,gyro_y_radps\n0,1,2\n", HasSubstr("gyro_z"));
  expect_refused("timestamp_s,gyro_x_rpm,gyro_y_rpm,gyro_z_rpm\n0,1,2,3\n",
                 AllOf(HasSubstr("rpm"), HasSubstr("dps")));
  expect_refused(std::string(kHeader) + "0.00,1,2,3\n0.01,1,2x,3\n",
                 AllOf(HasSubstr("in.csv:3"), HasSubstr("2x")));
  expect_refused(std::string(kHeader) + "0.00,1,2,3\n0.01,1,2\n", HasSubstr("in.csv:3"));
}

TEST_F(CommandLine, BrokenRowsCanBeLeftOutAndAreCounted) {
  const Result result =
      denoise(std::string(kHeader) + "0.00,1,2,3\n0.01,1,2x,3\n0.02,1,2,3\n", {"--skip-broken-rows"});
  EXPECT_EQ(result.exit_code, ExitCode::kDone);
  EXPECT_THAT(result.err, HasSubstr("1 broken row"));
  EXPECT_EQ(columns_of(path("out.csv"), {"timestamp_s"}).size(), 2U);
}

TEST_F(CommandLine, MissingInputAndUnwritableOutputAreNamed) {
  Result result = run({"denoise", path("none.csv"), "-o", path("out.csv")});
  EXPECT_EQ(result.exit_code, ExitCode::kFileTrouble);
  EXPECT_THAT(result.err, HasSubstr("none.csv"));
  write_file("in.csv", noisy_recording(10));
  result = run({"denoise", path("in.csv"), "-o", path("no/such/folder/out.csv")});
  EXPECT_EQ(result.exit_code, ExitCode::kFileTrouble);
  EXPECT_THAT(result.err, HasSubstr("no/such/folder"));
  result =
      run({"denoise", path("in.csv"), "-o", path("out.csv"), "--summary", path("no/such/folder/s.json")});
  EXPECT_EQ(result.exit_code, ExitCode::kFileTrouble);
}

TEST_F(CommandLine, ShortAndDegenerateRecordingsComeOutWhole) {
  const auto rows = [](std::size_t count, const std::string& rate) {
    std::string text = kHeader;
    for (std::size_t n = 0; n < count; ++n)
      text += std::to_string(n) + "e-2," + rate + "," + rate + "," + rate + "\n";
    return text;
  };
  for (std::size_t count = 1; count <= 8; ++count) {
    ASSERT_EQ(denoise(rows(count, "0.25")).exit_code, ExitCode::kDone) << count;
    EXPECT_EQ(columns_of(path("out.csv"), {"gyro_x_radps"}), std::vector<std::string>(count, "0.25"));
  }
  ASSERT_EQ(denoise(rows(2000, "0")).exit_code, ExitCode::kDone);
  EXPECT_EQ(columns_of(path("out.csv"), {"gyro_z_radps"}), std::vector<std::string>(2000, "0"));
  ASSERT_EQ(denoise(rows(2000, "0.5")).exit_code, ExitCode::kDone);
  EXPECT_EQ(columns_of(path("out.csv"), {"gyro_z_radps"}), std::vector<std::string>(2000, "0.5"));
  const Result refused = denoise(rows(100, "nan"));
  EXPECT_EQ(refused.exit_code, ExitCode::kIncomplete) << "nothing was denoised, though every row is there";
  EXPECT_THAT(refused.err, HasSubstr("100 samples refused and kept as they were: not_finite"));
  EXPECT_EQ(columns_of(path("out.csv"), {"gyro_z_radps"}).size(), 100U);
}

TEST_F(CommandLine, WhatTheSampleRateIsTakenForIsSaid) {
  const std::string stamped = std::string(kHeader) + "0,0,0,0\n0.01,0,0,0\n";
  EXPECT_THAT(denoise(stamped).err, Not(HasSubstr("--rate")));
  EXPECT_THAT(denoise(stamped, {"--rate", "50"}).err, HasSubstr("--rate is not used"));
  const std::string bare = "gyro_x_radps,gyro_y_radps,gyro_z_radps\n0,0,0\n0,0,0\n";
  EXPECT_THAT(denoise(bare).err, HasSubstr("no time column: taken at 100 Hz"));
  EXPECT_THAT(denoise(bare, {"--rate", "50"}).err, Not(HasSubstr("taken at")));
}

TEST_F(CommandLine, ACountThatIsNoneComesWithWhatIsExpected) {
  const Result half = run({"simulate", "--samples", "1.5"});
  EXPECT_EQ(half.exit_code, ExitCode::kWrongUsage);
  EXPECT_THAT(half.err, HasSubstr("--samples: '1.5' given; expected a whole number from 1 to "));
  EXPECT_THAT(run({"replay", "x.csv", "--sensor", "imu", "--domain", "-1"}).err,
              HasSubstr("--domain: '-1' given; expected a whole number from 0 to 230"));
}

TEST_F(CommandLine, UnitAndOtherColumnsAreKept) {
  std::string text = "sample,temp_c,gyro_x_dps,gyro_y_dps,gyro_z_dps,note\n";
  for (int n = 0; n < 200; ++n) text += std::to_string(n) + ",21.50,0.1,0.2,0.3,\"a,b\"\n";
  ASSERT_EQ(denoise(text).exit_code, ExitCode::kDone);
  const std::string out = read_file("out.csv");
  EXPECT_TRUE(out.starts_with("sample,temp_c,gyro_x_dps,gyro_y_dps,gyro_z_dps,note\n0,21.50,"));
  EXPECT_THAT(out, HasSubstr(",\"a,b\"\n199,21.50,"));
}

TEST_F(CommandLine, AWrongConfigurationIsReportedInFull) {
  expect_invalid("{\"bus\": }", HasSubstr("line 1"));
  expect_invalid(R"({"denoise": {"hop_sample": 3}})",
                 AllOf(HasSubstr("hop_sample"), HasSubstr("hop_samples")));
  expect_invalid(R"({"workers": "two"})",
                 AllOf(HasSubstr("workers"), HasSubstr("two"), HasSubstr("integer")));
  expect_invalid(R"({"denoise": {"window_samples": 3}, "limits": {"max_delay_s": 0}})",
                 AllOf(HasSubstr("window_samples is 3"), HasSubstr("max_delay_s is 0")));
  EXPECT_EQ(run({"validate", "--config", path("none.json")}).exit_code, ExitCode::kWrongSettings);
}

TEST_F(CommandLine, TheReferenceConfigurationIsValid) {
  const std::string reference = std::string(std::getenv("GYROD_SOURCE_DIR")) + "/config/gyrod.json";
  EXPECT_EQ(run({"validate", "--config", reference}).exit_code, ExitCode::kDone);
}

TEST_F(CommandLine, ABusyPortIsNamed) {
  const auto daemon = start_daemon();
  const std::string port = std::to_string(port_of(*daemon));
  write_file("busy.json", R"({"monitor": {"port": )" + port + "}}");
  const Result result = run({"run", "--config", path("busy.json")});
  EXPECT_EQ(result.exit_code, ExitCode::kUnavailable);
  EXPECT_THAT(result.err, AllOf(HasSubstr(port), HasSubstr("in use")));
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

TEST_F(CommandLine, ReplayWithoutAReaderSaysWhereItLooked) {
  write_file("in.csv", noisy_recording(10));
  const std::string domain = std::to_string(domain_id());
  const Result result =
      run({"replay", path("in.csv"), "--sensor", "imu", "--wait", "0.2", "--domain", domain});
  EXPECT_EQ(result.exit_code, ExitCode::kIncomplete);
  EXPECT_THAT(result.err, AllOf(HasSubstr("gyro/raw"), HasSubstr("domain " + domain)));
}

TEST_F(CommandLine, RecordTellsOfMissingSamplesInItsExitCode) {
  std::string text = "sequence,stamp_ns,gyro_x_radps,gyro_y_radps,gyro_z_radps\n";
  for (int n = 0; n < 100; ++n) {
    if (n < 50 || n >= 53) text += std::to_string(n) + "," + std::to_string(n * 10'000'000LL) + ",0,0,0\n";
  }
  write_file("gap.csv", text);
  const auto daemon = start_daemon();
  const auto recorder = start_recorder("out.csv", {"--until-end"});
  ASSERT_EQ(run_on_bus({"replay", path("gap.csv"), "--sensor", "imu", "--speed", "max"}).exit_code,
            ExitCode::kDone);
  EXPECT_EQ(recorder->wait(), ExitCode::kIncomplete);
  EXPECT_THAT(recorder->err(),
              HasSubstr("sensor 'imu': 3 samples missing in 1 gaps of the sequence, the first after 49"));
  EXPECT_EQ(columns_of(path("out.csv"), {"sequence"}).size(), 97U) << "what came is written all the same";
  EXPECT_EQ(stop_daemon(*daemon), 0);
}

}  // namespace
}  // namespace gyrod::testing
