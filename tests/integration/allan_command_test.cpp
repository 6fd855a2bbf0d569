/// gyrod allan as a user runs it: the table, the files, and what it says of records that it cannot analyse.
#include <cmath>
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

constexpr double kRate = 50.0;
constexpr double kSampleStd = 0.2;  // deg/s; N = 0.2 / sqrt(50) deg/s/sqrt(Hz) = 1.697 deg/sqrt(h)

class AllanCommand : public Rig {
 protected:
  /// White noise on three gyros in deg/s, and on an accelerometer about z in g; without a time column.
  std::string white_recording(std::size_t samples) {
    std::mt19937_64 bits(11);
    std::normal_distribution<double> normal;
    std::ostringstream text;
    text << "gyro_x_dps,gyro_y_dps,gyro_z_dps,accel_z_g\n";
    for (std::size_t n = 0; n < samples; ++n) {
      for (int axis = 0; axis < 3; ++axis) text << kSampleStd * normal(bits) << ",";
      text << 1.0 + 1e-3 * normal(bits) << "\n";
    }
    write_file("in.csv", text.str());
    return path("in.csv");
  }
  Result allan(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"allan", path("in.csv")});
    return run(arguments);
  }
  void expect_failure(const std::vector<std::string>& arguments, ExitCode code,
                      const ::testing::Matcher<std::string>& message) {
    const Result result = allan(arguments);
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_THAT(result.err, message);
  }
};

TEST_F(AllanCommand, TableHoldsTheCoefficientInBothUnitsAndPerSample) {
  white_recording(40'000);
  const Result result = allan({"--rate", "50", "--unit", "dps"});
  ASSERT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("40000 samples, 50 Hz (--rate), 800 s"), HasSubstr("rad/s/sqrt(Hz)"),
                    HasSubstr("deg/sqrt(h)"), HasSubstr("deg/h^1.5"), HasSubstr("ug/sqrt(Hz)"),
                    HasSubstr("not observable"), HasSubstr("Allan deviation in deg/s"),
                    HasSubstr("68.27 % confidence"), HasSubstr("per sample at 50 Hz")));
  EXPECT_THAT(result.out, HasSubstr("1.7"));  // deg/sqrt(h), see kSampleStd
}

