// Prints the table of docs/allan.md: the three fits on simulated noise whose coefficients are known.
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "core/allan/allan_deviation.hpp"
#include "core/allan/noise_coefficients.hpp"
#include "core/simulation/gyro_errors.hpp"

namespace {

using namespace gyrod::core;

constexpr double kRate = 100.0;
constexpr std::size_t kSamples = 360'000;  // an hour
constexpr unsigned kSeeds = 40;
constexpr const char* kLetters = "QNBKR";
using Five = std::array<double, kNoiseTerms>;

std::vector<double> noise(const Five& truth, unsigned seed) {
  GyroErrorOptions options = no_gyro_errors();
  options.white_noise_density = truth[1];
  options.bias_instability_radps = truth[2];
  options.rate_random_walk = truth[3];
  GyroErrors errors(options, kRate, seed);
  std::mt19937_64 bits(seed);
  std::normal_distribution<double> normal;
  double angle = truth[0] * normal(bits);
  std::vector<double> rate(kSamples);
  for (std::size_t n = 0; n < kSamples; ++n) {
    const double next = truth[0] * normal(bits);
    rate[n] = errors.measure(0.0) + (next - angle) * kRate + truth[4] * static_cast<double>(n) / kRate;
    angle = next;
  }
  return rate;
}

/// One term by one method over the seeds.
struct Tally {
  double seen = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  double held = 0.0;  ///< truth within two standard errors

  void add(const Coefficient& found, double truth) {
    if (!found.observable) return;
    seen += 1.0;
    sum += found.value;
    squares += found.value * found.value;
    if (std::abs(found.value - truth) <= 2.0 * found.standard_error) held += 1.0;
  }
};

void print(const char* method, char letter, double truth, const Tally& tally) {
  if (truth == 0.0 && tally.seen == 0.0) return;
  std::printf("| %c | %.1e | %s | %.0f %% |", letter, truth, method, 100.0 * tally.seen / kSeeds);
  if (tally.seen == 0.0) {
    std::printf(" - | - | - |\n");
    return;
  }
  const double mean = tally.sum / tally.seen;
  const double deviation = std::sqrt(std::max(0.0, tally.squares / tally.seen - mean * mean));
  std::printf(" %.2e | %.1e | %.0f %% |\n", mean, deviation, 100.0 * tally.held / tally.seen);
}

void study(const char* name, const Five& truth) {
  std::array<std::array<Tally, kNoiseTerms>, 3> tallies{};
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const auto points = allan_deviation(noise(truth, seed), kRate);
    const std::array<NoiseCoefficients, 3> found = {fit_coefficients(points), slope_coefficients(points),
                                                    polynomial_coefficients(points)};
    for (std::size_t method = 0; method < found.size(); ++method) {
      for (std::size_t t = 0; t < kNoiseTerms; ++t) {
        tallies[method][t].add(found[method].terms[t], truth[t]);
      }
    }
  }
  std::printf(
      "\n%s\n\n| | truth | method | observable | mean | spread | in 2 s.e. "
      "|\n|---|---|---|---|---|---|---|\n",
      name);
  constexpr std::array<const char*, 3> kMethods = {"least squares", "slopes", "polynomial"};
  for (std::size_t t = 0; t < kNoiseTerms; ++t) {
    for (std::size_t method = 0; method < kMethods.size(); ++method) {
      print(kMethods[method], kLetters[t], truth[t], tallies[method][t]);
    }
  }
}

}  // namespace

int main() {
  study("White noise", {0.0, 7e-4, 0.0, 0.0, 0.0});
  study("White noise and bias instability", {0.0, 7e-4, 4e-4, 0.0, 0.0});
  study("White noise and rate random walk", {0.0, 7e-4, 0.0, 4e-5, 0.0});
  study("White noise, weak bias instability, rate random walk", {0.0, 7e-4, 1.5e-4, 4e-5, 0.0});
  study("Quantization, white noise, rate ramp", {4e-5, 7e-4, 0.0, 0.0, 1e-6});
}
