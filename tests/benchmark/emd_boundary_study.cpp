// Which boundary rule leaves the smaller error in the newest samples of a window? Prints the tables of
// docs/decisions/0001-boundary-rule.md:
//
//   GYROD_DATA=FOLDER emd_boundary_study     (default ../shared/data; recordings that are absent are left
//   out)
//
// Truth is the decomposition of a record that holds the window and 2048 samples on either side of it. Error
// is taken over the window's last 64 samples, relative to the root mean square of the truth there, over all
// windows of a row.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include <zlib.h>

#include "core/emd/emd.hpp"

namespace {

using gyrod::core::BoundaryRule;
using gyrod::core::Emd;
using gyrod::core::EmdOptions;

constexpr std::size_t kWindow = 1024;
constexpr std::size_t kMargin = 2048;
constexpr std::size_t kRecord = kMargin + kWindow + kMargin;
constexpr std::size_t kNewest = 64;
constexpr std::size_t kImfs = 6;
constexpr std::size_t kMaxWindows = 400;

using Modes = std::array<std::array<double, kNewest>, kImfs>;

/// IMF 1..kImfs over kNewest samples from `from` on.
Modes decompose(std::span<const double> signal, std::size_t from, BoundaryRule rule) {
  Modes modes{};
  EmdOptions options;
  options.boundary = rule;
  options.max_imfs = static_cast<int>(kImfs);
  Emd emd(signal.size(), options);
  std::vector<double> imf(signal.size());
  emd.start(signal);
  for (std::size_t i = 0; i < kImfs && emd.next_imf(imf); ++i) {
    std::copy_n(imf.begin() + static_cast<std::ptrdiff_t>(from), kNewest, modes[i].begin());
  }
  return modes;
}

/// Squared error and squared truth of each IMF and of each sum IMF 1..i.
struct Errors {
  std::array<double, kImfs> imf_error{};
  std::array<double, kImfs> imf_truth{};
  std::array<double, kImfs> sum_error{};
  std::array<double, kImfs> sum_truth{};