// White noise of known deviation: N within 3 %, twice the standard error that a fit of this length states.
TEST_F(AllanCommand, JsonHoldsTheTruthOfWhiteNoiseInAllUnits) {
  white_recording(40'000);
  ASSERT_EQ(allan({"--rate", "50", "--json", path("out.json")}).exit_code, ExitCode::kDone);
  const Json document = Json::parse(read_file("out.json"));
  const double radians = kSampleStd * std::acos(-1.0) / 180.0;
  for (const std::string channel : {"gyro_x", "gyro_y", "gyro_z"}) {
    const Json& gyro = document["channels"][channel];
    const Json& white = gyro["least_squares"]["angle_random_walk"];
    ASSERT_TRUE(white["observable"]);
    EXPECT_NEAR(white["si"]["value"].get<double>() * std::sqrt(kRate) / radians, 1.0, 0.03);
    EXPECT_EQ(white["si"]["unit"], "rad/s/sqrt(Hz)");
    EXPECT_NEAR(white["data_sheet"]["value"].get<double>() / (60.0 * kSampleStd / std::sqrt(kRate)), 1.0,
                0.03);
    EXPECT_NEAR(gyro["per_sample"]["white_noise_std_radps"].get<double>() / radians, 1.0, 0.03);
    EXPECT_TRUE(gyro["per_sample"]["random_walk_step_std_radps"].is_null());
    EXPECT_TRUE(gyro["least_squares"]["rate_random_walk"]["si"].is_null()) << "null, not 0";
  }
  const Json& vertical = document["channels"]["accel_z"];
  EXPECT_NEAR(vertical["mean_mps2"].get<double>(), 9.80665, 1e-3);
  EXPECT_NEAR(vertical["per_sample"]["white_noise_std_mps2"].get<double>(), 9.80665e-3, 3e-4);
}

TEST_F(AllanCommand, CsvAgreesWithJson) {
  white_recording(5'000);
  ASSERT_EQ(allan({"--rate", "50", "--json", path("out.json"), "--csv", path("out.csv")}).exit_code,
            ExitCode::kDone);
  const Json document = Json::parse(read_file("out.json"));
  const Json& points = document["channels"]["gyro_y"]["points"];
  const auto rows = columns_of(path("out.csv"), {"tau_s", "cluster_samples", "gyro_y_deviation_radps",
                                                 "gyro_y_upper_radps", "gyro_y_edf"});
  ASSERT_EQ(rows.size(), points.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::istringstream row(rows[i]);
    char comma = 0;
    double tau = 0.0;
    double size = 0.0;
    double deviation = 0.0;
    double upper = 0.0;
    double edf = 0.0;
    row >> tau >> comma >> size >> comma >> deviation >> comma >> upper >> comma >> edf;
    EXPECT_EQ(tau, points[i]["tau_s"].get<double>());
    EXPECT_EQ(size, points[i]["cluster_samples"].get<double>());
    EXPECT_EQ(deviation, points[i]["deviation_radps"].get<double>()) << "both hold every bit";
    EXPECT_EQ(upper, points[i]["upper_radps"].get<double>());
    EXPECT_EQ(edf, points[i]["edf"].get<double>());
  }
  EXPECT_EQ(points.back()["cluster_samples"], 447) << "10^2.65: the last of 20 a decade up to 500";
}

TEST_F(AllanCommand, LongGoesToHalfOfTheRecord) {
  white_recording(5'000);
  ASSERT_EQ(allan({"--rate", "50", "--long", "--json", path("out.json")}).exit_code, ExitCode::kDone);
  const Json document = Json::parse(read_file("out.json"));
  EXPECT_GT(document["channels"]["gyro_x"]["points"].back()["cluster_samples"], 2000);
}

TEST_F(AllanCommand, ImuYamlLeavesOutWhatIsNotObservable) {
  white_recording(40'000);
  ASSERT_EQ(allan({"--rate", "50", "--imu-yaml", path("imu.yaml")}).exit_code, ExitCode::kDone);
  const std::string yaml = read_file("imu.yaml");
  EXPECT_THAT(yaml,
              AllOf(HasSubstr("\ngyroscope_noise_density: "), HasSubstr("\naccelerometer_noise_density: "),
                    HasSubstr("\nupdate_rate: 50"), HasSubstr("\nrostopic: /imu0")));
  EXPECT_THAT(yaml, AllOf(HasSubstr("# gyroscope_random_walk: not observable"),
                          Not(HasSubstr("\ngyroscope_random_walk"))));
}

TEST_F(AllanCommand, PlotIsOnePictureWithACurveForEachAxis) {
  white_recording(5'000);
  ASSERT_EQ(allan({"--rate", "50", "--plot", path("out.svg")}).exit_code, ExitCode::kDone);
  const std::string svg = read_file("out.svg");
  EXPECT_THAT(svg, AllOf(HasSubstr("<svg xmlns"), HasSubstr("Allan deviation, rad/s"),
                         HasSubstr("Allan deviation, m/s^2"), Not(HasSubstr("nan")), Not(HasSubstr("inf,"))));
  std::size_t curves = 0;
  for (auto at = svg.find("class=\"curve\" points=\""); at != std::string::npos;
       at = svg.find("class=\"curve\" points=\"", at + 1)) {
    ++curves;
  }
  EXPECT_EQ(curves, 4U);
}

TEST_F(AllanCommand, ShowsWhatAShortOrConstantRecordingHas) {
  white_recording(200);
  Result result = allan({"--rate", "50", "--plot", path("out.svg")});
  EXPECT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  EXPECT_THAT(result.out, HasSubstr("Allan deviation in rad/s"));
  white_recording(5);
  result = allan({"--rate", "50", "--plot", path("out.svg"), "--imu-yaml", path("imu.yaml")});
  EXPECT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  EXPECT_THAT(result.out, HasSubstr("there is no coefficient to show"));
  std::string text = "timestamp_s,gyro_x_radps,gyro_y_radps,gyro_z_radps\n";
  for (int n = 0; n < 500; ++n) text += std::to_string(n) + "e-2,0.5,0,0\n";
  write_file("in.csv", text);
  result = allan({"--plot", path("out.svg")});
  EXPECT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  EXPECT_THAT(result.out, HasSubstr("there is no coefficient to show"));
}

TEST_F(AllanCommand, GapsAreToldAndTheLongestStretchIsTaken) {
  std::string text = "timestamp_s,gyro_x_radps,gyro_y_radps,gyro_z_radps\n";
  for (int n = 0; n < 900; ++n) {
    const int late = n < 300 ? 0 : 5000;
    const std::string rate = n == 600 ? "nan" : std::to_string(0.001 * (n * 37 % 11));
    text += std::to_string(n + late) + "e-2," + rate + "," + rate + "," + rate + "\n";
  }
  write_file("in.csv", text);
  const Result result = allan({});
  ASSERT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  EXPECT_THAT(result.out,
              AllOf(HasSubstr("600 samples, 100 Hz (by its stamps)"), HasSubstr("1 samples refused"),
                    HasSubstr("1 missing or refused samples bridged"), HasSubstr("1 gaps too long"),
                    HasSubstr("300 good samples left out")));
}

TEST_F(AllanCommand, OneAxisIsEnough) {
  std::string text = "timestamp_s,gyro_z_dps\n";
  for (int n = 0; n < 500; ++n) text += std::to_string(n) + "e-2," + std::to_string(n * 37 % 11) + "\n";
  write_file("in.csv", text);
  const Result result = allan({"--axis", "z"});
  EXPECT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("gyro_z"), Not(HasSubstr("gyro_x"))));
  expect_failure({"--axis", "x"}, ExitCode::kFileTrouble, HasSubstr("gyro_x"));
  expect_failure({}, ExitCode::kFileTrouble, HasSubstr("gyro_x"));
}

TEST_F(AllanCommand, AccelerometersWithLongHolesAreLeftOutWithANote) {
  std::string text = "timestamp_s,gyro_x_dps,gyro_y_dps,gyro_z_dps,accel_x_mps2,accel_y_mg\n";
  for (int n = 0; n < 500; ++n) {
    const std::string rate = std::to_string(n * 37 % 11);
    text += std::to_string(n) + "e-2," + rate + "," + rate + "," + rate + "," +
            (n > 100 && n < 200 ? "" : rate) + "," + (n % 50 == 7 ? "" : rate) + "\n";
  }
  write_file("in.csv", text);
  const Result result = allan({});
  EXPECT_EQ(result.exit_code, ExitCode::kDone) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("accel_x_mps2 is left out"), HasSubstr("\naccel_y\n")));
}

TEST_F(AllanCommand, WhatCannotBeDoneIsSaid) {
  white_recording(100);
  expect_failure({}, ExitCode::kFileTrouble, AllOf(HasSubstr("no time column"), HasSubstr("--rate")));
  expect_failure({"--rate", "50", "--axis", "w"}, ExitCode::kWrongUsage, HasSubstr("some of x, y and z"));
  expect_failure({"--rate", "50", "--axis", "xx"}, ExitCode::kWrongUsage, HasSubstr("some of x, y and z"));
  expect_failure({"--rate", "0"}, ExitCode::kWrongUsage, HasSubstr("--rate"));
  expect_failure({"--rate", "50", "--json", path("no/folder/x.json")}, ExitCode::kFileTrouble,
                 HasSubstr("no/folder"));
  expect_failure({"--rate", "50", "--json", path("a"), "--csv", path("a")}, ExitCode::kWrongUsage,
                 HasSubstr("--csv: is the same file as --json"));
  white_recording(2);
  expect_failure({"--rate", "50"}, ExitCode::kFileTrouble, HasSubstr("at least 3"));
  EXPECT_EQ(run({"allan", path("none.csv")}).exit_code, ExitCode::kFileTrouble);
}

}  // namespace
}  // namespace gyrod::testing
