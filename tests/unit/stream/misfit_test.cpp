// When method joint says that its models do not fit, and for how long.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/simulation/simulated_gyro.hpp"
#include "engine_support.hpp"
#include "files/record.hpp"
#include "stream/joint_method.hpp"
#include "support/data_folder.hpp"
#include "support/signals.hpp"

namespace gyrod::stream {
namespace {

using ::testing::Each;
using ::testing::Ge;

constexpr double kStd = 0.006;  // rad/s

/// White noise on all axes, over turns where it drives.
std::vector<Sample> white(std::size_t count, bool drives = false, double rate_hz = 100.0) {
  std::vector<Sample> samples(count);
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    const auto noise = testing::white_noise(count, static_cast<unsigned>(axis + 1));
    for (std::size_t n = 0; n < count; ++n) {
      samples[n].sequence = n;
      samples[n].stamp_ns = std::llround(static_cast<double>(n) * 1e9 / rate_hz);
      samples[n].rate_radps[axis] =
          kStd * noise[n] + (drives ? 0.3 * std::sin(0.01 * static_cast<double>(n)) : 0.0);
    }
  }
  return samples;
}

EngineOptions offline(double rate_hz) {
  EngineOptions options;
  options.workers = 0;
  options.sample_rate_hz = rate_hz;
  options.max_delay_s = 3600.0;
  return options;
}

struct FlagRun {
  std::vector<bool> misfit;  ///< of the sensor, sample by sample
  ModelFit last;             ///< of x
  std::uint64_t misfits = 0;
};

FlagRun flags_of(const EngineOptions& options, std::span<const Sample> samples) {
  RecordingSink sink;
  Engine engine(options, joint_method({}), sink);
  engine.push("imu", samples);
  FlagRun made;
  for (const DenoisedSample& sample : sink.realtime("imu"))
    made.misfit.push_back(has_flag(sample, SampleFlag::kModelMisfit));
  made.last = (*sink.reports("imu").back().model_fit)[0];
  made.misfits = engine.snapshot().totals.misfits;
  return made;
}

/// Lengths of the spells, but for one that the end cuts.
std::vector<std::size_t> spells(const std::vector<bool>& misfit) {
  std::vector<std::size_t> lengths;
  std::size_t length = 0;
  for (const bool now : misfit) {
    if (!now && length > 0) lengths.push_back(length);
    length = now ? length + 1 : 0;
  }
  return lengths;
}

std::ptrdiff_t flagged(const std::vector<bool>& misfit) { return std::ranges::count(misfit, true); }

// From the first models on it takes 512 samples, or, where noise that was measured at rest seems too weak, two windows; after that neither rest nor
// motion makes it go.
TEST(Misfit, HoldsForAsLongAsTheNoiseIsNotWhatItIsBelievedToBe) {
  for (const bool drives : {false, true}) {
    for (const double factor : {3.0, 1.0 / 3.0}) {
      for (const bool coloured : {false, true}) {
        core::NoiseModel believed = core::white_noise(std::pow(factor * kStd, 2));
        if (coloured) {  // hardly: it is still what a calibration at rest makes
          believed.colour_order = 1;
          believed.colour[0] = 0.3;
          believed.colour_variance = 0.01 * believed.white_variance;
        }
        EngineOptions options = offline(100.0);
        options.noise = [&believed](std::string_view) {
          return ChannelNoise{NoiseSource::kCalibrated, {believed, believed, believed}};
        };
        const FlagRun made = flags_of(options, white(12000, drives));
        const std::string what =
            std::to_string(factor) + (coloured ? " coloured" : "") + (drives ? " driving" : "");
        const std::vector<bool> later(made.misfit.begin() + 2048, made.misfit.end());
        EXPECT_EQ(flagged(later), std::ssize(later)) << what;
        EXPECT_EQ(made.misfits, kAxes) << what << ": once an axis";
        EXPECT_TRUE(made.last.wrong_noise) << what;
        EXPECT_NEAR(made.last.noise_ratio * factor, 1.0, 0.15) << what;
      }
    }
  }
}

TEST(Misfit, IsNotSaidOfNoiseThatIsBelievedRightly) {
  for (const bool drives : {false, true}) {
    EngineOptions options = offline(100.0);
    options.noise = [](std::string_view) {
      const auto believed = core::white_noise(kStd * kStd);
      return ChannelNoise{NoiseSource::kCalibrated, {believed, believed, believed}};
    };
    const FlagRun made = flags_of(options, white(12000, drives));
    EXPECT_EQ(flagged(made.misfit), 0) << drives;
    EXPECT_EQ(made.misfits, 0U);
    EXPECT_FALSE(made.last.wrong_noise);
    EXPECT_EQ(made.last.noise_ratio, 1.0);
  }
}

/// A filter with the model of white noise, and what it says of noise so much stronger than that.
class MisfitOfAFilter : public ::testing::Test {
 protected:
  MisfitOfAFilter() { open(100.0); }
  void open(double rate_hz) {
    filter_ = factory_.filter(16);
    use(rate_hz, 1.0);
  }
  /// @param believed the noise's variance, in parts of what it is; 0: nothing is
  void use(double rate_hz, double believed) {
    const auto noise = testing::times(testing::white_noise(1024, 1), kStd);
    const auto model = factory_.model();
    const auto method = factory_.method(1024);
    core::WindowReport report;
    const WindowInput window{.samples = noise,
                             .sample_rate_hz = rate_hz,
                             .noise_source = believed > 0.0 ? NoiseSource::kCalibrated : NoiseSource::kNone,
                             .noise = core::white_noise(believed * kStd * kStd)};
    for (int windows = 0; windows < 32; ++windows) method->fit(window, *model, report);
    filter_->use(*model);
  }
  std::vector<bool> after(double variance, std::size_t samples) {
    std::vector<bool> misfit;
    for (const double value : testing::white_noise(samples, 2)) {
      filter_->step(std::sqrt(variance) * kStd * value);
      misfit.push_back(filter_->model_fit().misfit);
      const bool beyond = filter_->model_fit().normalised_innovation > 2.0;
      crossings_ += beyond && !beyond_ ? 1U : 0U;
      beyond_ = beyond;
    }
    return misfit;
  }

