// What is kept of a sensor's noise, and of how many.
#include "app/noise_sources.hpp"

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyrod {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Key;
using ::testing::Not;
using ::testing::SizeIs;

/// Learners as an engine's channels have them, at 100 Hz.
class NoiseSourcesTest : public ::testing::Test {
 protected:
  explicit NoiseSourcesTest(settings::NoiseStates remembered = {})
      : noise_(settings::NoiseSettings{}, std::move(remembered)) {
    options_.sample_rate_hz = 100.0;
    noise_.attach_to(options_, true);
  }
  [[nodiscard]] std::unique_ptr<stream::NoiseLearner> open(const std::string& sensor) const {
    return options_.learner(sensor);
  }
  /// White noise of 0.006 rad/s for so many samples: what is learned from comes after 15 s.
  static void rest(stream::NoiseLearner& learner, int samples) {
    std::mt19937_64 bits(7);  // NOLINT(cert-msc51-cpp): the same each time
    std::normal_distribution<double> normal(0.0, 0.006);
    for (int n = 0; n < samples; ++n) {
      stream::Sample sample;
      for (double& rate : sample.rate_radps) rate = normal(bits);
      learner.step(sample, true, 100.0);
      static_cast<void>(learner.update());
    }
  }

  app::NoiseSources noise_;
  stream::EngineOptions options_;
};

TEST_F(NoiseSourcesTest, NothingStaysOfSensorsThatCameAndWentAndTaughtNothing) {
  for (int i = 0; i < 100; ++i) rest(*open("gone" + std::to_string(i)), 300);
  EXPECT_THAT(noise_.learned(), IsEmpty());
  EXPECT_EQ(noise_.revision(), 0U);
}

TEST_F(NoiseSourcesTest, WhatWasLearnedOutlivesTheChannelAndIsGoneOnWithWhenTheSensorIsBack) {
  auto learner = open("front");
  EXPECT_THAT(noise_.learned(), Not(Contains(Key("front"))));
  rest(*learner, 6000);
  learner.reset();  // forgotten
  const auto first = noise_.learned();
  ASSERT_THAT(first, Contains(Key("front")));
  EXPECT_NEAR(std::sqrt(core::noise_variance(first.at("front").models[0])), 0.006, 2e-4) << "1 % by a minute";
  EXPECT_EQ(options_.noise("front").source, stream::NoiseSource::kStandstill);

  learner = open("front");
  rest(*learner, 6000);
  const auto second = noise_.learned();
  EXPECT_THAT(second, SizeIs(1));
  EXPECT_GT(second.at("front").rest_seconds, first.at("front").rest_seconds + 30.0);
}

class RememberedNoiseTest : public NoiseSourcesTest {
 protected:
  static constexpr int kMany = 200;
  RememberedNoiseTest() : NoiseSourcesTest(many()) {}
  static settings::NoiseStates many() {
    settings::NoiseStates states;
    for (int i = 0; i < kMany; ++i) {
      stream::RememberedNoise& state = states[std::to_string(i)];
      state.sample_rate_hz = 100.0;
      state.rest_seconds = 60.0 + i;
      state.segments = 30.0;
      state.models.fill(core::white_noise(3.6e-5));
    }
    return states;
  }
};

TEST_F(RememberedNoiseTest, WhatIsRememberedOfManySensorsIsAllToldAndLearningReplacesItsOwn) {
  const settings::NoiseStates told = noise_.learned();
  ASSERT_THAT(told, SizeIs(kMany));
  for (const auto& [sensor, state] : told) EXPECT_EQ(state.rest_seconds, 60.0 + std::stoi(sensor)) << sensor;
  rest(*open("7"), 6000);
  const settings::NoiseStates later = noise_.learned();
  ASSERT_THAT(later, SizeIs(kMany));
  for (const auto& [sensor, state] : later)
    EXPECT_EQ(state.rest_seconds != told.at(sensor).rest_seconds, sensor == "7") << sensor;
}

}  // namespace
}  // namespace gyrod
