/// Shorthands of the EMD tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/emd/emd.hpp"
#include "support/signals.hpp"

namespace gyrod::testing {

/// All IMFs and the residue of a signal.
struct Decomposition {
  std::vector<Signal> imfs;
  Signal residue;

  bool operator==(const Decomposition&) const = default;
};

inline Decomposition decompose(core::Emd& emd, std::span<const double> signal) {
  Decomposition result;
  Signal imf(signal.size());
  emd.start(signal);
  while (emd.next_imf(imf)) {
    result.imfs.push_back(imf);
  }
  result.residue.assign(emd.residue().begin(), emd.residue().end());
  return result;
}

inline Decomposition decompose(std::span<const double> signal, const core::EmdOptions& options = {},
                               core::EmdKernel kernel = core::EmdKernel::kFastest) {
  core::Emd emd(signal.size(), options, kernel);
  return decompose(emd, signal);
}

inline bool is_finite(const Decomposition& parts) {
  return std::ranges::all_of(parts.imfs, [](const Signal& imf) { return is_finite(imf); }) &&
         is_finite(parts.residue);
}

/// max |sum IMF + r - x|.
inline double completeness_error(const Decomposition& parts, const Signal& signal) {
  Signal total = parts.residue;
  for (const Signal& imf : parts.imfs) {
    total = sum(total, imf);
  }
  return peak(sum(total, signal, -1.0));
}

/// Largest difference of two decompositions, infinite if they differ in the number of IMFs.
inline double difference(const Decomposition& a, const Decomposition& b) {
  if (a.imfs.size() != b.imfs.size()) {
    return std::numeric_limits<double>::infinity();
  }
  double largest = peak(sum(a.residue, b.residue, -1.0));
  for (std::size_t i = 0; i < a.imfs.size(); ++i) {
    largest = std::max(largest, peak(sum(a.imfs[i], b.imfs[i], -1.0)));
  }
  return largest;
}

}  // namespace gyrod::testing
