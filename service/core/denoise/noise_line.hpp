/// The noise line: how white noise spreads over the IMFs of our EMD.
#pragma once

#include <cstddef>

#include "core/emd/emd.hpp"

namespace gyrod::core {

/// Whether the tables here, and those of significance.hpp, are of this EMD.
[[nodiscard]] bool noise_line_holds(const EmdOptions& emd) noexcept;

/// Energy of IMF i of white noise, in parts of the noise's variance: E_1 = 0.63, roughly halving from mode to
/// mode. A table for IMF 1..9, halved per mode beyond; measured for 10 sifts and the default boundary rule
/// (noise_line.cpp says how).
/// @param imf 1 for the fastest
[[nodiscard]] double noise_line_energy(std::size_t imf) noexcept;

/// Mean period T_i of IMF i of white noise, samples: 2.87 for the fastest, roughly doubling. A table for IMF 1..9, doubled per mode
/// beyond; made with that of the energies, from windows of 4096 samples.
/// @param imf 1 for the fastest
[[nodiscard]] double noise_line_period(std::size_t imf) noexcept;

/// Variance of the white noise that would give IMF 1 this energy: the paper's assumption that IMF 1 holds
/// nothing else.
[[nodiscard]] double white_noise_variance(double imf1_energy) noexcept;

/// Part of white noise's variance that IMF `first` and all slower ones (and the residue) hold together: the
/// sum of their energies. That is 3 to 9 % above the variance of their sum, since neighbouring IMFs of noise
/// are slightly correlated.
/// @param first 1 for the fastest
[[nodiscard]] double noise_line_rest(std::size_t first) noexcept;

}  // namespace gyrod::core
