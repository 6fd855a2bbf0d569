#include "stream/standstill_noise.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/noise/noise_units.hpp"
#include "core/noise/still_noise.hpp"
#include "engine_support.hpp"

namespace gyrod::stream {
namespace {

constexpr double kDeviation = 0.006;  // rad/s
constexpr double kHz = 100.0;

/// White noise with a standard deviation of kDeviation on each axis, that swings by 0.5 rad/s from `moving_from` on.
std::vector<Sample> rest_then_motion(std::size_t count, std::size_t moving_from, double rate_hz = kHz) {
  std::mt19937_64 bits(7);  // NOLINT(cert-msc51-cpp): the same each time
  std::normal_distribution<double> normal(0.0, kDeviation);
  std::vector<Sample> samples(count);
  for (std::size_t n = 0; n < count; ++n) {
    samples[n].sequence = n;
    samples[n].stamp_ns = std::llround(static_cast<double>(n) * 1e9 / rate_hz);
    const double swing = n < moving_from ? 0.0 : 0.5 * std::sin(0.05 * static_cast<double>(n - moving_from));
    for (double& rate : samples[n].rate_radps) rate = normal(bits) + swing;
  }
  return samples;
}

CalibratedNoise calibrated(double variance) {
  CalibratedNoise noise{kHz, {}};
  noise.models.fill(core::white_noise(variance));
  return noise;
}

/// What is in use after these samples, as a channel would have it.
ChannelNoise after(StandstillNoise& learner, std::span<const Sample> samples, double rate_hz,
                   ChannelNoise noise = {}) {
  for (const Sample& sample : samples) {
    learner.step(sample, true, rate_hz);
    if (const auto update = learner.update()) noise = *update;
  }
  return noise;
}

double deviation(const ChannelNoise& noise) { return std::sqrt(core::noise_variance(noise.axis[0])); }

TEST(StandstillNoise, LearnsAtRestAndKeepsItInMotion) {
  std::vector<core::StandstillState> told;
  StandstillNoise learner({.on_learned = [&told](const auto& state) { told.push_back(state); }});
  const auto samples = rest_then_motion(12000, 9000);
  const ChannelNoise rested = after(learner, std::span(samples).first(9000), kHz);
  EXPECT_TRUE(learner.at_rest());
  EXPECT_EQ(rested.source, NoiseSource::kStandstill);
  // 90 s give the level to 0.8 %; three of these.
  EXPECT_NEAR(deviation(rested), core::kNoiseMargin * kDeviation, 0.025 * kDeviation);
  EXPECT_EQ(after(learner, std::span(samples).subspan(9000), kHz, rested), rested);
  EXPECT_FALSE(learner.at_rest());
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(channel_noise(NoiseSource::kStandstill, told.back().models), rested);
}

// Rest is known after eight blocks; then all but the last two blocks before the motion count.
TEST(StandstillNoise, KeepsTheAllanDeviationOfRestAloneAndTellsItBlockByBlock) {
  StandstillNoise learner({.sample_rate_hz = kHz});
  const auto samples = rest_then_motion(6000, 4050);
  std::size_t blocks = 0;
  RestEvidence last;
  for (const Sample& sample : samples) {
    learner.step(sample, true, kHz);
    static_cast<void>(learner.update());
    if (const RestEvidence* evidence = learner.evidence()) {
      last = *evidence;
      ++blocks;
    }
  }
  EXPECT_EQ(blocks, 60U);
  EXPECT_EQ(last.block_s, 1.0);
  EXPECT_FALSE(last.looks_at_rest);
  core::OnlineAllan expected;
  for (std::size_t n = 800; n < 3900; ++n) expected.step(samples[n].rate_radps[1]);
  EXPECT_EQ(last.curves[1], expected.sums());
}

TEST(StandstillNoise, TellsTheLevelThatIsUsual) {
  const auto last_of = [](StandstillNoise& learner, std::span<const Sample> samples) {
    RestEvidence last;
    for (const Sample& sample : samples) {
      learner.step(sample, true, kHz);
      if (learner.evidence() != nullptr) last = *learner.evidence();
    }
    return last;
  };
  const auto samples = rest_then_motion(6000, 6000);
  StandstillNoise learning({});
  const RestEvidence learned = last_of(learning, samples);
  EXPECT_TRUE(learned.looks_at_rest);
  EXPECT_NEAR(learned.usual_deviation_radps[0], kDeviation, 0.03 * kDeviation);
  EXPECT_NEAR(learned.deviation_radps[0], kDeviation, 0.1 * kDeviation);
  EXPECT_GT(learned.bias_s, 40.0);
  StandstillNoise told({.calibrated = calibrated(1e-4)});
  EXPECT_DOUBLE_EQ(last_of(told, samples).usual_deviation_radps[2], 1e-2);
}

TEST(StandstillNoise, RemembersTheAllanDeviation) {
  RememberedNoise state;
  StandstillNoise teller({.on_learned = [&state](const auto& now) { state = now; }});
  after(teller, rest_then_motion(6000, 6000), kHz);
  EXPECT_GT(state.curves[0].terms[0], 2000U);
  StandstillNoise learner({.remembered = state});
  const auto moving = rest_then_motion(500, 0);
  RestEvidence last;
  for (const Sample& sample : moving) {
    learner.step(sample, true, kHz);
    if (learner.evidence() != nullptr) last = *learner.evidence();
  }
  EXPECT_EQ(last.curves, state.curves);
}

TEST(StandstillNoise, UsesWhatIsRememberedFromTheFirstSampleOn) {
  StandstillNoise first({});
  const ChannelNoise learned = after(first, rest_then_motion(6000, 6000), kHz);
  core::StandstillState state;
  StandstillNoise teller({.on_learned = [&state](const auto& now) { state = now; }});
  after(teller, rest_then_motion(6000, 6000), kHz);
  const StandstillOptions options{.remembered = state};
  EXPECT_EQ(noise_beforehand(options), learned);
  StandstillNoise second(options);
  const auto moving = rest_then_motion(500, 0);
  EXPECT_EQ(after(second, moving, kHz, noise_beforehand(options)), learned);
  EXPECT_EQ(noise_beforehand({.sample_rate_hz = 50.0, .remembered = state}), ChannelNoise{})
      << "of another sample rate than the configured";
  EXPECT_EQ(noise_beforehand({.use_learned = false, .remembered = state}), ChannelNoise{});
}

TEST(StandstillNoise, ForgetsWhatIsOfAnotherRateOnceTheStampsHaveSaidSoLongEnough) {
  core::StandstillState state;
  StandstillNoise teller({.on_learned = [&state](const auto& now) { state = now; }});
  after(teller, rest_then_motion(6000, 6000), kHz);
  StandstillNoise learner({.remembered = state});
  const auto samples = rest_then_motion(StandstillNoise::kAgreeing, 0);
  const ChannelNoise before = noise_beforehand({.remembered = state});
  const ChannelNoise almost = after(learner, std::span(samples).first(samples.size() - 1), 200.0, before);
  EXPECT_EQ(almost, before);
  EXPECT_EQ(after(learner, std::span(samples).last(1), 200.0, before), ChannelNoise{});
}

TEST(StandstillNoise, ACalibrationIsUsedBeforeAnythingLearnedAndAtTheRateOfTheStamps) {
  const StandstillOptions options{.calibrated = calibrated(1e-4)};
  EXPECT_EQ(noise_beforehand(options).source, NoiseSource::kCalibrated);
  EXPECT_DOUBLE_EQ(deviation(noise_beforehand(options)), core::kNoiseMargin * 1e-2);
  StandstillNoise learner(options);
  const ChannelNoise rested = after(learner, rest_then_motion(6000, 6000), kHz, noise_beforehand(options));
  EXPECT_EQ(rested, noise_beforehand(options));
  EXPECT_TRUE(learner.at_rest()) << "it looks all the same";
  // Twice the rate, twice the variance a sample (core::at_rate).
  const ChannelNoise faster = after(learner, rest_then_motion(StandstillNoise::kAgreeing, 0), 200.0, rested);
  EXPECT_DOUBLE_EQ(deviation(faster), core::kNoiseMargin * 1e-2 * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(deviation(noise_beforehand({.sample_rate_hz = 200.0, .calibrated = calibrated(1e-4)})),
                   core::kNoiseMargin * 1e-2 * std::sqrt(2.0));
}

TEST(StandstillNoise, AnAxisWithoutAModelIsGivenTheStrongest) {
  std::array<core::NoiseModel, kAxes> models{core::white_noise(1.0), {}, core::white_noise(4.0)};
  const ChannelNoise noise = channel_noise(NoiseSource::kCalibrated, models);
  EXPECT_EQ(noise.axis[1], noise.axis[2]);
  EXPECT_EQ(channel_noise(NoiseSource::kCalibrated, {}), ChannelNoise{});
}

TEST(StandstillNoise, BelievesAnAccelerometerThatFeelsMotionAndNotOneThatHasFailed) {
  for (const double shake : {0.0, 0.5, std::nan("")}) {
    StandstillNoise learner({});
    auto samples = rest_then_motion(3000, 3000);
    // 0.4 Hz, as a car rolls over a smooth road; of that the gyro sees nothing.
    for (std::size_t n = 0; n < samples.size(); ++n)
      samples[n].specific_force_mps2 = {0.0, shake * std::sin(0.025 * static_cast<double>(n)), 9.81};
    const ChannelNoise noise = after(learner, samples, kHz);
    EXPECT_EQ(learner.at_rest(), shake != 0.5) << shake;
    EXPECT_EQ(noise.source, shake == 0.5 ? NoiseSource::kNone : NoiseSource::kStandstill) << shake;
  }
}

// Every fiftieth force is no number: the last one holds. After a dropout of a second rest is judged by the gyro alone until it is back.
TEST(StandstillNoise, LooksThroughAnAccelerometerThatFailsNowAndThen) {
  StandstillNoise learner({});
  auto samples = rest_then_motion(6000, 6000);
  std::mt19937_64 bits(3);  // NOLINT(cert-msc51-cpp): the same each time
  std::normal_distribution<double> normal(0.0, 0.01);
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const bool fails = n % 50 == 0 || n / 100 == 30;
    samples[n].specific_force_mps2 = {normal(bits), fails ? std::nan("") : normal(bits), 9.81 + normal(bits)};
  }
  EXPECT_EQ(after(learner, std::span(samples).first(3000), kHz).source, NoiseSource::kStandstill);
  EXPECT_TRUE(learner.at_rest());
  static_cast<void>(after(learner, std::span(samples).subspan(3000, 200), kHz));
  EXPECT_FALSE(learner.at_rest()) << "with and without are judged apart";
  static_cast<void>(after(learner, std::span(samples).subspan(3200), kHz));
  EXPECT_TRUE(learner.at_rest());
}

TEST(StandstillNoise, GivesTheSameReportsForAnyWorkersAndAnyBatching) {
  const auto input = rest_then_motion(6000, 5000);
  const auto sources = [&input](std::size_t workers, std::size_t batch) {
    RecordingSink sink;
    EngineOptions options = small_options(workers);
    options.learner = [](std::string_view) { return std::make_unique<StandstillNoise>(StandstillOptions{}); };
    Engine engine(options, window_marker(), sink);
    const std::span<const Sample> all{input};
    for (std::size_t n = 0; n < all.size(); n += batch)
      engine.push("imu", all.subspan(n, std::min(batch, all.size() - n)));
    engine.stop(std::chrono::seconds{60});
    std::vector<std::pair<std::uint64_t, double>> known;
    for (const NoiseReport& report : sink.reports("imu")) {
      if (report.noise_source == NoiseSource::kStandstill)
        known.emplace_back(report.last_sequence, report.axis[0].noise_floor);
    }
    return known;
  };
  const auto expected = sources(0, 1);
  ASSERT_FALSE(expected.empty());
  EXPECT_GT(expected.front().first, 1000U) << "ten seconds of rest at least";
  for (const std::size_t workers : {0U, 3U}) {
    for (const std::size_t batch : {7U, 64U}) EXPECT_EQ(sources(workers, batch), expected) << workers;
  }
}

}  // namespace
}  // namespace gyrod::stream
