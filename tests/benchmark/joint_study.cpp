// The two-speed estimator beside Butterworth filters tuned on the truth, on a car's reference gyro plus the noise of a still one:
// RMSE in deg/s over samples 2400..9600, by lag. The tables of docs/measured.md.
//   GYROD_DATA=... joint_study [key=value ...]
// Keys (defaults): noise=1x (ADIS16405 run and axis; mx: MPU6050), level=1 (what the noise is believed to be, in parts of its deviation), white=0 (1:
// its colour is unknown), source=1 (0: nothing is known), learned=0 (1: by the learner, on 60 s at rest), window=1024, hop=32,
// rate=120 (Hz: the drive resampled by lines, the noise sample by sample), told=1 (0: the estimator does not know the rate), start=0
// (first sample of the noise), spikes=0 (1000: one sample in so many is wrong by 12 deviations of the noise), sine=0 (amplitude of a sine in the noise and in what it is calibrated on, in deviations of the noise), sine_at=0.2, second_sine_at=0 (cycles per sample; 0: none), noise_low_pass=0 (Hz: the sensor's own, second order; 0: none),
// begin=0 (s of the drive that the estimator does not see), from=20 and to=80 (s: the part that is judged), rivals=1 (0: no Butterworth filters, which take longest), axes=xyz, digits=3 (of RMSE), band=0 (Hz: the signal band and what of the truth is asked for), motion=car (hand: recordings of sensors
// that were moved by hand, their own rates the truth; smooth: swell, roundabouts and bends, made; simulated: six drives of gyrod simulate, 100 Hz; shaking: a car's roof, 100 Hz, 200 s from shaking_from=30 on; these have no prototype to compare with); and core::JointOptions' members.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include "joint_study_options.hpp"
#include "support/joint_drive.hpp"

namespace {

using namespace gyrod;
using benchmark::Arguments;
using benchmark::number;

test::NoiseChoice noise_choice(const Arguments& arguments) {
  const auto found = arguments.find("noise");
  const std::string choice = found == arguments.end() ? "1x" : found->second;
  test::NoiseChoice noise;
  noise.file = std::string("adis16405_imu") + choice.at(0) + "_static_100hz.csv.gz";
  noise.axis = static_cast<std::size_t>(choice.at(1) - 'x');
  noise.start = static_cast<std::size_t>(number(arguments, "start", 0));
  if (choice.at(0) == 'm') return test::mpu6050_noise(noise.axis, noise.start);
  return noise;
}

test::JointSetting setting_of(const Arguments& arguments) {
  test::JointSetting setting;
  setting.options = benchmark::options_of(arguments);
  setting.window = static_cast<std::size_t>(number(arguments, "window", 1024));
  setting.told_rate = number(arguments, "told", 1) != 0.0;
  setting.from_s = number(arguments, "from", setting.from_s);
  setting.to_s = number(arguments, "to", setting.to_s);
  setting.max_signal_hz = number(arguments, "band", 0);
  return setting;
}

/// What is believed of the row's noise.
core::NoiseModel believed(const test::DriveRow& row, const Arguments& arguments) {
  if (number(arguments, "source", 1) == 0.0) return {};
  if (number(arguments, "learned", 0) != 0.0)
    return core::scaled(test::learned_at_rest(row), core::kNoiseMargin);
  const auto fitted = core::still_noise(row.still_dps);
  if (!fitted) throw std::runtime_error(row.name + ": no noise model");
  const bool white = number(arguments, "white", 0) != 0.0;
  const core::NoiseModel model = white ? core::white_noise(core::noise_variance(*fitted)) : *fitted;
  return core::scaled(model, number(arguments, "level", core::kNoiseMargin));
}

/// Single wrong samples of 12 standard deviations, one in so many by chance, in the noise and in what it is calibrated on.
void add_spikes(test::DriveRow& row, double one_in) {
  if (one_in <= 0.0) return;
  const double size = 12.0 * std::sqrt(core::noise_variance(core::still_noise(row.still_dps).value()));
  std::mt19937 bits(1);
  std::uniform_real_distribution<double> chance(0.0, one_in);
  for (std::vector<double>* series : {&row.noisy_dps, &row.still_dps}) {
    for (double& value : *series) {
      const double drawn = chance(bits);
      if (drawn < 1.0) value += drawn < 0.5 ? size : -size;
    }
  }
}

/// The row without its first seconds.
void begin_at(test::DriveRow& row, double begin_s) {
  const auto samples = std::min(row.noisy_dps.size(), static_cast<std::size_t>(begin_s * row.rate_hz));
  row.truth_dps.erase(row.truth_dps.begin(), row.truth_dps.begin() + static_cast<std::ptrdiff_t>(samples));
  row.noisy_dps.erase(row.noisy_dps.begin(), row.noisy_dps.begin() + static_cast<std::ptrdiff_t>(samples));
}

void print_cells(const char* what, const test::ByLag& values, int digits) {
  std::printf("%s", what);
  for (const double value : values) std::printf(" %5.*f", digits, value);
}

std::vector<test::DriveRow> rows_of(const std::string& motion, const test::NoiseChoice& noise,
                                    double shaking_from_s) {
  if (motion == "car") return test::drive_rows(noise);
  if (motion == "hand") return test::hand_rows(noise);
  if (motion == "smooth") return test::smooth_rows(noise);
  if (motion == "shaking") return test::shaking_rows(noise, shaking_from_s);
  if (motion == "simulated") return test::simulated_rows(noise);
  throw std::runtime_error("motion=" + motion + ": expected car, hand, shaking, smooth or simulated");
}

/// Of all rows so far.
class Totals {
 public:
  /// Prints the row's RMSE in parts of the tuned Butterworths'.
  void compare_rivals(const test::DriveRow& row, const test::JointSetting& setting,
                      const test::JointFigures& figures, int digits) {
    auto ratios = test::best_butterworth(row, setting);
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      ratios[i] = figures.rmse[i] / ratios[i];
      worst_rival_ = std::max(worst_rival_, ratios[i]);
    }
    print_cells(" |", ratios, digits);
  }
  /// And of the prototype's, where it knew the row.
  void compare_prototype(const test::DriveRow& row, const test::JointFigures& figures) {
    const test::PrototypeRow* prototype = test::prototype_of(row);
    for (std::size_t i = 0; prototype != nullptr && i < 3; ++i) {
      const double ratio = figures.rmse[test::PrototypeRow::kLagIndex[i]] / prototype->rmse[i];
      worst_prototype_ = std::max(worst_prototype_, ratio);
      logarithms_ += std::log(ratio);
      ++cells_;
      std::printf(" %5.3f", ratio);
    }
  }
  void count_gains(const test::DriveRow& row, const test::JointFigures& figures) {
    Gains& gains = gains_[row.noise_scale];
    ++gains.rows;
    if (test::fails(figures.gain[0])) ++gains.off_at_once;
    if (test::fails(figures.gain[1])) ++gains.off;
  }
  void print() const {
    if (worst_rival_ > 0.0) std::printf("worst of Butterworth's %.3f\n", worst_rival_);
    if (cells_ > 0)
      std::printf("worst of the prototype's %.3f, geometric mean %.4f\n", worst_prototype_,
                  std::exp(logarithms_ / static_cast<double>(cells_)));
    for (const auto& [scale, gains] : gains_)
      std::printf("slow gain surely off by more than 0.005, noise x %g: lag 0 %zu, 16 %zu of %zu\n", scale,
                  gains.off_at_once, gains.off, gains.rows);
  }

