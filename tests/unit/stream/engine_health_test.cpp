#include <atomic>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine_support.hpp"
#include "stream/engine.hpp"

namespace gyrod::stream {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Keeps what is told of health: "imu warming_up ok", "imu gone".
class HealthSink final : public RecordingSink {
 public:
  void on_health(std::string_view sensor, const SensorHealth& before,
                 const SensorHealth& now) noexcept override {
    events.push_back(std::string(sensor) + " " + std::string(name_of(before.state)) + " " +
                     std::string(name_of(now.state)));
  }
  void on_forgotten(std::string_view sensor) noexcept override {
    events.push_back(std::string(sensor) + " gone");
  }
  std::vector<std::string> events;
};

/// An engine whose time is the test's. Its window is 128 samples.
class EngineHealth : public ::testing::Test {
 protected:
  static EngineOptions options() {
    EngineOptions options = small_options();
    options.silent_after_s = 5.0;
    options.forget_after_s = 100.0;
    return options;
  }
  void at(double now_s) {
    now_s_ = now_s;
    engine_.tend();
    engine_.judge_health();
  }
  std::vector<std::string> news() { return std::exchange(sink_.events, {}); }

  std::atomic<double> now_s_{0.0};
  HealthSink sink_;
  Engine engine_{options(), window_marker(), sink_, [this] { return now_s_.load(); }};
};

TEST_F(EngineHealth, TellsEachChangeOnce) {
  engine_.push("imu", counting_samples(127));
  at(0.1);
  EXPECT_THAT(news(), ElementsAre("imu warming_up warming_up")) << "the first is told, too";
  engine_.push("imu", counting_samples(1, 127));
  at(0.2);
  EXPECT_THAT(news(), ElementsAre("imu warming_up ok"));
  at(1.1);
  EXPECT_THAT(news(), IsEmpty());
  at(1.2);
  EXPECT_THAT(news(), ElementsAre("imu ok silent"));
  engine_.push("imu", counting_samples(1, 128));
  at(1.3);
  EXPECT_THAT(news(), ElementsAre("imu silent ok"));
  const EngineSnapshot snapshot = engine_.snapshot();
  EXPECT_EQ(snapshot.channels_by_health, (HealthCounts{1, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(snapshot.health_changes, (HealthCounts{2, 1, 0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(engine_.channels(1).front().health->state, Health::kOk);
}

TEST_F(EngineHealth, ASensorWarmsUpAgainAfterItsWindowWasClosedForSilenceAndIsNotLossy) {
  engine_.push("imu", counting_samples(128));
  at(0.1);
  at(6.0);
  news();
  engine_.push("imu", counting_samples(64, 1000));
  at(6.1);
  EXPECT_THAT(news(), ElementsAre("imu silent warming_up"));
}

TEST_F(EngineHealth, MissingAndRefusedSamplesMakeALossySensor) {
  engine_.push("imu", counting_samples(200));
  at(0.1);
  engine_.push("imu", counting_samples(200, 203));  // 3 missing
  at(0.2);
  news();
  engine_.push("imu", counting_samples(2, 10));  // 2 that were there
  at(0.3);
  EXPECT_THAT(news(), ElementsAre("imu ok lossy"));
}

TEST_F(EngineHealth, ASensorThatEndedIsSilentUntilItIsForgotten) {
  engine_.push("imu", counting_samples(128));
  at(0.1);
  engine_.end_of_stream("imu");
  at(0.2);
  EXPECT_THAT(news(), ElementsAre("imu warming_up ok", "imu ok silent"));
  at(101.0);
  EXPECT_THAT(news(), ElementsAre("imu gone"));
  EXPECT_EQ(engine_.snapshot().channels_by_health, HealthCounts{});
}

/// Says after every sample that the sensor is at rest with these curves.
class RestingLearner final : public NoiseLearner {
 public:
  explicit RestingLearner(const RestEvidence& evidence) : evidence_(evidence) {}
  void step(const Sample& /*sample*/, bool /*measured*/, double /*sample_rate_hz*/) noexcept override {}
  std::optional<ChannelNoise> update() noexcept override { return std::nullopt; }
  void reset_segment() noexcept override {}
  [[nodiscard]] bool at_rest() const noexcept override { return true; }
  [[nodiscard]] const RestEvidence* evidence() const noexcept override { return &evidence_; }

 private:
  const RestEvidence& evidence_;
};

TEST(EngineCurves, AreFittedOneSensorAtATimeAndAgainWhenTheyHaveGrownByATenth) {
  RestEvidence evidence;
  evidence.sample_rate_hz = 100.0;
  core::OnlineAllan estimator;
  std::mt19937_64 bits(3);  // NOLINT(cert-msc51-cpp): the same each time
  std::normal_distribution<double> normal(0.0, 7e-3);
  const auto observe = [&](int samples) {
    for (int n = 0; n < samples; ++n) estimator.step(normal(bits));
    evidence.curves.fill(estimator.sums());
  };
  EngineOptions options = small_options();
  options.learner = [&](std::string_view) { return std::make_unique<RestingLearner>(evidence); };
  RecordingSink sink;
  Engine engine(options, window_marker(), sink);
  const auto n_of = [&engine](std::size_t sensor) {
    return engine.channels(2)[sensor].coefficients[0][core::NoiseTerm::kAngleRandomWalk];
  };
  observe(10'000);
  engine.push("a", counting_samples(1));
  engine.push("b", counting_samples(1));
  engine.fit_curves();
  ASSERT_TRUE(n_of(0).observable);
  // 7e-3 / sqrt(100 Hz); 100 s tell it to some per cent.
  EXPECT_NEAR(n_of(0).value, 7e-4, 5e-5);
  EXPECT_FALSE(n_of(1).observable) << "one a call";
  engine.fit_curves();
  EXPECT_TRUE(n_of(1).observable);
  const double first = n_of(0).value;
  observe(900);
  engine.push("a", counting_samples(1, 1));
  engine.fit_curves();
  EXPECT_EQ(n_of(0).value, first) << "9 % more";
  EXPECT_EQ(engine.channels(1)[0].curves[0].terms[0], 10'899U) << "the curve itself is of now";
  observe(200);
  engine.push("a", counting_samples(1, 2));
  engine.fit_curves();
  EXPECT_NE(n_of(0).value, first);
}

}  // namespace
}  // namespace gyrod::stream
