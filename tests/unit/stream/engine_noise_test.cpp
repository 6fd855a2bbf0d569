#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/noise/noise_model.hpp"
#include "engine_support.hpp"
#include "stream/engine.hpp"
#include "stream/joint_method.hpp"
#include "stream/paper_method.hpp"

namespace gyrod::stream {
namespace {

using ::testing::ElementsAre;

ChannelNoise noise_of(NoiseSource source, double variance) {
  return {
      source,
      {core::white_noise(variance), core::white_noise(4.0 * variance), core::white_noise(9.0 * variance)}};
}

/// Learns a variance that is the number of measured samples so far in their stretch, each `every` samples; at rest on even counts.
class CountingLearner final : public NoiseLearner {
 public:
  explicit CountingLearner(std::uint64_t every) : every_(every) {}
  void step(const Sample& /*sample*/, bool measured, double /*sample_rate_hz*/) noexcept override {
    ++steps_;
    measured_ += measured ? 1U : 0U;
  }
  std::optional<ChannelNoise> update() noexcept override {
    if (steps_ % every_ != 0) return std::nullopt;
    return noise_of(NoiseSource::kStandstill, static_cast<double>(measured_ * measured_));
  }
  void reset_segment() noexcept override { measured_ = 0; }
  [[nodiscard]] bool at_rest() const noexcept override { return measured_ % 2 == 0; }

