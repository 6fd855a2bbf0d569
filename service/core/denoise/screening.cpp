#include "core/denoise/screening.hpp"

#include <cmath>

#include "core/denoise/noise_line.hpp"
#include "core/signal/moments.hpp"

namespace gyrod::core {

ImfFigures imf_figures(std::span<const double> imf, std::size_t index, double noise_variance,
                       Autocorrelation& autocorrelation, const SignificanceTest* significance) noexcept {
  ImfFigures figures;
  figures.energy = variance(imf);
  figures.mean_period_samples = mean_period(imf);
  figures.acf_variance = autocorrelation.acf_variance(imf);
  figures.acf_concentration =
      figures.acf_variance * static_cast<double>(imf.size()) / figures.mean_period_samples;
  if (noise_variance <= 0.0) return figures;
  figures.excess = figures.energy / (noise_variance * noise_line_energy(index));
  if (significance != nullptr) significance->judge(figures, index, imf.size());
  return figures;
}

bool is_signal(const ImfFigures& figures, const ScreeningOptions& options) noexcept {
  if (options.rule == ScreeningRule::kPaper) return figures.acf_variance > options.acf_variance;
  if (options.rule == ScreeningRule::kSignificance) return figures.excess > options.max_mixed_excess;
  return figures.acf_concentration > options.acf_concentration ||
         figures.mean_period_samples > options.max_noise_period_samples ||
         figures.excess > options.max_mixed_excess;
}

void partition(WindowReport& report, const ScreeningOptions& options) noexcept {
  const auto is_noise = [&](const ImfFigures& figures) {
    if (options.rule == ScreeningRule::kSignificance) {
      return figures.noise_excess_low <= figures.excess && figures.excess <= figures.noise_excess_high;
    }
    const bool correlates = std::abs(figures.pcc) >= options.very_weak_pcc;
    const bool near_the_line =
        options.rule == ScreeningRule::kPaper || figures.excess <= options.max_noise_excess;
    return correlates && near_the_line;
  };
  report.j = 0;
  while (report.j < report.k && is_noise(report.imf[report.j])) ++report.j;
  for (std::size_t i = 0; i < report.imf_count; ++i) {
    report.imf[i].imf_class = i < report.j   ? ImfClass::kNoise
                              : i < report.k ? ImfClass::kMixed
                                             : ImfClass::kSignal;
  }
}

}  // namespace gyrod::core