  ModelMethodFactory factory_ = std::get<ModelMethodFactory>(MethodFactory(joint_method({})));
  std::unique_ptr<SampleFilter> filter_;
  bool beyond_ = false;
  std::size_t crossings_ = 0;  ///< of the limit from below
};

TEST_F(MisfitOfAFilter, IsNotLeftAndEnteredAgainAtTheLimit) {
  const auto misfit = after(2.5, 20000);  // members that allow for more motion take part: the mean is about 2
  EXPECT_GT(crossings_, 100U) << "what one limit for both would have counted";
  EXPECT_LE(filter_->model_fit().misfits, 4U);
  EXPECT_THAT(spells(misfit), Each(Ge(128U)));
}

TEST_F(MisfitOfAFilter, IsLeftSecondsAfterWhatDoesNotFitIsOverAtEitherEnd) {
  for (const double variance : {6.0, 0.2}) {
    EXPECT_TRUE(after(variance, 2000).back()) << variance;
    const auto over = after(1.0, 2000);
    EXPECT_FALSE(over.back()) << variance;
    // From about 6 to 1.6 by a mean of 256 samples: 256 ln(5 / 0.6) = 543.
    EXPECT_LT(flagged(over), 1000) << variance;
  }
}

// At eight times the design's rate the same times are eight times the samples: of the mean, and of the shortest spell.
TEST_F(MisfitOfAFilter, TakesTheSameSecondsAtAHighRate) {
  open(8.0 * core::kDesignRateHz);
  after(6.0, 16000);
  const auto over = after(1.0, 16000);
  EXPECT_FALSE(over.back());
  EXPECT_GT(flagged(over), 8 * 256) << "8 * 256 ln(5 / 0.6) = 4342";
  EXPECT_LT(flagged(over), 8 * 1000);
}

TEST_F(MisfitOfAFilter, LastsForTheSameSecondsAtLeastAtAHighRate) {
  for (const auto& [rate_hz, least] : {std::pair{100.0, 128U}, std::pair{960.0, 8U * 128U}}) {
    open(rate_hz);
    unsigned silent = 0;  // the mean falls from 1 to 0.7 in 91 or 730 samples
    while (silent < 8 * 256 && !after(0.0, 1).back()) ++silent;
    // It is back at 0.8 of 1.5 in 35 or 274.
    EXPECT_EQ(flagged(after(1.5, 4 * least)), least - 1) << rate_hz;
  }
}

// A level that is a ninth of the believed one is said to be wrong by the 512th sample in a row, and right again by the 512th.
TEST_F(MisfitOfAFilter, AsksForTheSameSecondsOfNoiseThatIsNotAsBelieved) {
  for (const auto& [rate_hz, expected] : {std::pair{100.0, 512U}, std::pair{960.0, 8U * 512U}}) {
    open(rate_hz);
    const auto noise = testing::times(testing::white_noise(expected, 3), kStd);
    for (const bool wrong : {true, false}) {
      use(rate_hz, wrong ? 9.0 : 1.0);
      unsigned taken = 0;
      while (taken < expected && filter_->model_fit().wrong_noise != wrong) filter_->step(noise[taken++]);
      EXPECT_EQ(filter_->model_fit().wrong_noise, wrong) << rate_hz;
      EXPECT_EQ(taken, expected) << rate_hz << wrong;
    }
  }
}

// Entered where the mean of the innovations leaves 0.7 to 2; left within 0.8 to 1.6, 128 samples later at the earliest.
// A sensor may forget what it believed, as where a level that was learned is far too high. Then nothing is wrong, and there is nothing to be a part of.
TEST_F(MisfitOfAFilter, IsOverWhereNothingIsBelievedAnyMore) {
  use(100.0, 9.0);
  after(1.0, 1000);
  ASSERT_TRUE(filter_->model_fit().wrong_noise);
  ASSERT_NEAR(filter_->model_fit().noise_ratio, 1.0 / 3.0, 0.05);
  use(100.0, 0.0);
  filter_->step(0.0);
  EXPECT_FALSE(filter_->model_fit().wrong_noise);
  EXPECT_EQ(filter_->model_fit().noise_ratio, 1.0);
}

TEST_F(MisfitOfAFilter, HasTheLimitsOfTheManual) {
  std::size_t lasted = 0;
  std::size_t entered_above = 0;
  std::size_t entered_below = 0;
  const auto scales = testing::white_noise(300, 3);
  const auto noise = testing::white_noise(scales.size() * 400, 4);
  for (std::size_t n = 0; n < noise.size(); ++n) {
    filter_->step(kStd * noise[n] * std::exp(0.6 * scales[n / 400]));
    const ModelFit fit = filter_->model_fit();
    const double mean = fit.normalised_innovation;
    const bool leaves = lasted >= 128 && mean >= 0.8 && mean <= 1.6;
    const bool expected = lasted > 0 ? !leaves : mean < 0.7 || mean > 2.0;
    ASSERT_EQ(fit.misfit, expected) << n << ": " << mean;
    entered_above += expected && lasted == 0 && mean > 2.0 ? 1U : 0U;
    entered_below += expected && lasted == 0 && mean < 0.7 ? 1U : 0U;
    lasted = expected ? lasted + 1 : 0;
  }
  EXPECT_GT(entered_above, 10U);
  EXPECT_GT(entered_below, 10U);
}

/// Spells of the sensor's flag, in parts of all samples, as docs/joint.md states them.
void expect_spells(const std::string& name, const FlagRun& made, std::size_t most, std::size_t shortest) {
  const auto lengths = spells(made.misfit);
  const double share = static_cast<double>(flagged(made.misfit)) / static_cast<double>(made.misfit.size());
  const std::size_t least = lengths.empty() ? 0 : std::ranges::min(lengths);
  std::printf("%s: %.1f %% of samples, %zu spells, the shortest of %zu samples; counted %llu\n", name.c_str(),
              100.0 * share, lengths.size() + (made.misfit.back() ? 1 : 0), least,
              static_cast<unsigned long long>(made.misfits));
  EXPECT_LE(lengths.size(), most) << name;
  EXPECT_THAT(lengths, Each(Ge(shortest))) << name;
}

TEST(Misfit, SpellsOnDrivesLastForASecond) {
  struct Drive {
    const char* file;
    double rate_hz;
    std::size_t most;
  };
  for (const Drive& drive : {Drive{"drive0708_lsm6_100hz.csv.gz", 100.0, 35},
                             Drive{"wid_car_trial06_xsensdot_120hz.csv.gz", 120.0, 3},
                             Drive{"wid_car_trial09_xsensdot_120hz.csv.gz", 120.0, 4}}) {
    const auto path = test::data_folder() / drive.file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
    files::RecordOptions read;
    read.sample_rate_hz = drive.rate_hz;
    const files::Record record = files::load_record(path.string(), read);
    std::vector<Sample> samples(record.gyro_radps[0].size());
    for (std::size_t n = 0; n < samples.size(); ++n) {
      samples[n].sequence = n;
      samples[n].stamp_ns = std::llround(static_cast<double>(n) * 1e9 / drive.rate_hz);
      for (std::size_t axis = 0; axis < kAxes; ++axis)
        samples[n].rate_radps[axis] = record.gyro_radps[axis][n];
    }
    expect_spells(drive.file, flags_of(offline(drive.rate_hz), samples), drive.most, 128);
  }
}

TEST(Misfit, SpellsOfASimulatedDriveWithAnEngineLastForASecond) {
  core::SimulatedGyroOptions options;
  options.drive.emplace();
  options.drive->engine_tone_radps = 2.0 * std::numbers::pi / 180.0;
  core::SimulatedGyro gyro(options);
  std::vector<Sample> samples;
  for (int n = 0; n < 12000; ++n) {
    const auto made = gyro.next();
    samples.push_back({made.sequence, made.stamp_ns, made.measured_radps});
  }
  expect_spells("simulated", flags_of(offline(100.0), samples), 3, 128);
}

}  // namespace
}  // namespace gyrod::stream
