// Energy and mean period of the IMFs of white noise at the default options, for the table in
// service/core/denoise/noise_line.cpp:
//
//   emd_noise_line [SEEDS]
//
// E_i = variance of IMF i over that of the noise, T_i its mean period in samples, both means over the seeds
// that have the IMF.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "core/emd/emd.hpp"
#include "core/signal/moments.hpp"

namespace {

using namespace gyrod::core;

constexpr std::size_t kImfs = 10;

struct Line {
  std::array<double, kImfs> energy{};
  std::array<double, kImfs> period{};
  std::array<unsigned, kImfs> seeds{};
};

Line measure(std::size_t size, unsigned seeds) {
  Emd emd(size);
  std::vector<double> signal(size);
  std::vector<double> imf(size);
  Line line;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    std::mt19937_64 bits(seed);
    std::normal_distribution<double> normal;
    std::ranges::generate(signal, [&] { return normal(bits); });
    emd.start(signal);
    for (std::size_t i = 0; i < kImfs && emd.next_imf(imf); ++i) {
      line.energy[i] += variance(imf);
      line.period[i] += mean_period(imf);
      ++line.seeds[i];
    }
  }
  return line;
}

void print(std::size_t size, const Line& line) {
  std::printf("\nN = %zu\n i      E_i      T_i  E_i T_i  seeds\n", size);
  for (std::size_t i = 0; i < kImfs && line.seeds[i] > 0; ++i) {
    const double energy = line.energy[i] / line.seeds[i];
    const double period = line.period[i] / line.seeds[i];
    std::printf("%2zu %8.5f %8.3f %8.4f %6u\n", i + 1, energy, period, energy * period, line.seeds[i]);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const unsigned seeds = argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 20000;
  for (const std::size_t size : {512U, 1024U, 2048U, 4096U}) {
    print(size, measure(size, seeds));
  }
  return 0;
}
