#include "settings/noise_calibration.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/noise/noise_units.hpp"
#include "support/scratch_folder.hpp"

namespace gyrod::settings {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

NoiseCalibration example() {
  NoiseCalibration calibration;
  calibration.sensor_id = "front";
  calibration.sample_rate_hz = 100.0;
  for (auto& model : calibration.models) {
    model = core::white_noise(1e-5);
    model.colour_order = 2;
    model.colour = {0.5, -0.25};
    model.colour_variance = 3e-6;
    model.line_count = 1;
    model.line[0] = {.cycles = 0.2, .half_width = 0.003, .variance = 4e-6};
  }
  calibration.bias_radps = {0.001, -0.002, 0.003};
  calibration.origin = {.source = "still.csv.gz", .first_stamp_s = 1.7e9, .still_s = 58.9};
  return calibration;
}

json example_json() { return json::parse(calibration_text(example())); }

std::string complaint(const json& document) {
  try {
    static_cast<void>(parse_calibration("cal.json", document.dump()));
  } catch (const NoiseFileError& error) {
    return error.what();
  }
  return "none";
}

TEST(NoiseCalibration, ComesBackFromItsText) {
  const NoiseCalibration before = example();
  const NoiseCalibration after = parse_calibration("cal.json", calibration_text(before));
  EXPECT_EQ(after.sensor_id, before.sensor_id);
  EXPECT_EQ(after.sample_rate_hz, before.sample_rate_hz);
  EXPECT_EQ(after.bias_radps, before.bias_radps);
  EXPECT_EQ(after.origin.source, before.origin.source);
  EXPECT_EQ(after.origin.first_stamp_s, before.origin.first_stamp_s);
  EXPECT_EQ(after.origin.still_s, before.origin.still_s);
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_EQ(after.models[a].colour, before.models[a].colour);
    // A root and its square: two roundings.
    EXPECT_NEAR(after.models[a].white_variance, before.models[a].white_variance, 1e-20);
    EXPECT_NEAR(after.models[a].colour_variance, before.models[a].colour_variance, 1e-20);
    ASSERT_EQ(after.models[a].line_count, 1U);
    EXPECT_EQ(after.models[a].line[0].cycles, 0.2);
    EXPECT_EQ(after.models[a].line[0].half_width, 0.003);
    EXPECT_NEAR(after.models[a].line[0].variance, 4e-6, 1e-20);
  }
}

TEST(NoiseCalibration, GivesFiguresInTheUnitsOfDataSheets) {
  NoiseCalibration calibration = example();
  calibration.models[0] = core::from_noise_density(0.05 * std::numbers::pi / 180.0, 100.0);
  const json figures = json::parse(calibration_text(calibration)).at("figures").at("x");
  EXPECT_NEAR(figures.at("noise_density_dps_per_sqrt_hz").get<double>(), 0.05, 1e-12);
  EXPECT_NEAR(figures.at("std_dps").get<double>(), 0.05 * std::sqrt(50.0), 1e-12);
  EXPECT_NEAR(figures.at("arw_deg_per_sqrt_h").get<double>(), 60.0 * 0.05 / std::numbers::sqrt2, 1e-12);
}

TEST(NoiseCalibration, HoldsTheAxesThatThereAre) {
  NoiseCalibration calibration = example();
  calibration.models[1] = {};
  const NoiseCalibration after = parse_calibration("cal.json", calibration_text(calibration));
  EXPECT_TRUE(core::is_usable(after.models[0]));
  EXPECT_FALSE(core::is_usable(after.models[1]));
}

