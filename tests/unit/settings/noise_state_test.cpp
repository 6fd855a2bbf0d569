#include "settings/noise_state.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gyrod::settings {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

core::StandstillState example() {
  core::StandstillState state;
  state.sample_rate_hz = 100.0;
  state.rest_seconds = 812.5;
  state.segments = 234.375;
  state.bias = {0.1, -0.2, 0.3};
  state.bias_seconds = 600.0;
  for (auto& model : state.models) {
    model = core::white_noise(1e-5);
    model.colour_order = 8;
    model.colour = {0.3, -0.1, 0.05, 0.0, 0.02, -0.03, 0.01, 0.1};
    model.colour_variance = 2e-5;
  }
  return state;
}

NoiseStates two_sensors() { return {{"front", example()}, {"rear/2", example()}}; }

std::string complaint(const std::string& text) {
  try {
    static_cast<void>(parse_noise_state("state.json", text));
  } catch (const NoiseFileError& error) {
    return error.what();
  }
  return "none";
}

TEST(NoiseState, ComesBackFromItsText) {
  const NoiseStates after = parse_noise_state("state.json", noise_state_text(two_sensors()));
  ASSERT_EQ(after.size(), 2U);
  const core::StandstillState& state = after.at("rear/2");
  EXPECT_EQ(state.rest_seconds, 812.5);
  EXPECT_EQ(state.segments, 234.375);
  EXPECT_EQ(state.bias, example().bias);
  EXPECT_EQ(state.models[2].colour, example().models[2].colour);
  // A root and its square: two roundings.
  EXPECT_NEAR(state.models[2].white_variance, 1e-5, 1e-20);
}

TEST(NoiseState, KeepsAllanSumsToTheBit) {
  stream::RememberedNoise state = example();
  core::OnlineAllan estimator;
  for (int n = 0; n < 1000; ++n) estimator.step(0.1 * std::sin(n * n));
  state.curves[0] = state.curves[2] = estimator.sums();
  const auto after = parse_noise_state("state.json", noise_state_text({{"a", state}})).at("a");
  EXPECT_EQ(after.curves, state.curves);
}

TEST(NoiseState, ReadsTheVersionBeforeAllanSums) {
  json document = json::parse(noise_state_text({{"front", example()}}));
  document["gyrod_noise_state"] = 1;
  document["sensors"]["front"].erase("allan");
  const auto after = parse_noise_state("state.json", document.dump()).at("front");
  EXPECT_EQ(after.rest_seconds, 812.5);
  EXPECT_EQ(after.curves, stream::AllanCurves{});
}

TEST(NoiseState, SaysWhichAllanSumsCannotBe) {
  const auto with = [](const json& curve) {
    json document = json::parse(noise_state_text({{"front", example()}}));
    document["sensors"]["front"]["allan"]["x"] = curve;
    return complaint(document.dump());
  };
  EXPECT_EQ(with({{"terms", {9, 8}}, {"squares_rad2ps2", {1.0, 0.5}}}), "none");
  EXPECT_THAT(with({{"terms", {9, 8.5}}, {"squares_rad2ps2", {1.0, 0.5}}}),
              HasSubstr("expected whole numbers"));
  EXPECT_THAT(with({{"terms", {9, 8}}, {"squares_rad2ps2", {1.0}}}), HasSubstr("expected as many numbers"));
  EXPECT_THAT(with({{"terms", {8, 9}}, {"squares_rad2ps2", {1.0, 0.5}}}),
              HasSubstr("expected fewer for longer"));
  EXPECT_THAT(with({{"terms", {9}}, {"squares_rad2ps2", {-1.0}}}), HasSubstr("squares of 0 and more"));
}

TEST(NoiseState, TakesWhatALearnerGivesAndALearnerTakesIt) {
  std::mt19937_64 bits(5);
  std::normal_distribution<double> normal(0.0, 0.005);
  core::StandstillLearner learner(100.0);
  for (int n = 0; n < 6000; ++n) learner.step({normal(bits), normal(bits), 0.0});
  const auto states = parse_noise_state("state.json", noise_state_text({{"a", learner.state()}}));
  core::StandstillLearner after(100.0);
  EXPECT_TRUE(after.restore(states.at("a")));
  EXPECT_NEAR(core::noise_variance(after.models()[0]), core::noise_variance(learner.models()[0]), 1e-17);
  EXPECT_FALSE(core::is_usable(after.models()[2])) << "the axis that never changed";
}

TEST(NoiseState, LeavesOutWhoHasLearnedNothing) {
  core::StandstillState nothing;
  nothing.sample_rate_hz = 100.0;
  EXPECT_TRUE(parse_noise_state("state.json", noise_state_text({{"a", nothing}})).empty());
}

TEST(NoiseState, TruncatedAnywhereIsAnError) {
  const std::string text = noise_state_text(two_sensors());
  for (std::size_t size = 0; size + 2 < text.size(); ++size)
    EXPECT_NE(complaint(text.substr(0, size)), "none") << size;
}

TEST(NoiseState, GarbageIsAnError) {
  std::mt19937 bits(7);
  for (int round = 0; round < 50; ++round) {
    std::string text(1000, '\0');
    for (char& c : text) c = static_cast<char>(bits());
    EXPECT_THAT(complaint(text), HasSubstr("state.json: "));
  }
  const std::string good = noise_state_text(two_sensors());
  for (int round = 0; round < 2000; ++round) {
    std::string text = good;
    text[bits() % text.size()] = static_cast<char>(bits());
    static_cast<void>(complaint(text));  // an error or a state, never a crash
  }
}

TEST(NoiseState, SaysWhatDoesNotFit) {
  const json good = json::parse(noise_state_text({{"front", example()}}));
  json document = good;
  document["gyrod_noise_state"] = 3;
  EXPECT_EQ(complaint(document.dump()),
            "state.json: gyrod_noise_state is 3; expected 1 to 2, the versions that this gyrod knows");
  document = good;
  document["sensors"]["front"]["segments"] = nullptr;  // what a NaN is written as
  EXPECT_EQ(complaint(document.dump()),
            "state.json: sensors.front.segments is null; expected a number above 0");
  document = good;
  document["sensors"]["front"]["bias_radps"] = {1, 2};
  EXPECT_EQ(complaint(document.dump()),
            "state.json: sensors.front.bias_radps is [1,2]; expected a list of 3 numbers");
  document = good;
  document["sensors"]["front"]["axes"]["x"]["colour"] = {2};
  EXPECT_THAT(complaint(document.dump()), HasSubstr("expected coefficients of a stable model"));
  document = good;
  document["sensors"]["two words"] = document["sensors"]["front"];
  EXPECT_THAT(complaint(document.dump()), HasSubstr("sensors.two words is "));
  EXPECT_THAT(complaint("{\"gyrod_noise_state\": 1, \"sensors\": {\"a\": {\"segments\": NaN}}}"),
              HasSubstr("line 1, column"));
}

}  // namespace
}  // namespace gyrod::settings