  void add(const Modes& window, const Modes& truth) {
    for (std::size_t t = 0; t < kNewest; ++t) {
      double window_sum = 0.0;
      double truth_sum = 0.0;
      for (std::size_t i = 0; i < kImfs; ++i) {
        window_sum += window[i][t];
        truth_sum += truth[i][t];
        imf_error[i] += std::pow(window[i][t] - truth[i][t], 2);
        imf_truth[i] += std::pow(truth[i][t], 2);
        sum_error[i] += std::pow(window_sum - truth_sum, 2);
        sum_truth[i] += std::pow(truth_sum, 2);
      }
    }
  }
};

void print(const char* rule, const Errors& errors) {
  std::printf("|  %-6s |", rule);
  for (std::size_t i = 0; i < kImfs; ++i) {
    std::printf(" %.3f", std::sqrt(errors.imf_error[i] / errors.imf_truth[i]));
  }
  std::printf(" |");
  for (std::size_t i = 1; i < kImfs; ++i) {
    std::printf(" %.3f", std::sqrt(errors.sum_error[i] / errors.sum_truth[i]));
  }
  std::printf(" |\n");
}

/// One row a rule, over windows spread evenly over the series.
void study(const std::string& name, std::span<const double> series) {
  if (series.size() < kRecord) {
    return;
  }
  const std::size_t room = series.size() - kRecord;
  const std::size_t windows = std::min(kMaxWindows, room / kNewest + 1);
  Errors mirror;
  Errors linear;
  for (std::size_t i = 0; i < windows; ++i) {
    const auto record = series.subspan(windows == 1 ? 0 : i * room / (windows - 1), kRecord);
    const auto window = record.subspan(kMargin, kWindow);
    for (const BoundaryRule rule : {BoundaryRule::kMirror, BoundaryRule::kLinear}) {
      const Modes truth = decompose(record, kMargin + kWindow - kNewest, rule);
      (rule == BoundaryRule::kMirror ? mirror : linear)
          .add(decompose(window, kWindow - kNewest, rule), truth);
    }
  }
  std::printf("| %s (%zu windows) | | |\n", name.c_str(), windows);
  print("mirror", mirror);
  print("linear", linear);
}

std::vector<double> white_noise(std::size_t size) {
  std::mt19937_64 bits(20240501);
  std::normal_distribution<double> normal;
  std::vector<double> series(size);
  std::ranges::generate(series, [&] { return normal(bits); });
  return series;
}

/// AR(1) noise with the lag-1 autocorrelation of real gyros, 0.3.
std::vector<double> coloured_noise(std::size_t size) {
  std::vector<double> series = white_noise(size);
  for (std::size_t t = 1; t < size; ++t) {
    series[t] += 0.3 * series[t - 1];
  }
  return series;
}

/// Driving: slow turns and faster sway, each an AR(2) resonance, at 100 Hz, with white noise of 0.3 deg/s.
std::vector<double> driving(std::size_t size) {
  std::mt19937_64 bits(20240502);
  std::normal_distribution<double> normal;
  std::vector<double> series(size);
  const auto add_resonance = [&](double frequency_hz, double radius, double amplitude) {
    const double cosine = std::cos(2.0 * std::numbers::pi * frequency_hz / 100.0);
    std::vector<double> x(size);
    double energy = 0.0;
    for (std::size_t t = 2; t < size; ++t) {
      x[t] = 2.0 * radius * cosine * x[t - 1] - radius * radius * x[t - 2] + normal(bits);
      energy += x[t] * x[t];
    }
    const double gain = amplitude / std::sqrt(energy / static_cast<double>(size));
    std::ranges::transform(series, x, series.begin(),
                           [gain](double sum, double part) { return sum + gain * part; });
  };
  add_resonance(0.05, 0.9995, 5.0);
  add_resonance(1.5, 0.98, 1.0);
  for (double& value : series) {
    value += 0.3 * normal(bits);
  }
  return series;
}

/// One column of a gzipped CSV file; empty if the file or the column is absent.
std::vector<double> read_column(const std::string& path, const std::string& column) {
  std::vector<double> values;
  gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) {
    return values;
  }
  std::array<char, 4096> line{};
  std::ptrdiff_t wanted = -1;
  while (gzgets(file, line.data(), static_cast<int>(line.size())) != nullptr) {
    std::istringstream fields{std::string(line.data())};
    std::string field;
    for (std::ptrdiff_t i = 0; std::getline(fields, field, ','); ++i) {
      if (values.empty() && field == column) {
        wanted = i;
      } else if (i == wanted) {
        values.push_back(std::stod(field));
      }
    }
  }
  gzclose(file);
  return values;
}

struct Recording {
  const char* file;
  const char* unit;
  const char* title;
};

constexpr std::array kRecordings{
    Recording{"adis16405_imu1_static_100hz.csv.gz", "dps", "ADIS16405 run 1, still"},
    Recording{"wid_car_trial06_xsensdot_120hz.csv.gz", "dps", "car, trial 06"},
    Recording{"wid_car_trial09_xsensdot_120hz.csv.gz", "dps", "car, trial 09"},
    Recording{"drive0708_lsm6_100hz.csv.gz", "dps", "car roof, drive 0708"},
    Recording{"broad_02_undisturbed_slow_rotation_B_286hz.csv.gz", "radps", "hand, slow rotation"},
    Recording{"broad_10_undisturbed_slow_translation_A_286hz.csv.gz", "radps", "hand, slow translation"},
    Recording{"broad_24_disturbed_tapping_A_286hz.csv.gz", "radps", "hand, tapping"},
};

}  // namespace

int main() {
  const char* const folder = std::getenv("GYROD_DATA");
  constexpr std::size_t kSimulated = 200000;
  std::printf("| rule | IMF 1..%zu | sums IMF 1..2 to 1..%zu |\n|---|---|---|\n", kImfs, kImfs);
  study("white noise", white_noise(kSimulated));
  study("AR(1) noise", coloured_noise(kSimulated));
  study("simulated driving", driving(kSimulated));
  for (const Recording& recording : kRecordings) {
    for (const char axis : {'x', 'y', 'z'}) {
      const std::string column = std::string("gyro_") + axis + "_" + recording.unit;
      const std::string path =
          std::string(folder != nullptr ? folder : "../shared/data") + "/" + recording.file;
      study(std::string(recording.title) + ", " + axis, read_column(path, column));
    }
  }
  return 0;
}