TEST(NoiseCalibration, SaysWhatDoesNotFit) {
  json document = example_json();
  document["axes"]["x"]["white_std_radps"] = -1;
  EXPECT_EQ(complaint(document), "cal.json: axes.x.white_std_radps is -1; expected a number above 0");
  document = example_json();
  document["axes"]["y"].erase("white_std_radps");
  EXPECT_EQ(complaint(document), "cal.json: axes.y.white_std_radps is missing; expected a number above 0");
  document = example_json();
  document["axes"]["z"]["colour"] = {1.5};
  EXPECT_EQ(complaint(document), "cal.json: axes.z.colour is [1.5]; expected coefficients of a stable model");
  document = example_json();
  document["axes"]["z"]["colour"] = json::array({0, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_THAT(complaint(document), HasSubstr("expected a list of at most 8 numbers"));
  document = example_json();
  document["sample_rate_hz"] = nullptr;
  EXPECT_EQ(complaint(document), "cal.json: sample_rate_hz is null; expected a number above 0");
  document = example_json();
  document["sensor"] = "front";
  EXPECT_EQ(complaint(document),
            "cal.json: unknown key sensor; expected one of gyrod_noise, sensor_id, sample_rate_hz, axes, "
            "figures, origin");
  document = example_json();
  document["sensor_id"] = "two words";
  EXPECT_THAT(complaint(document), HasSubstr("sensor_id is \"two words\"; expected 1 to 64 printable"));
  document = example_json();
  document["axes"] = json::object();
  EXPECT_EQ(complaint(document), "cal.json: axes is {}; expected the noise of one axis at least");
}

TEST(NoiseCalibration, SaysWhatIsWrongWithALine) {
  json document = example_json();
  document["axes"]["x"]["lines"][0]["cycles_per_sample"] = 0.5;
  EXPECT_EQ(
      complaint(document),
      "cal.json: axes.x.lines.0.cycles_per_sample is 0.5; expected a number below 0.5, half the sample rate");
  document = example_json();
  document["axes"]["x"]["lines"][0].erase("std_radps");
  EXPECT_EQ(complaint(document), "cal.json: axes.x.lines.0.std_radps is missing; expected a number above 0");
  document = example_json();
  document["axes"]["x"]["lines"].push_back(document["axes"]["x"]["lines"][0]);
  EXPECT_EQ(
      complaint(document),
      "cal.json: axes.x.lines.1.cycles_per_sample is 0.2; expected lines by frequency, the lowest first");
  document["axes"]["x"]["lines"][0]["std_radps"] = 1e-170;
  EXPECT_EQ(complaint(document),
            "cal.json: axes.x.lines.0.std_radps is 1e-170; expected a standard deviation above 0");
  document["axes"]["x"]["lines"][0] = 7;
  EXPECT_EQ(complaint(document), "cal.json: axes.x.lines.0 is 7; expected an object");
  document["axes"]["x"]["lines"] = json::array({{}, {}, {}, {}});
  EXPECT_THAT(complaint(document), HasSubstr("expected a list of at most 3 objects"));
  document["axes"]["x"].erase("lines");
  EXPECT_THAT(complaint(document), HasSubstr("figures.x.")) << "the figures are of all the noise";
}

TEST(NoiseCalibration, RefusesAnotherVersionAndAnotherFile) {
  json document = example_json();
  document["gyrod_noise"] = 2;
  EXPECT_EQ(complaint(document), "cal.json: gyrod_noise is 2; expected 1, the version that this gyrod knows");
  EXPECT_EQ(complaint(json::object()),
            "cal.json: gyrod_noise is missing; expected 1, the version that this gyrod knows");
  EXPECT_EQ(complaint(json::array()), "cal.json: the whole file is []; expected an object");
  EXPECT_THROW(static_cast<void>(parse_calibration("cal.json", "{\"gyrod_noise\": 1")), NoiseFileError);
}

TEST(NoiseCalibration, RefusesFiguresThatWereChangedWithoutTheModel) {
  json document = example_json();
  document["figures"]["x"]["std_dps"] = document["figures"]["x"]["std_dps"].get<double>() * 1.005;
  EXPECT_EQ(complaint(document), "none") << "rounded by hand";
  document["figures"]["x"]["std_dps"] = 5.0;
  EXPECT_THAT(complaint(document), HasSubstr("figures.x.std_dps is 5.0; expected 0."));
  EXPECT_THAT(complaint(document), HasSubstr("by the model under \"axes\", which is what counts"));
}

TEST(NoiseCalibrations, AreFoundBySensorThenForAll) {
  const testing::ScratchFolder folder;
  NoiseCalibration front = example();
  NoiseCalibration all = example();
  all.sensor_id.reset();
  folder.write("b.json", calibration_text(front));
  folder.write("a.json", calibration_text(all));
  folder.write("notes.txt", "not one of them");
  const auto calibrations = load_calibrations(folder.path());
  ASSERT_EQ(calibrations.size(), 2U);
  EXPECT_EQ(calibration_for(calibrations, "front"), &calibrations[1]);
  EXPECT_EQ(calibration_for(calibrations, "rear"), &calibrations[0]);
  const auto one = load_calibrations(folder.path("b.json"));
  EXPECT_EQ(calibration_for(one, "rear"), nullptr);
}

std::string complaint_of(const std::filesystem::path& path) {
  try {
    static_cast<void>(load_calibrations(path));
  } catch (const NoiseFileError& error) {
    return error.what();
  }
  return "none";
}

TEST(NoiseCalibrations, RefuseTwoFilesForOneSensor) {
  const testing::ScratchFolder folder;
  folder.write("a.json", calibration_text(example()));
  folder.write("b.json", calibration_text(example()));
  EXPECT_EQ(complaint_of(folder.path()),
            folder.path("b.json") + ": is for sensor front, as a.json is; expected one file each");
}

TEST(NoiseCalibrations, SayWhatCannotBeRead) {
  const testing::ScratchFolder folder;
  EXPECT_EQ(complaint_of(folder.path("none.json")), folder.path("none.json") + ": no such file");
  EXPECT_EQ(complaint_of(folder.path()),
            folder.path().string() + ": holds no file *.json; expected calibrations");
  folder.write("huge.json", std::string((1U << 20U) + 1, ' '));
  EXPECT_EQ(complaint_of(folder.path("huge.json")), folder.path("huge.json") + ": is larger than 1 MiB");
}

}  // namespace
}  // namespace gyrod::settings
