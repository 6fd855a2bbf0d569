/// Expectation-maximisation of modes in the Whittle likelihood.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/joint/joint_options.hpp"
#include "core/joint/spectral_kernel.hpp"
#include "core/joint/spectral_mode.hpp"
#include "core/noise/noise_model.hpp"

namespace gyrod::core {

/// Fits the spectra of modes to a window's periodogram I beside the noise's known spectrum R:
///   M(w) = sum_j S_j(w) + R(w),   S_j = drive_j / |a_j|^2,   ln L = -sum_w (ln M + I / M).
/// One iteration: the expected periodogram of every mode given the sum,
///   post_j = (S_j / M)^2 I + S_j (1 - S_j / M),
/// where no more of a mode that is not slow is taken to be in the bin at frequency 0 than 0.9 of its variance;
/// its autocovariances, narrowed no further than a least bandwidth, hardly any for the slow mode, and Levinson's recursion.
/// Sizes its workspace once; no call allocates after that. Not thread-safe.
/// Source: Whittle 1953; Dempster, Laird, Rubin 1977; docs/joint.md.
class WhittleFit {
 public:
  /// @param transform_samples a power of two, at least 8: frequencies are 2 pi k / transform_samples, k = 0 .. half of it
  /// @param kernel all that are available give the same bits
  WhittleFit(std::size_t transform_samples, double bandwidth_cycles, EmdKernel kernel = EmdKernel::kFastest);

  /// Takes the window's periodogram and the noise, both in the same unit: white, colour, and its lines, each as uncertain as it is
  /// (noise_spectrum()), or, where these are better known, as the modes that they are taken for.
  /// @pre periodogram has transform_samples / 2 + 1 bins; is_usable(noise); lines.size() <= kMaxNoiseLines
  void observe(std::span<const double> periodogram, const NoiseModel& noise,
               std::span<const SpectralMode> lines = {}) noexcept;

  /// Another periodogram of the window beside the same noise. @pre observe() was called, and as above
  void observe(std::span<const double> periodogram) noexcept;

  /// The noise's spectrum at every bin, as observe() was told.
  [[nodiscard]] std::span<const double> noise() const noexcept { return noise_; }
  /// The same without the lines.
  [[nodiscard]] std::span<const double> noise_without_lines() const noexcept { return rest_; }

  /// What of the window is more than noise without its lines, in the eyes of the fit: the modes' spectra and the lines', as strong as is expected of them in
  /// this window,
  ///   sum_j S_j + e L,   e = sum (L + (L / M)^2 (I - M)) / sum L,
  /// with L the lines that observe() was told; valid until the next call of anything here.
  [[nodiscard]] std::span<const double> explained(const ModeSet& modes) noexcept;

  /// What every iteration takes off a mode's drive from here on, the slow mode's excepted, in parts of it. 0 at the start.
  void set_shrinkage(double shrinkage) noexcept { kept_ = 1.0 - shrinkage; }

  /// Improves the modes. A mode that loses all its power has drive 0 and stays so.
  void iterate(ModeSet& modes, int iterations) noexcept;

  /// Takes out the weakest mode other than the slow one while what it adds to 2 ln L is below `gain`.
  void prune(ModeSet& modes, double gain) noexcept;

  /// ln L of these modes, up to a constant.
  [[nodiscard]] double log_likelihood(const ModeSet& modes) noexcept;

  /// A band of the window's spectrum, and what is missing there.
  struct Band {
    double centre_cycles = 0.0;  ///< cycles per sample
    double width_cycles = 0.0;
    double power = 0.0;  ///< variance that modes and noise do not explain, in the periodogram's unit
    double gain = 0.0;   ///< 0 where no band has more power than is explained
  };
  /// The band that these modes explain least: of those of 4, 8, 16 ... bins, an eighth of all at the most, the one whose mean m of I / M buys most,
  ///   gain = 2 w (m - 1 - ln m),   w bins,
  /// of 2 ln L if all of it were m times as strong. What a line of the noise may hold is not missing. @pre !modes.full()
  [[nodiscard]] Band least_explained(const ModeSet& modes) noexcept;

  /// Where a mode's power lies, and how much it is.
  struct Weight {
    double centre_cycles =
        0.0;             ///< centre of gravity of its spectrum, cycles per sample; 0 where there is no power
    double power = 0.0;  ///< its variance, in the periodogram's unit
  };
  [[nodiscard]] Weight weigh(const SpectralMode& mode) noexcept;
  /// The mode's variance above this frequency, cycles per sample, in the periodogram's unit.
  [[nodiscard]] double power_from(const SpectralMode& mode, double cycles) noexcept;

  /// The mode whose autocovariances r_0 .. r_kModeOrder are given.
  [[nodiscard]] SpectralMode mode_of(std::span<const double> autocovariance, bool slow) const noexcept;

 private:
  void sum_noise(const NoiseModel& noise) noexcept;
  [[nodiscard]] std::span<const double> spectrum_of(const SpectralMode& mode) noexcept;
  void sum_spectra(const ModeSet& modes) noexcept;
  void bound_slowest_bin(const ModeSet& modes) noexcept;
  void sum_up_missing(std::span<double> power) noexcept;
  void maximise(SpectralMode& mode, std::span<const double> spectrum) noexcept;
  [[nodiscard]] double gain_of(std::span<const double> spectrum) const noexcept;
  [[nodiscard]] std::span<double> row(std::size_t mode) noexcept {
    return {spectra_.data() + mode * bins_, bins_};
  }

  const SpectralKernel* kernel_;
  std::size_t bins_;
  std::array<double, kModeOrder + 1> narrowing_{};       ///< lag window of the modes that are not slow
  std::array<double, kModeOrder + 1> slow_narrowing_{};  ///< and of the slow one
  double kept_ = 1.0;                                    ///< of a mode's drive, by an iteration
  std::vector<double> cosines_;                          ///< kModeOrder + 1 rows: cos(l w)
  std::vector<double> sines_;
  std::vector<double> weights_;  ///< the same cosines as weights of a bin in the autocovariance at lag l
  std::vector<double> noise_;    ///< R
  std::vector<double> rest_;     ///< R without its lines
  std::vector<double> observed_;
  std::vector<double> sum_;        ///< M
  std::vector<double> deviation_;  ///< (I - M) / M^2; in least_explained() the sums of I / M
  std::vector<double> spectra_;    ///< kMaxModes rows: S_j
};

}  // namespace gyrod::core
