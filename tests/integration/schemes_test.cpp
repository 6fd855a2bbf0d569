/// Schemes, whole records and decomposing at the command line.
#include <cmath>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/exit_code.hpp"
#include "rig.hpp"
#include "support/eventually.hpp"

namespace gyrod::testing {
namespace {

using app::ExitCode;
using ::testing::HasSubstr;

class Schemes : public Rig {
 protected:
  Schemes() { write_file("in.csv", noisy_recording(3000)); }

  std::string denoised(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"denoise", path("in.csv"), "-o", path("out.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Result result = run(arguments);
    EXPECT_EQ(result.exit_code, ExitCode::kDone) << result.err;
    return read_file("out.csv");
  }
  /// Whether OUT holds the numbers of IN.
  bool is_the_input() const {
    bool same = true;
    for (const std::string name : {"gyro_x_radps", "gyro_y_radps", "gyro_z_radps"})
      same = same && column("out.csv", name) == column("in.csv", name);
    return same;
  }
  std::vector<double> column(const std::string& file, const std::string& name) const {
    std::vector<double> values;
    for (const std::string& text : columns_of(path(file), {name})) values.push_back(std::stod(text));
    return values;
  }
};

TEST_F(Schemes, RawGivesTheInputAndImprovedIsThePapersDefault) {
  for (const std::vector<std::string>& mode : {std::vector<std::string>{}, {"--batch"}}) {
    std::vector<std::string> raw = mode;
    raw.insert(raw.end(), {"--scheme", "raw"});
    denoised(raw);
    EXPECT_TRUE(is_the_input()) << "the text may be another, the numbers are not";
    std::vector<std::string> improved = mode;
    improved.insert(improved.end(), {"--scheme", "improved"});
    std::vector<std::string> paper = mode;
    paper.insert(paper.end(), {"--method", "paper"});
    EXPECT_TRUE(denoised(improved) == denoised(paper)) << "a scheme implies method paper";
  }
}

TEST_F(Schemes, EachIsAnotherAndBatchIsAnotherThanWindowed) {
  std::vector<std::string> outputs;
  for (const std::string scheme : {"raw", "direct", "emd", "acf-emd", "improved"}) {
    outputs.push_back(denoised({"--scheme", scheme, "--screening", "windowed"}));
    if (scheme != "raw")
      outputs.push_back(denoised({"--scheme", scheme, "--batch", "--screening", "windowed"}));
  }
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(outputs[i] == outputs[j]) << i << " " << j;
  }
}

TEST_F(Schemes, TheConfigurationNamesOneAndTheFlagWins) {
  write_file("direct.json", R"({"denoise": {"method": "paper", "scheme": "direct"}})");
  const std::string direct = denoised({"--scheme", "direct"});
  EXPECT_TRUE(denoised({"--config", path("direct.json")}) == direct);
  denoised({"--config", path("direct.json"), "--scheme", "raw"});
  EXPECT_TRUE(is_the_input());
}

TEST_F(Schemes, ABatchSummaryTellsSchemeModelsAndImfs) {
  denoised({"--batch", "--summary", path("s.json")});
  std::string summary = read_file("s.json");
  for (const char* text : {"\"scheme\": \"improved\"", "\"mode\": \"batch\"", "\"screening\": \"paper\"",
                           "\"models\": \"identified\"", "\"acf_variance\"", "\"class\": \"signal\""}) {
    EXPECT_THAT(summary, HasSubstr(text));
  }
  denoised({"--batch", "--scheme", "direct", "--models", "ar", "--summary", path("s.json")});
  summary = read_file("s.json");
  EXPECT_THAT(summary, HasSubstr("\"models\": \"ar\""));
  EXPECT_THAT(summary, HasSubstr("\"family\": \"AR\""));
  denoised({"--scheme", "emd", "--summary", path("s.json")});
  EXPECT_THAT(read_file("s.json"), HasSubstr("\"mode\": \"windowed\""));
}

TEST_F(Schemes, ABatchScreensAsConfiguredAndElseAsThePaper) {
  const auto screening_of = [this](const std::string& settings) {
    write_file("c.json", R"({"denoise": {"method": "paper")" + settings + "}}");
    denoised({"--batch", "--config", path("c.json"), "--summary", path("s.json")});
    return read_file("s.json");
  };
  EXPECT_THAT(screening_of(""), HasSubstr("\"screening\": \"paper\""));
  EXPECT_THAT(screening_of(R"(, "screening": "windowed")"), HasSubstr("\"screening\": \"windowed\""))
      << "its default, but given";
  EXPECT_THAT(screening_of(R"(, "screening": "significance")"), HasSubstr("\"screening\": \"significance\""));
}

TEST_F(Schemes, ASummaryOfMethodJointNamesNone) {
  denoised({"--summary", path("s.json")});
  for (const char* text : {"\"method\": \"joint\"", "\"scheme\": null", "\"screening\": null"})
    EXPECT_THAT(read_file("s.json"), HasSubstr(text));
}

TEST_F(Schemes, WrongNamesAreWrongUsage) {
  const std::vector<std::string> start = {"denoise", path("in.csv"), "-o", path("out.csv")};
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--scheme", "best"},
                                               {"--screening", "none"},
                                               {"--models", "ar"},
                                               {"--batch", "--models", "ma"},
                                               {"--method", "joint", "--scheme", "emd"},
                                               {"--method", "joint", "--batch"},
                                               {"--method", "kalman"},
                                               {"--estimate", "realtime", "--method", "paper"}}) {
    std::vector<std::string> arguments = start;
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run(arguments).exit_code, ExitCode::kWrongUsage) << more.back();
  }
}

