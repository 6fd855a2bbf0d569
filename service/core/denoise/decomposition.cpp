#include "core/denoise/decomposition.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/denoise/noise_line.hpp"
#include "core/signal/moments.hpp"

namespace gyrod::core {

Decomposition::Decomposition(std::size_t max_samples, const EmdOptions& emd,
                             const ScreeningOptions& screening)
    : screening_(screening),
      significance_(screening.false_alarm_rate),
      line_holds_(noise_line_holds(emd)),
      max_samples_(max_samples),
      emd_(max_samples, emd),
      autocorrelation_(max_samples) {
  const auto max_imfs = static_cast<std::size_t>(emd.max_imfs);
  if (max_imfs > kMaxImfs) {
    throw std::invalid_argument("IMF limit is " + std::to_string(max_imfs) + ", expected at most " +
                                std::to_string(kMaxImfs));
  }
  if (screening.rule == ScreeningRule::kSignificance && !line_holds_) {
    throw std::invalid_argument("the significance rule was asked for with " + std::to_string(emd.sifts) +
                                " sifts or another boundary rule, expected 10 sifts and the mirror rule");
  }
  // One row more: the EMD is offered a row before it says there is no mode.
  imfs_.resize((max_imfs + 1) * max_samples_);
  reference_.resize(max_samples_);
}

void Decomposition::take_apart(std::span<const double> window, WindowReport& report,
                               std::optional<double> noise_variance) noexcept {
  samples_ = window.size();
  decompose(window, report, noise_variance);  // eq. (1), and the ACF boundary k, eq. (3)
  screen(window, report);                     // the PCC boundary j, eq. (2), and the partition, eq. (4)
}

double Decomposition::white_noise_variance_of(std::span<const double> window) noexcept {
  samples_ = window.size();
  emd_.start(window);
  return emd_.next_imf(imf(0)) ? white_noise_variance(variance(imf(0))) : 0.0;
}

void Decomposition::decompose(std::span<const double> window, WindowReport& report,
                              std::optional<double> known_variance) noexcept {
  const bool stop_at_signal = screening_.rule != ScreeningRule::kPaper;
  emd_.start(window);
  double noise_variance = known_variance.value_or(0.0);
  bool signal_found = false;
  while (emd_.next_imf(imf(report.imf_count))) {
    const std::size_t index = ++report.imf_count;
    const auto mode = imf(index - 1);
    if (index == 1 && !known_variance) noise_variance = white_noise_variance(variance(mode));
    ImfFigures& figures = report.imf[index - 1];
    figures =
        imf_figures(mode, index, noise_variance, autocorrelation_, line_holds_ ? &significance_ : nullptr);
    signal_found = signal_found || is_signal(figures, screening_);
    if (!signal_found) report.k = index;
    if (signal_found && stop_at_signal) break;
  }
  report.noise_floor = std::sqrt(noise_variance);
}

void Decomposition::screen(std::span<const double> window, WindowReport& report) noexcept {
  const std::span<double> reference{reference_.data(), window.size()};
  if (screening_.rule == ScreeningRule::kPaper) {
    std::copy(window.begin(), window.end(), reference.begin());
  } else {
    std::fill(reference.begin(), reference.end(), 0.0);
    for (std::size_t i = 0; i < report.k; ++i) {
      const auto mode = imf(i);
      for (std::size_t n = 0; n < mode.size(); ++n) reference[n] += mode[n];
    }
  }
  for (std::size_t i = 0; i < report.imf_count; ++i)
    report.imf[i].pcc = pearson_correlation(imf(i), reference);
  partition(report, screening_);
}

void Decomposition::reconstruct(std::size_t first, std::size_t count, std::span<double> out) const noexcept {
  assert(out.size() == samples_);
  std::ranges::copy(residue(), out.begin());
  for (std::size_t i = count; i > first; --i) {  // smallest rounding: slow modes first
    const auto mode = imf(i - 1);
    for (std::size_t n = 0; n < out.size(); ++n) out[n] += mode[n];
  }
}

std::span<double> Decomposition::imf(std::size_t index) noexcept {
  return {imfs_.data() + index * max_samples_, samples_};
}

std::span<const double> Decomposition::imf(std::size_t index) const noexcept {
  return {imfs_.data() + index * max_samples_, samples_};
}

}  // namespace gyrod::core
