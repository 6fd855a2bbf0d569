// Energy and mean period of the IMFs of white noise, and how the energy of one window scatters, for the tables
// in service/core/denoise/noise_line.cpp:
//
//   emd_noise_line [SEEDS]
//
// for both boundary rules at 10 sifts and windows of 512 to 4096 samples. Of the seeds that have the IMF:
//   E_i   mean of its variance over that of the noise
//   T_i   mean of its mean period, samples
//   known spread of ln(energy) where the noise's variance is known
//   imf1  spread of ln(excess), the energy over that of IMF 1 in the same window, in parts of the line
//   nu    degrees of freedom of the chi-squared distribution with that spread (Wilson and Hilferty), and over N / T_i
//   q..   quantiles of the excess
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "core/emd/emd.hpp"
#include "core/signal/moments.hpp"

namespace {

using namespace gyrod::core;

constexpr std::size_t kImfs = 10;

/// What the windows gave that have this IMF.
struct Mode {
  std::vector<double> energy;
  std::vector<double> to_first;  ///< energy over that of IMF 1
  double period = 0.0;           ///< sum of mean periods
};
using Line = std::array<Mode, kImfs>;

Line measure(const EmdOptions& options, std::size_t size, unsigned seeds) {
  Emd emd(size, options);
  std::vector<double> signal(size);
  std::vector<double> imf(size);
  Line line;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    std::mt19937_64 bits(seed);
    std::normal_distribution<double> normal;
    std::ranges::generate(signal, [&] { return normal(bits); });
    emd.start(signal);
    double first = 0.0;
    for (std::size_t i = 0; i < kImfs && emd.next_imf(imf); ++i) {
      const double energy = variance(imf);
      if (i == 0) first = energy;
      line[i].energy.push_back(energy);
      line[i].to_first.push_back(energy / first);
      line[i].period += mean_period(imf);
    }
  }
  return line;
}

double spread_of_log(std::vector<double> values) {
  for (double& value : values) value = std::log(value);
  return std::sqrt(variance(values));
}

/// The cube root of a chi-squared variable over its nu is normal with mean 1 - 2 / (9 nu), variance 2 / (9 nu): nu from the ratio of both.
double degrees_of_freedom(std::vector<double> values) {
  for (double& value : values) value = std::cbrt(value);
  const double ratio = variance(values) / (mean(values) * mean(values));
  // ratio = v / (1 - v)^2 with v = 2 / (9 nu)
  const double v = (1.0 + 2.0 * ratio - std::sqrt(1.0 + 4.0 * ratio)) / (2.0 * ratio);
  return 2.0 / (9.0 * v);
}

double quantile(std::vector<double> values, double part) {
  const auto place = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + place);
  return values[static_cast<std::size_t>(place)];
}

void print(std::size_t size, const Line& line) {
  std::printf(
      "\nN = %zu\n i      E_i      T_i known  imf1       nu nu T/N   q0.1   q0.5   q2.5    q50  q97.5  q99.5 "
      " q99.9  seeds\n",
      size);
  const double first = mean(line[0].energy);
  for (std::size_t i = 0; i < kImfs && line[i].energy.size() > 1; ++i) {
    const Mode& mode = line[i];
    const double energy = mean(mode.energy);
    const double period = mode.period / static_cast<double>(mode.energy.size());
    std::vector<double> excess = mode.to_first;
    for (double& value : excess) value *= first / energy;
    const double nu = i == 0 ? degrees_of_freedom(mode.energy) : degrees_of_freedom(excess);
    std::printf("%2zu %8.5f %8.3f %.3f %.3f %8.2f %6.3f", i + 1, energy, period, spread_of_log(mode.energy),
                spread_of_log(excess), nu, nu * period / static_cast<double>(size));
    for (const double part : {0.001, 0.005, 0.025, 0.5, 0.975, 0.995, 0.999}) {
      std::printf(" %6.3f", quantile(excess, part));
    }
    std::printf(" %6zu\n", mode.energy.size());
  }
}

}  // namespace

int main(int argc, char** argv) {
  const unsigned seeds = argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 20000;
  for (const BoundaryRule rule : {BoundaryRule::kMirror, BoundaryRule::kLinear}) {
    EmdOptions options;
    options.boundary = rule;
    std::printf("\nboundary rule %d\n", static_cast<int>(rule));
    for (const std::size_t size : {512U, 1024U, 2048U, 4096U}) print(size, measure(options, size, seeds));
  }
  return 0;
}
