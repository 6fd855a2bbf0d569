// The two-speed estimator beside Butterworth filters tuned on the truth, on a car's reference gyro plus the noise of a still one:
// RMSE in deg/s over samples 2400..9600, by lag. The tables of docs/method.md.
//   GYROD_DATA=... joint_study [key=value ...]
// Keys (defaults): noise=1x (ADIS16405 run and axis), level=1 (what the noise is believed to be, in parts of its deviation), white=0 (1:
// its colour is unknown), source=1 (0: nothing is known), learned=0 (1: by the learner, on 60 s at rest), window=1024, hop=32,
// rate=120 (Hz: the drive resampled by lines, the noise sample by sample), told=1 (0: the estimator does not know the rate), start=0
// (first sample of the noise), from=20 and to=80 (s: the part that is judged), rivals=1 (0: no Butterworth filters, which take longest), axes=xyz, motion=car (hand: recordings of sensors
// that were moved by hand, their own rates the truth, no prototype to compare with); and core::JointOptions' members.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/evaluation/tuning.hpp"
#include "core/joint/joint_fit.hpp"
#include "core/joint/kalman_bank.hpp"
#include "core/noise/standstill_learner.hpp"
#include "core/noise/still_noise.hpp"
#include "joint_study_options.hpp"
#include "support/drive_rows.hpp"
#include "support/slow_gain.hpp"

