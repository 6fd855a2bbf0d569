// How well a learned noise model holds on other stretches of the same recording, for docs/noise.md:
//
//   noise_model_study [DATA]      AR(8) + white from one minute and from ten against the spectrum of what follows
//
// and what the estimate of the noise costs a stationary smoother.
// DATA is the folder of recordings, ../shared/data unless given.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/noise/standstill_learner.hpp"
#include "core/noise/still_noise.hpp"
#include "core/signal/periodogram.hpp"
#include "files/record.hpp"

namespace {

using namespace gyrod;
using core::NoiseModel;
using core::NoiseSpectrum;
using Samples = std::span<const double>;

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

files::Record load(const std::filesystem::path& path, std::optional<double> rate = std::nullopt) {
  files::RecordOptions options;
  options.sample_rate_hz = rate;
  options.other_columns = true;
  return files::load_record(path.string(), options);
}

/// Welch spectrum of a stretch, shocks left in.
NoiseSpectrum spectrum_of(Samples samples) {
  core::Periodogram periodogram(core::kNoiseSegment);
  NoiseSpectrum power{};
  NoiseSpectrum sum{};
  double segments = 0.0;
  for (std::size_t first = 0; first + core::kNoiseSegment <= samples.size();
       first += core::kNoiseSegment / 2) {
    periodogram.transform(samples.subspan(first, core::kNoiseSegment), power);
    for (std::size_t k = 0; k < power.size(); ++k) sum[k] += power[k];
    segments += 1.0;
  }
  for (double& bin : sum) bin /= segments;
  return sum;
}

/// Of the ratio spectrum / model over bins 3..N/2.
struct Fit {
  double level = 0.0;     ///< standard deviation, measured over modelled
  double octaves = 0.0;   ///< largest deviation from 1 of the ratio, averaged over 16 bins
  double line = 0.0;      ///< largest ratio of one bin
  double line_at = 0.0;   ///< its frequency, cycles per sample
  double whitened = 0.0;  ///< mean ratio: the mean normalised square of what a filter with this model sees
};

Fit compare(const NoiseModel& model, const NoiseSpectrum& power) {
  Fit fit;
  double variance = 0.0;
  double modelled = 0.0;
  constexpr std::size_t kBand = 16;
  std::vector<double> ratio;
  for (std::size_t k = 3; k < power.size(); ++k) {
    const double w = 2.0 * std::numbers::pi * static_cast<double>(k) / core::kNoiseSegment;
    const double of_model = core::noise_spectrum(model, w);
    variance += power[k];
    modelled += of_model;
    ratio.push_back(power[k] / of_model);
    if (ratio.back() > fit.line) {
      fit.line = ratio.back();
      fit.line_at = static_cast<double>(k) / core::kNoiseSegment;
    }
  }
  fit.level = std::sqrt(variance / modelled);
  for (const double value : ratio) fit.whitened += value / static_cast<double>(ratio.size());
  for (std::size_t first = 0; first + kBand <= ratio.size(); first += kBand) {
    double band = 0.0;
    for (std::size_t k = first; k < first + kBand; ++k) band += ratio[k] / static_cast<double>(kBand);
    fit.octaves = std::max(fit.octaves, std::abs(band - 1.0));
  }
  return fit;
}

void print(const char* what, const std::optional<NoiseModel>& model, const NoiseSpectrum& power) {
  if (!model) {
    std::printf("   %-10s none\n", what);
    return;
  }
  const Fit fit = compare(*model, power);
  std::printf("   %-10s %8.4f %8.4f %9.3f %9.3f %9.3f %8.2f at %.3f\n", what,
              std::sqrt(core::noise_variance(*model)) * kDegPerRad,
              std::sqrt(model->white_variance) * kDegPerRad, fit.level, fit.whitened, fit.octaves, fit.line,
              fit.line_at);
}

/// Error of the stationary Wiener smoother for motion of spectrum S under noise R, which believes in the noise of a model:
///   mean over frequencies of h^2 R + (1 - h)^2 S,   h = S / (S + model).
double wiener_error(const NoiseSpectrum& motion, const NoiseSpectrum& noise, const NoiseModel& model) {
  double sum = 0.0;
  for (std::size_t k = 1; k < motion.size(); ++k) {
    const double w = 2.0 * std::numbers::pi * static_cast<double>(k) / core::kNoiseSegment;
    const double h = motion[k] / (motion[k] + core::noise_spectrum(model, w));
    sum += h * h * noise[k] + (1.0 - h) * (1.0 - h) * motion[k];
  }
  return std::sqrt(sum / static_cast<double>(motion.size() - 1));
}

/// What each way to know the noise costs in the ten minutes after the first, in which the learner has stood still: the errors over that
/// with a calibration from the recording's second half, the worst over the axes of the motion.
void study_cost(const files::Record& still, const std::array<NoiseSpectrum, 3>& motion) {
  const std::size_t minute = static_cast<std::size_t>(60.0 * still.sample_rate_hz);
  const std::size_t half = still.size() / 2;
  std::printf("%s: errors over that with the second half as calibration\n", still.name.c_str());
  std::printf("   %-5s %10s %10s %10s %10s %10s %10s %10s\n", "axis", "standstill", "white", "level*0.8",
              "level*0.9", "level*1.02", "level*1.1", "level*1.25");
  core::StandstillLearner learner(still.sample_rate_hz);
  for (std::size_t n = 0; n < minute; ++n)
    learner.step({still.gyro_radps[0][n], still.gyro_radps[1][n], still.gyro_radps[2][n]});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Samples all = still.gyro_radps[axis];
    const NoiseSpectrum noise = spectrum_of(all.subspan(minute, std::min(10 * minute, half - minute)));
    const NoiseModel calibrated = *core::still_noise(all.subspan(half));
    const auto worst = [&](const NoiseModel& model) {
      double most = 0.0;
      for (const NoiseSpectrum& one : motion)
        most = std::max(most, wiener_error(one, noise, model) / wiener_error(one, noise, calibrated));
      return most;
    };
    std::printf("   %-5c %10.4f %10.4f", "xyz"[axis], worst(learner.models()[axis]),
                worst(core::white_noise(core::noise_variance(calibrated))));
    for (const double factor : {0.8, 0.9, 1.02, 1.1, 1.25})
      std::printf(" %10.4f", worst(core::scaled(calibrated, factor)));
    std::printf("\n");
  }
}