 private:
  std::uint64_t every_;
  std::uint64_t steps_ = 0;
  std::uint64_t measured_ = 0;
};

EngineOptions with_learner(EngineOptions options, std::uint64_t every) {
  options.learner = [every](std::string_view) { return std::make_unique<CountingLearner>(every); };
  return options;
}

/// Noise floor of x in every report; the toy method reports the standard deviation that it was given.
std::vector<double> floors(const RecordingSink& sink) {
  std::vector<double> all;
  for (const NoiseReport& report : sink.reports("imu")) all.push_back(report.axis[0].noise_floor);
  return all;
}

TEST(EngineNoise, IsAskedForOnceASensorAndGivenToEveryWindow) {
  RecordingSink sink;
  EngineOptions options = small_options(1);
  std::vector<std::string> asked;
  options.noise = [&asked](std::string_view sensor) {
    asked.emplace_back(sensor);
    return sensor == "imu" ? noise_of(NoiseSource::kCalibrated, 4.0) : ChannelNoise{};
  };
  Engine engine(options, window_marker(), sink);
  engine.push("imu", counting_samples(64));
  engine.push("other", counting_samples(32));
  engine.stop(std::chrono::seconds{60});
  EXPECT_THAT(asked, ElementsAre("imu", "other"));
  EXPECT_EQ(sink.reports("imu")[0].noise_source, NoiseSource::kCalibrated);
  EXPECT_EQ(sink.reports("imu")[1].axis[2].noise_floor, 6.0) << "each axis is given its own";
  EXPECT_EQ(sink.samples("imu")[0].noise_floor_radps[1], 4.0);
  EXPECT_EQ(sink.reports("other")[0].noise_source, NoiseSource::kImf1) << "the window itself";
}

TEST(EngineNoise, LearnedIsUsedFromItsSampleOnAndNotInWindowsBefore) {
  RecordingSink sink;
  Engine engine(with_learner(small_options(), 48), window_marker(), sink);
  engine.push("imu", counting_samples(128));
  // Windows end with samples 32, 64, 96, 128; what was learned last by then came with sample 48 or 96.
  EXPECT_THAT(floors(sink), ElementsAre(0.0, 48.0, 96.0, 96.0));
  EXPECT_EQ(sink.reports("imu")[0].noise_source, NoiseSource::kImf1);
  EXPECT_EQ(sink.reports("imu")[1].noise_source, NoiseSource::kStandstill);
}

TEST(EngineNoise, LearnerSeesBridgedPlacesAsSuchAndIsToldOfTheEndOfAStretch) {
  RecordingSink sink;
  Engine engine(with_learner(small_options(), 1), window_marker(), sink);
  engine.push("imu", counting_samples(20));
  engine.push("imu", counting_samples(10, 22));    // two places are bridged
  engine.push("imu", counting_samples(32, 1000));  // a long gap
  EXPECT_THAT(floors(sink), ElementsAre(30.0, 30.0, 32.0)) << "the second window closes the stretch";
}

TEST(EngineNoise, ReportsRestAsOfTheWindowsEnd) {
  RecordingSink sink;
  Engine engine(with_learner(small_options(1), 1), window_marker(), sink);
  engine.push("imu", counting_samples(20));
  engine.push("imu", counting_samples(43, 21));  // one place is bridged: odd counts at the windows' ends
  engine.push("imu", counting_samples(32, 65));  // and one more: even again
  engine.stop(std::chrono::seconds{60});
  const auto reports = sink.reports("imu");
  ASSERT_GE(reports.size(), 3U);
  EXPECT_EQ(reports[0].at_rest, false) << "31 measured samples";
  EXPECT_EQ(reports[1].at_rest, false) << "63";
  EXPECT_EQ(reports[2].at_rest, true) << "94";
}

TEST(EngineNoise, LearnedGivesTheSameBitsForAnyWorkersAndAnyBatching) {
  const auto input = noisy_samples(1500);
  const auto run = [&input](std::size_t workers, std::size_t batch) {
    RecordingSink sink;
    Engine engine(with_learner(small_options(workers), 37), window_marker(), sink);
    const std::span<const Sample> all{input};
    for (std::size_t n = 0; n < all.size(); n += batch)
      engine.push("imu", all.subspan(n, std::min(batch, all.size() - n)));
    engine.stop(std::chrono::seconds{60});
    return sink.samples("imu");
  };
  const auto expected = run(0, 1);
  for (const std::size_t workers : {0U, 3U}) {
    for (const std::size_t batch : {1U, 7U, 1500U})
      EXPECT_TRUE(same_bits(run(workers, batch), expected)) << workers << " workers, batches of " << batch;
  }
}

// Before its first model, an answer is as uncertain as the noise that is known says: what was learned by the first sample of the stretch.
TEST(JointMethod, ExpectsTheNoiseThatIsKnownFromTheFirstSampleOfAStretch) {
  const double widening = std::sqrt(core::JointOptions{}.variance_factor);
  RecordingSink sink;
  EngineOptions options = with_learner(small_options(), 33);
  options.noise = [](std::string_view) { return noise_of(NoiseSource::kCalibrated, 0.25); };
  Engine engine(options, joint_method({}), sink);
  engine.push("imu", noisy_samples(40));  // after 33 of them, the learner says 33 rad/s
  engine.push("imu", counting_samples(8, 1000));
  const auto realtime = sink.realtime("imu");
  ASSERT_EQ(realtime.size(), 48U);
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    const double times = widening * static_cast<double>(axis + 1);
    EXPECT_NEAR(realtime[0].rate_std_radps[axis], 0.5 * times, 1e-6) << axis;
    EXPECT_NEAR(realtime[40].rate_std_radps[axis], 33.0 * times, 1e-4) << axis;
  }
}

// At twice the rate, the noise is of twice the variance a sample; what was believed of it at the old rate held for a minute.
TEST(JointMethod, BelievesNothingOfTheNoiseThatItLearnedAtAnotherRate) {
  RecordingSink sink;
  EngineOptions options = small_options();
  options.window_samples = 512;
  Engine engine(options, joint_method({}), sink);
  auto input = noisy_samples(4000);
  for (Sample& sample : input) {
    const bool later = sample.sequence >= 2000;
    for (double& rate : sample.rate_radps)
      rate = (later ? 2.0 : 1.0) * (rate - 0.1 * std::sin(0.01 * static_cast<double>(sample.sequence)));
    if (later)
      sample.stamp_ns = (input[1999].stamp_ns + input[0].stamp_ns) +
                        static_cast<std::int64_t>(sample.sequence - 1999) * 5'000'000;
  }
  engine.push("imu", input);
  const auto reports = sink.reports("imu");
  const auto floor_at = [&reports](std::uint64_t sequence) {
    return std::ranges::find_if(
               reports, [sequence](const NoiseReport& report) { return report.last_sequence >= sequence; })
        ->axis[0]
        .noise_floor;
  };
  EXPECT_NEAR(floor_at(1999), 0.006, 0.0009);
  EXPECT_NEAR(floor_at(2700), 0.012, 0.0018) << "a window, and what it takes to notice";
}

TEST(PaperMethod, TakesTheNoiseThatIsKnownInsteadOfImf1s) {
  const auto floor_with = [](const ChannelNoise& noise) {
    RecordingSink sink;
    EngineOptions options = small_options();
    options.noise = [noise](std::string_view) { return noise; };
    Engine engine(options, paper_method({}), sink);
    engine.push("imu", noisy_samples(128));
    return sink.reports("imu").back().axis[0].noise_floor;
  };
  EXPECT_EQ(floor_with(noise_of(NoiseSource::kCalibrated, 0.25)), 0.5);
  EXPECT_EQ(floor_with(noise_of(NoiseSource::kStandstill, 0.25)), 0.5);
  // AR(1) with pole 1/2: variance 0.75 / (1 - 1/4) = 1 beside the white part's 0.44.
  ChannelNoise coloured = noise_of(NoiseSource::kCalibrated, 0.44);
  for (core::NoiseModel& model : coloured.axis) {
    model.colour_variance = 0.75;
    model.colour_order = 1;
    model.colour[0] = 0.5;
  }
  EXPECT_NEAR(floor_with(coloured), 1.2, 1e-12) << "the whole of it";
  // noisy_samples() has a standard deviation of 0.006; of 128 samples' IMF 1 it is known to some 10 %.
  EXPECT_NEAR(floor_with({}), 0.006, 0.0018);
}

}  // namespace
}  // namespace gyrod::stream