namespace {

using namespace gyrod;
using benchmark::Arguments;
using benchmark::number;
using benchmark::options_of;

constexpr std::array<std::size_t, 6> kLags = {0, 4, 8, 12, 16, 32};

struct Prototype {
  const char* row;
  std::array<double, 3> rmse;  ///< at lag 0, 8, 16: the prototype's
};
constexpr std::array<Prototype, 18> kPrototype = {{{"06 x", {.240, .213, .211}},
                                                   {"06 y", {.241, .205, .203}},
                                                   {"06 z", {.118, .098, .099}},
                                                   {"09 x", {.273, .243, .243}},
                                                   {"09 y", {.262, .225, .225}},
                                                   {"09 z", {.152, .110, .107}},
                                                   {"06 x at 0.3", {.092, .088, .087}},
                                                   {"06 y at 0.3", {.092, .086, .086}},
                                                   {"06 z at 0.3", {.061, .053, .053}},
                                                   {"09 x at 0.3", {.101, .098, .097}},
                                                   {"09 y at 0.3", {.099, .092, .092}},
                                                   {"09 z at 0.3", {.070, .055, .054}},
                                                   {"06 x at 3", {.503, .458, .456}},
                                                   {"06 y at 3", {.504, .446, .439}},
                                                   {"06 z at 3", {.217, .194, .188}},
                                                   {"09 x at 3", {.521, .482, .482}},
                                                   {"09 y at 3", {.500, .441, .431}},
                                                   {"09 z at 3", {.298, .241, .225}}}};

test::NoiseChoice noise_choice(const Arguments& arguments) {
  const auto found = arguments.find("noise");
  const std::string choice = found == arguments.end() ? "1x" : found->second;
  test::NoiseChoice noise;
  noise.file = std::string("adis16405_imu") + choice.at(0) + "_static_100hz.csv.gz";
  noise.axis = static_cast<std::size_t>(choice.at(1) - 'x');
  noise.start = static_cast<std::size_t>(number(arguments, "start", 0));
  return noise;
}

/// What the learner makes of a minute at rest.
core::NoiseModel learned_at_rest(const test::DriveRow& row) {
  constexpr double kRadians = std::numbers::pi / 180.0;
  core::StandstillLearner learner(row.rate_hz);
  const auto minute = static_cast<std::size_t>(60.0 * row.rate_hz);
  for (const double dps : std::span(row.still_dps).first(minute)) {
    learner.step({dps * kRadians, dps * kRadians, dps * kRadians});
  }
  return core::scaled(learner.models()[0], 1.0 / kRadians);
}

/// What is believed of the row's noise.
core::NoiseModel believed(const test::DriveRow& row, const Arguments& arguments) {
  if (number(arguments, "source", 1) == 0.0) return {};
  if (number(arguments, "learned", 0) != 0.0) return core::scaled(learned_at_rest(row), core::kNoiseMargin);
  const auto fitted = core::still_noise(row.still_dps);
  if (!fitted) throw std::runtime_error(row.name + ": no noise model");
  const bool white = number(arguments, "white", 0) != 0.0;
  const core::NoiseModel model = white ? core::white_noise(core::noise_variance(*fitted)) : *fitted;
  return core::scaled(model, number(arguments, "level", core::kNoiseMargin));
}

/// The row at another sample rate: truth by lines, the noise sample by sample.
void resample(test::DriveRow& row, double rate_hz) {
  if (rate_hz == row.rate_hz) return;
  const double step = row.rate_hz / rate_hz;
  const auto count = static_cast<std::size_t>(static_cast<double>(row.truth_dps.size() - 1) / step);
  std::vector<double> noise;  // without the samples that the reference lost
  for (std::size_t n = 0; n < row.noisy_dps.size(); ++n) {
    const double difference = row.noisy_dps[n] - row.truth_dps[n];
    if (std::isfinite(difference)) noise.push_back(difference);
  }
  const std::vector<double> motion = test::bridged(row.truth_dps);
  std::vector<double> truth(count);
  for (std::size_t n = 0; n < count; ++n) {
    const double at = static_cast<double>(n) * step;
    const auto k = static_cast<std::size_t>(at);
    truth[n] = std::lerp(motion[k], motion[k + 1], at - static_cast<double>(k));
  }
  std::vector<double> noisy(count);
  for (std::size_t n = 0; n < count; ++n) {
    noisy[n] = truth[n] + noise[n % noise.size()];
  }
  row.truth_dps = std::move(truth);
  row.noisy_dps = std::move(noisy);
  row.rate_hz = rate_hz;
}

/// [begin, end) in samples; the answers to the last of them are 32 late at most.
std::array<std::size_t, 2> judged_part(const test::DriveRow& row, const Arguments& arguments) {
  const auto begin = static_cast<std::size_t>(number(arguments, "from", 20) * row.rate_hz);
  const auto end = static_cast<std::size_t>(number(arguments, "to", 80) * row.rate_hz);
  return {begin, std::min(end, row.noisy_dps.size() - 32)};
}

struct Figures {
  std::array<double, kLags.size()> rmse{};
  double normalised_error = 0.0;  ///< mean of error^2 / published variance, lag 16
  double innovation = 0.0;        ///< mean of nu^2 / S
  double alarm = 0.0;             ///< part of the windows whose noise is said to be wrong
  std::array<double, 2> gain{};   ///< of slow motion, as the guard scale-factor has it, lag 0 and 16
};

Figures run(const test::DriveRow& row, const core::NoiseModel& noise, const Arguments& arguments) {
  const auto hop = static_cast<std::size_t>(number(arguments, "hop", 32));
  const auto window = static_cast<std::size_t>(number(arguments, "window", 1024));
  const core::JointOptions options = options_of(arguments);
  core::JointFit fit(window, options);
  fit.set_sample_rate(number(arguments, "told", 1) != 0.0 ? row.rate_hz : 0.0);
  std::vector<core::KalmanBank> banks;
  for (const std::size_t lag : kLags) banks.emplace_back(options, lag);
  const auto model = std::make_unique<core::JointModel>();
  core::WindowReport report;
  const auto [begin, end] = judged_part(row, arguments);
  Figures figures;
  std::array<test::SlowGain, 2> gains{test::SlowGain(row.rate_hz), test::SlowGain(row.rate_hz)};
  double windows = 0.0;
  std::size_t judged = 0;
  for (std::size_t t = 0; t < end + 32; ++t) {
    const std::size_t to = t >= hop && t % hop == 0 ? t - hop : 0;
    if (to >= core::JointFit::kMinSamples) {
      const std::size_t from = to - std::min(to, window);
      fit.fit(std::span(row.noisy_dps).subspan(from, to - from), noise, *model, report);
      for (auto& bank : banks) bank.use(*model);
      if (t >= begin) {
        windows += 1.0;
        figures.alarm += model->noise.disagrees() ? 1.0 : 0.0;
      }
    }
    for (std::size_t i = 0; i < kLags.size(); ++i) {
      const core::BankEstimate estimate = banks[i].step(row.noisy_dps[t]).denoised;
      if (t < begin + kLags[i] || t >= end + kLags[i]) continue;
      const double error = estimate.rate - row.truth_dps[t - kLags[i]];
      if (std::isnan(error)) continue;
      if (kLags[i] == 0 || kLags[i] == 16) {
        const std::size_t then = t - kLags[i];
        gains[kLags[i] / 16].add(row.truth_dps[then], estimate.rate - row.noisy_dps[then]);
      }
      if (kLags[i] == 16) ++judged;
      figures.rmse[i] += error * error;
      if (kLags[i] == 16) figures.normalised_error += error * error / estimate.variance;
      if (kLags[i] == 16) figures.innovation += banks[i].normalised_innovation();
    }
  }
  const auto count = static_cast<double>(judged);
  for (double& sum : figures.rmse) sum = std::sqrt(sum / count);
  figures.normalised_error /= count;
  figures.innovation /= count;
  figures.alarm /= windows;
  figures.gain = {gains[0].value(), gains[1].value()};
  return figures;
}

std::array<double, kLags.size()> best_butterworth(const test::DriveRow& row, const Arguments& arguments) {
  std::array<double, kLags.size()> best{};
  const auto [begin, end] = judged_part(row, arguments);
  double sum = 0.0;  // raw is a rival, too
  std::size_t known = 0;
  for (std::size_t n = begin; n < end; ++n) {
    const double error = row.noisy_dps[n] - row.truth_dps[n];
    if (std::isnan(error)) continue;
    sum += error * error;
    ++known;
  }
  best.fill(std::sqrt(sum / static_cast<double>(known)));
  for (const core::Rival rival :
       {core::Rival::kButterworth1, core::Rival::kButterworth2, core::Rival::kButterworth4}) {
    const auto tuned = core::tune(rival, {row.noisy_dps, row.truth_dps, {begin, end}}, kLags);
    for (std::size_t i = 0; i < kLags.size(); ++i) best[i] = std::min(best[i], tuned[i].rmse);
  }
  return best;
}

void print(const char* what, const std::array<double, kLags.size()>& values) {
  std::printf("%s", what);
  for (const double value : values) std::printf(" %5.3f", value);
}

bool has_motion_by_hand(const Arguments& arguments) {
  const auto found = arguments.find("motion");
  return found != arguments.end() && found->second == "hand";
}

int study(const Arguments& arguments) {
  std::printf("%-12s %41s", "row", "RMSE at lag 0, 4, 8, 12, 16, 32");
  std::printf(" | of Butterworth's | of the prototype's 0, 8, 16 | NEE, NIS, alarm | slow gain 0, 16\n");
  const bool rivals = number(arguments, "rivals", 1) != 0.0;
  double worst_rival = 0.0;
  double worst_prototype = 0.0;
  double sum = 0.0;
  std::size_t index = 0;
  std::size_t cells = 0;
  const auto axes = arguments.find("axes");
  const bool by_hand = has_motion_by_hand(arguments);
  const auto choice = noise_choice(arguments);
  for (auto& row : by_hand ? test::hand_rows(choice) : test::drive_rows(choice)) {
    const auto* prototype = by_hand ? nullptr : &kPrototype.at(index++).rmse;
    if (axes != arguments.end() && axes->second.find("xyz"[row.axis]) == std::string::npos) continue;
    const core::NoiseModel noise = believed(row, arguments);
    if (!by_hand) resample(row, number(arguments, "rate", 120));
    const Figures figures = run(row, noise, arguments);
    std::printf("%-12s ", row.name.c_str());
    print("", figures.rmse);
    if (rivals) {
      auto ratios = best_butterworth(row, arguments);
      for (std::size_t i = 0; i < kLags.size(); ++i) {
        ratios[i] = figures.rmse[i] / ratios[i];
        worst_rival = std::max(worst_rival, ratios[i]);
      }
      print(" |", ratios);
    }
    std::printf(" |");
    for (std::size_t i = 0; prototype != nullptr && i < 3; ++i) {
      const double ratio = figures.rmse[2 * i] / (*prototype)[i];
      worst_prototype = std::max(worst_prototype, ratio);
      sum += std::log(ratio);
      ++cells;
      std::printf(" %5.3f", ratio);
    }
    std::printf(" | %4.2f %4.2f %4.2f | %5.3f %5.3f\n", figures.normalised_error, figures.innovation,
                figures.alarm, figures.gain[0], figures.gain[1]);
    std::fflush(stdout);
  }
  std::printf("worst of Butterworth's %.3f, of the prototype's %.3f; geometric mean of the latter %.4f\n",
              worst_rival, worst_prototype, cells > 0 ? std::exp(sum / static_cast<double>(cells)) : 0.0);
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