TEST_F(Schemes, DegenerateRecordsComeOutWholeInEveryScheme) {
  for (const int size : {1, 8, 15, 16, 40, 200}) {
    std::string text = "timestamp_s,gyro_x_radps,gyro_y_radps,gyro_z_radps\n";
    for (int n = 0; n < size; ++n) text += std::to_string(n) + "e-2,0.5,0.25,-1\n";
    write_file("in.csv", text);
    for (const std::string scheme : {"direct", "emd", "acf-emd", "improved"})
      EXPECT_EQ(denoised({"--batch", "--scheme", scheme}), text) << scheme << " " << size;
  }
}

class Decompose : public Schemes {};

// Completeness: numbers are written with all their bits, and adding up 12 of them rounds 12 times.
TEST_F(Decompose, ColumnsAddUpToTheInput) {
  const Result result =
      run({"decompose", path("in.csv"), "-o", path("imfs.csv"), "--summary", path("s.json")});
  ASSERT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  for (const std::string axis : {"x", "y", "z"}) {
    const std::string file = "imfs_" + axis + ".csv";
    const std::string header = read_file(file).substr(0, read_file(file).find('\n'));
    EXPECT_TRUE(header.starts_with("time_s,imf_1,imf_2,"));
    EXPECT_TRUE(header.ends_with(",residue"));
    std::vector<double> sum = column(file, "residue");
    for (int imf = 1; header.find("imf_" + std::to_string(imf) + ",") != std::string::npos; ++imf) {
      const auto mode = column(file, "imf_" + std::to_string(imf));
      for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += mode[n];
    }
    const auto input = column("in.csv", "gyro_" + axis + "_radps");
    ASSERT_EQ(sum.size(), input.size());
    for (std::size_t n = 0; n < sum.size(); ++n) ASSERT_NEAR(sum[n], input[n], 1e-15) << axis << n;
  }
  for (const char* text :
       {"\"j\"", "\"k\"", "\"pcc\"", "\"mean_period_samples\"", "\"energy_rad2ps2\"", "\"unit\": \"radps\""})
    EXPECT_THAT(read_file("s.json"), HasSubstr(text));
}

TEST_F(Decompose, OneAxisGoesToTheFileItself) {
  ASSERT_EQ(run({"decompose", path("in.csv"), "-o", path("z.csv"), "--axis", "z", "--unit", "dps"}).exit_code,
            0);
  ASSERT_EQ(run({"decompose", path("in.csv"), "-o", path("all.csv.gz")}).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(path("z_z.csv")));
  EXPECT_TRUE(std::filesystem::exists(path("all_x.csv.gz")));
  const auto residue = column("z.csv", "residue");
  EXPECT_EQ(residue.size(), 3000U);
  const Result out = run({"decompose", path("in.csv"), "-o", "-", "--axis", "z"});
  EXPECT_THAT(out.out, HasSubstr("time_s,imf_1"));
}

TEST_F(Decompose, SaysWhatIsWrong) {
  Result result = run({"decompose", path("in.csv"), "-o", "-"});
  EXPECT_EQ(result.exit_code, ExitCode::kWrongUsage);
  EXPECT_THAT(result.err, HasSubstr("--axis"));
  EXPECT_EQ(run({"decompose", path("in.csv"), "-o", path("o.csv"), "--sifts", "0"}).exit_code,
            ExitCode::kWrongUsage);
  EXPECT_EQ(run({"decompose", path("in.csv"), "-o", path("o.csv"), "--axis", "w"}).exit_code,
            ExitCode::kWrongUsage);
  write_file("no_time.csv", "gyro_x_dps,gyro_y_dps\n1,2\n2,3\n");
  result = run({"decompose", path("no_time.csv"), "-o", path("o.csv"), "--axis", "x"});
  EXPECT_EQ(result.exit_code, ExitCode::kFileTrouble);
  EXPECT_THAT(result.err, HasSubstr("--rate"));
  result = run({"decompose", path("no_time.csv"), "-o", path("o.csv"), "--axis", "z", "--rate", "100"});
  EXPECT_EQ(result.exit_code, ExitCode::kFileTrouble);
  EXPECT_THAT(result.err, HasSubstr("gyro_z"));
  EXPECT_EQ(run({"decompose", path("no_time.csv"), "-o", path("o.csv"), "--rate", "100"}).exit_code,
            ExitCode::kFileTrouble)
      << "a missing axis is an error unless it is allowed";
}

// Of one axis, whose analysis has no place to stop at: without the interrupt this takes seconds and ends well.
TEST_F(Decompose, AnInterruptEndsTheAnalysisAndLeavesNoFile) {
  ASSERT_EQ(run({"simulate", "--samples", "60000", "-o", path("long.csv")}).exit_code, ExitCode::kDone);
  const auto process = start({"decompose", path("long.csv"), "-o", path("modes.csv"), "--axis", "x"});
  const std::string part = path("modes.csv." + std::to_string(process->id()) + ".part");
  ASSERT_TRUE(eventually([&part] { return std::filesystem::exists(part); })) << process->err();
  process->signal(SIGINT);
  EXPECT_EQ(process->wait(), ExitCode::kInterrupted);
  EXPECT_THAT(process->err(), HasSubstr("interrupted"));
  EXPECT_FALSE(std::filesystem::exists(part));
  EXPECT_FALSE(std::filesystem::exists(path("modes.csv")));
}

}  // namespace
}  // namespace gyrod::testing
