/// A window taken apart and screened: IMFs, residue, and which of them are noise, mixed and signal.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/denoise/screening.hpp"
#include "core/denoise/window_report.hpp"
#include "core/emd/emd.hpp"
#include "core/signal/autocorrelation.hpp"

namespace gyrod::core {

/// [Yang2019] steps 1 to 4. Sizes its workspace once; no call allocates after that. Not thread-safe.
class Decomposition {
 public:
  /// @throws std::invalid_argument for an EMD option outside its range, room for more than kMaxImfs IMFs, a false-alarm rate outside its range, or the significance rule
  /// with other sifts or another boundary rule than the noise line was made for
  Decomposition(std::size_t max_samples, const EmdOptions& emd, const ScreeningOptions& screening);

  /// Decomposes and screens. Except under the paper's rule decomposing ends after the first signal IMF: what remains beside it is kept
  /// anyway.
  /// @param report receives IMF figures, classes, j, k and noise floor; the rest stays as it is
  /// @param noise_variance of the white noise where it is known, unit^2; none: what IMF 1 stands for
  /// @pre 1 <= window.size() <= max_samples, every value finite
  void take_apart(std::span<const double> window, WindowReport& report,
                  std::optional<double> noise_variance = {}) noexcept;

  /// Takes out IMF 1 alone. @return variance of the white noise that it stands for, unit^2; 0 where there is no IMF
  [[nodiscard]] double white_noise_variance_of(std::span<const double> window) noexcept;

  /// IMF i of the last window, 0 for the fastest; its samples may be changed, for reconstruct().
  [[nodiscard]] std::span<double> imf(std::size_t index) noexcept;
  [[nodiscard]] std::span<const double> imf(std::size_t index) const noexcept;
  [[nodiscard]] std::span<const double> residue() const noexcept { return emd_.residue(); }

  /// Adds up the residue and IMF first .. count-1, counted from 0. @pre out.size() is the window's
  void reconstruct(std::size_t first, std::size_t count, std::span<double> out) const noexcept;

 private:
  void decompose(std::span<const double> window, WindowReport& report,
                 std::optional<double> known_variance) noexcept;
  void screen(std::span<const double> window, WindowReport& report) noexcept;

  ScreeningOptions screening_;
  SignificanceTest significance_;
  bool line_holds_;
  std::size_t max_samples_;
  std::size_t samples_ = 0;
  Emd emd_;
  Autocorrelation autocorrelation_;
  std::vector<double> imfs_;       ///< max_imfs + 1 rows of max_samples
  std::vector<double> reference_;  ///< what the PCC is taken against
};

}  // namespace gyrod::core