 private:
  struct Gains {
    std::size_t rows = 0;
    std::size_t off_at_once = 0;
    std::size_t off = 0;
  };
  double worst_rival_ = 0.0;
  double worst_prototype_ = 0.0;
  double logarithms_ = 0.0;
  std::size_t cells_ = 0;
  std::map<double, Gains> gains_;  ///< by the noise's scale
};

int study(const Arguments& arguments) {
  std::printf("%-12s %41s", "row", "RMSE at lag 0, 4, 8, 12, 16, 32");
  std::printf(
      " | of Butterworth's | of the prototype's 0, 8, 16 | NEE, NIS, alarm | slow gain 0, 16, +- standard "
      "error\n");
  const bool rivals = number(arguments, "rivals", 1) != 0.0;
  const auto digits = static_cast<int>(number(arguments, "digits", 3));
  const auto axes = arguments.find("axes");
  const auto found = arguments.find("motion");
  const std::string motion = found == arguments.end() ? "car" : found->second;
  const auto choice = noise_choice(arguments);
  const test::JointSetting setting = setting_of(arguments);
  Totals totals;
  for (auto& row : rows_of(motion, choice, number(arguments, "shaking_from", 30))) {
    if (axes != arguments.end() && axes->second.find("xyz"[row.axis]) == std::string::npos) continue;
    add_spikes(row, number(arguments, "spikes", 0));
    for (const auto& [key, cycles] : {std::pair("sine_at", 0.2), std::pair("second_sine_at", 0.0)})
      test::add_sine(row, number(arguments, "sine", 0), number(arguments, key, cycles));
    begin_at(row, number(arguments, "begin", 0));
    if (motion == "car" || motion == "smooth") test::resample(row, number(arguments, "rate", 120));
    const double low_pass_hz = number(arguments, "noise_low_pass", 0);
    if (low_pass_hz > 0.0) test::low_pass_noise(row, low_pass_hz);
    const core::NoiseModel noise = believed(row, arguments);
    if (setting.max_signal_hz > 0.0) test::limit(row, setting.max_signal_hz);
    const test::JointFigures figures = test::joint_figures(row, noise, setting);
    std::printf("%-12s ", row.name.c_str());
    print_cells("", figures.rmse, digits);
    if (rivals) totals.compare_rivals(row, setting, figures, digits);
    std::printf(" |");
    totals.compare_prototype(row, figures);
    std::printf(" | %4.2f %4.2f %4.2f |", figures.normalised_error, figures.innovation, figures.alarm);
    for (const core::Measured& gain : figures.gain)
      std::printf(" %5.3f +- %5.3f", gain.value, gain.standard_error);
    std::printf("\n");
    std::fflush(stdout);
    totals.count_gains(row, figures);
  }
  totals.print();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const auto equals = argument.find('=');
    if (equals == std::string::npos) {
      std::fprintf(stderr, "joint_study: %s; expected key=value\n", argv[i]);
      return 2;
    }
    arguments[argument.substr(0, equals)] = argument.substr(equals + 1);
  }
  if (!test::has_drive_rows(noise_choice(arguments))) {
    std::fprintf(stderr, "joint_study: no recordings in %s\n", test::data_folder().c_str());
    return 1;
  }
  return study(arguments);
}