void cost(const std::filesystem::path& data) {
  const auto drive = load(data / "wid_car_trial06_xsensdot_120hz.csv.gz");
  std::array<NoiseSpectrum, 3> motion{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> rate = drive.others.at(std::string("ref_gyro_") + "xyz"[axis] + "_dps");
    // Between 12 and 56 s the car drives.
    rate = std::vector<double>(rate.begin() + 1440, rate.begin() + 6720);
    for (double& value : rate) value /= kDegPerRad;
    motion[axis] = spectrum_of(rate);
  }
  for (const char* imu : {"imu1", "imu2", "imu4"})
    study_cost(load(data / ("adis16405_" + std::string(imu) + "_static_100hz.csv.gz"), 100.0), motion);
  study_cost(load(data / "mpu6050_static_10min_100hz.csv.gz", 100.0), motion);
}

void study_models(const files::Record& record) {
  const std::size_t minute = static_cast<std::size_t>(60.0 * record.sample_rate_hz);
  std::printf("%s, %.2f Hz\n   %-10s %8s %8s %9s %9s %9s %8s\n", record.name.c_str(), record.sample_rate_hz,
              "learned on", "std", "white", "level", "whitened", "bands", "line");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Samples all = record.gyro_radps[axis];
    const std::size_t ten = std::min(10 * minute, all.size() / 2);
    const NoiseSpectrum rest = spectrum_of(all.subspan(ten));
    std::printf(" %c\n", "xyz"[axis]);
    print("20 s", core::still_noise(all.first(std::max(core::kMinStillSamples, minute / 3))), rest);
    print("60 s", core::still_noise(all.first(minute)), rest);
    print("ten min", core::still_noise(all.first(ten)), rest);
    const auto ten_minutes = core::still_noise(all.first(ten));
    if (ten_minutes) {
      print("white only", core::white_noise(core::noise_variance(*ten_minutes)), rest);
    }
    double least = 1e9;
    double most = 0.0;
    double squares = 0.0;
    double count = 0.0;
    const double reference = std::sqrt(core::noise_variance(*ten_minutes));
    for (std::size_t first = 0; first + minute <= all.size(); first += minute) {
      const auto one = core::still_noise(all.subspan(first, minute));
      if (!one) continue;
      const double level = std::sqrt(core::noise_variance(*one)) / reference;
      least = std::min(least, level);
      most = std::max(most, level);
      squares += (level - 1.0) * (level - 1.0);
      count += 1.0;
    }
    std::printf("   levels of %.0f minutes over that of ten: %.3f to %.3f, rms %.4f\n", count, least, most,
                std::sqrt(squares / count));
  }
}

void models(const std::filesystem::path& data) {
  for (const char* imu : {"imu1", "imu2", "imu4"}) {
    study_models(load(data / ("adis16405_" + std::string(imu) + "_static_100hz.csv.gz"), 100.0));
  }
  study_models(load(data / "mpu6050_static_10min_100hz.csv.gz", 100.0));
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path data = argc > 1 ? argv[1] : "../shared/data";
  models(data);
  cost(data);
  return 0;
}
