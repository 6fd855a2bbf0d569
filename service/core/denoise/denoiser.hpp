/// The algorithm, top to bottom: decompose, screen, model, filter, reconstruct. [Yang2019], steps 1 to 7.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/denoise/decomposition.hpp"
#include "core/denoise/model_filter.hpp"
#include "core/denoise/scheme.hpp"
#include "core/denoise/screening.hpp"
#include "core/denoise/window_report.hpp"
#include "core/emd/emd.hpp"

namespace gyrod::core {

struct DenoiserOptions {
  /// What is done; the others are what the paper compares its own with.
  Scheme scheme = Scheme::kImproved;
  EmdOptions emd;
  ScreeningOptions screening;
  /// How models of mixed IMFs are chosen, and that of the window in the scheme direct.
  ModelChoice models = ModelChoice::kAr;
  /// Largest AR order. Unit: count, range 1..kMaxArOrder. Source: the paper's orders are 4 and 6 (Table 4).
  std::size_t max_ar_order = 6;
  /// Give the output the input's mean. IMFs of a long record have means of their own, of the size of its mean's standard error.
  bool keep_mean = false;
};

/// Denoises one window at a time, or one record: that is a window as long as the record. Sizes its workspace once; denoise() allocates
/// nothing and is a pure function of its input: same window, same bits. Not thread-safe; one object per worker.
class Denoiser {
 public:
  /// Shortest window that is decomposed.
  static constexpr std::size_t kMinSamples = 16;

  /// @param max_samples longest window, at least kMinSamples
  /// @throws std::invalid_argument for an option outside its range
  explicit Denoiser(std::size_t max_samples, const DenoiserOptions& options = {});

  /// @param window uniformly sampled, finite, any unit
  /// @param out    the denoised window, may not overlap `window`
  /// @param report the figures behind the result; the scheme raw finds out nothing but the mean, and direct no IMFs
  /// @param noise_variance of the input's white noise where it is known from elsewhere, unit^2, positive; none: found from IMF 1
  /// @pre kMinSamples <= window.size() <= max_samples, out.size() == window.size()
  void denoise(std::span<const double> window, std::span<double> out, WindowReport& report,
               std::optional<double> noise_variance = {}) noexcept;

 private:
  void filter_directly(std::span<const double> window, std::span<double> out, WindowReport& report,
                       std::optional<double> noise_variance) noexcept;
  void decompose_and_filter(std::span<const double> window, std::span<double> out, WindowReport& report,
                            std::optional<double> noise_variance) noexcept;
  void filter_mixed(WindowReport& report) noexcept;

  DenoiserOptions options_;
  std::size_t max_samples_;
  Decomposition decomposition_;
  ModelFilter model_filter_;
};

/// First IMF, counted from 0, that a scheme keeps after decomposing. @pre scheme is kEmd, kAcfEmd or kImproved
[[nodiscard]] std::size_t first_kept(Scheme scheme, const WindowReport& report) noexcept;

/// What the Kalman filter of mixed IMF number `index` (0 for the fastest) is told, and what of the record itself in the scheme direct.
/// @pre report.noise_floor and, for an IMF, its figures are set
[[nodiscard]] FilterNoise filter_noise_of_imf(const WindowReport& report, std::size_t index,
                                              ModelChoice models) noexcept;
[[nodiscard]] FilterNoise filter_noise_of_record(const WindowReport& report, double energy) noexcept;

/// Shifts `out` to this mean.
void give_mean(double mean, std::span<double> out) noexcept;

}  // namespace gyrod::core
