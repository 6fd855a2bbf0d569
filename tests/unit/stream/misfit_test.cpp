// When method joint says that its models do not fit, and for how long.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/simulation/simulated_gyro.hpp"
#include "engine_support.hpp"
#include "files/record.hpp"
#include "misfit_support.hpp"
#include "stream/joint_method.hpp"
#include "support/data_folder.hpp"
#include "support/signals.hpp"

namespace gyrod::stream {
namespace {

using ::testing::Each;
using ::testing::Ge;

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
