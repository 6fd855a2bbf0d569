#include "core/denoise/noise_line.hpp"

#include <array>
#include <cassert>
#include <cmath>

namespace gyrod::core {
namespace {

// Means over 20 000 windows of N = 1024 samples of white noise (standard error 0.5 % or less, IMF 9: 1 %),
// made by
//   emd_noise_line 20000
// (tests/benchmark/emd_noise_line.cpp), which prints other sizes too: from N = 512 to 4096, IMF 1..5 stay
// within 1.3 % of these values, and IMF 6..9 within 8 % where most windows have the IMF.
constexpr std::array<double, 9> kEnergy = {0.63346, 0.22159, 0.11075, 0.05730, 0.02993,
                                           0.01570, 0.00823, 0.00437, 0.00209};

// Samples; `emd_noise_line 5000`, N = 4096, where windows bind the slow modes least.
constexpr std::array<double, 9> kPeriod = {2.867,  5.955,   12.046,  24.130, 48.196,
                                           96.396, 193.379, 390.535, 799.136};

}  // namespace

bool noise_line_holds(const EmdOptions& emd) noexcept {
  constexpr EmdOptions kTabulated;
  return emd.sifts == kTabulated.sifts && emd.boundary == kTabulated.boundary;
}

double noise_line_energy(std::size_t imf) noexcept {
  assert(imf >= 1);
  if (imf <= kEnergy.size()) return kEnergy[imf - 1];
  double energy = kEnergy.back();
  for (std::size_t i = kEnergy.size(); i < imf; ++i) energy *= 0.5;
  return energy;
}

double noise_line_period(std::size_t imf) noexcept {
  assert(imf >= 1);
  if (imf <= kPeriod.size()) return kPeriod[imf - 1];
  return std::ldexp(kPeriod.back(), static_cast<int>(imf - kPeriod.size()));
}

double white_noise_variance(double imf1_energy) noexcept { return imf1_energy / kEnergy.front(); }

double noise_line_rest(std::size_t first) noexcept {
  // Beyond the table the energies halve, so all that follow a mode hold as much as the mode itself.
  double sum = 0.0;
  for (std::size_t imf = first; imf <= kEnergy.size(); ++imf) sum += noise_line_energy(imf);
  return sum + (first > kEnergy.size() ? 2.0 * noise_line_energy(first) : kEnergy.back());
}

}  // namespace gyrod::core
