/// The algorithm, top to bottom: decompose, screen, model, filter, reconstruct. [Yang2019], steps 1 to 7.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/denoise/ar_kalman.hpp"
#include "core/denoise/ar_model.hpp"
#include "core/denoise/scheme.hpp"
#include "core/denoise/screening.hpp"
#include "core/denoise/window_report.hpp"
#include "core/emd/emd.hpp"
#include "core/signal/autocorrelation.hpp"

namespace gyrod::core {

/// How the models of mixed IMFs, and of the record in the scheme direct, are chosen.
enum class ModelChoice : std::uint8_t {
  kAr,          ///< AR(p), order by BIC, no test of the residuals: quick enough for every window
  kIdentified,  ///< AR, MA or ARMA by core/denoise/identification.hpp: for whole records
};

struct DenoiserOptions {
  Scheme scheme = Scheme::kImproved;
  ModelChoice models = ModelChoice::kAr;
  EmdOptions emd;
  ScreeningOptions screening;
  /// Largest AR order of a mixed IMF. Unit: count, range 1..kMaxArOrder. Source: the paper's orders are 4 and
  /// 6 (Table 4).
  std::size_t max_ar_order = 6;
};

/// Denoises one window (or record) at a time. Sizes its workspace once; denoise() allocates nothing and is a
/// pure function of its input: same window, same bits. Not thread-safe; one object per worker.
class Denoiser {
 public:
  /// Shortest window that is decomposed.
  static constexpr std::size_t kMinSamples = 16;

  /// @param max_samples longest window, at least kMinSamples
  /// @throws std::invalid_argument for an option outside its range
  explicit Denoiser(std::size_t max_samples, const DenoiserOptions& options = {});

  /// @param window uniformly sampled, finite, any unit
  /// @param out    the denoised window, may not overlap `window`
  /// @param report the figures behind the result
  /// @pre kMinSamples <= window.size() <= max_samples, out.size() == window.size()
  void denoise(std::span<const double> window, std::span<double> out, WindowReport& report) noexcept;

 private:
  void decompose(std::span<const double> window, WindowReport& report) noexcept;
  void screen(std::span<const double> window, WindowReport& report) noexcept;
  void model_and_filter(WindowReport& report) noexcept;
  void reconstruct(const WindowReport& report, std::span<double> out) const noexcept;

  [[nodiscard]] double filter_mixed(std::span<double> imf, ImfFigures& figures,
                                    double noise_variance) noexcept;
  [[nodiscard]] std::span<double> imf(std::size_t index, std::size_t samples) noexcept;
  [[nodiscard]] std::span<const double> imf(std::size_t index, std::size_t samples) const noexcept;

  DenoiserOptions options_;
  std::size_t max_samples_;
  Emd emd_;
  Autocorrelation autocorrelation_;
  ArFitter ar_fitter_;
  ArKalman kalman_;
  std::vector<double> imfs_;       ///< max_imfs + 1 rows of max_samples
  std::vector<double> reference_;  ///< what the PCC is taken against
};

}  // namespace gyrod::core
