#include "core/denoise/whiteness.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/signal/chi_squared.hpp"

namespace gyrod::core {

std::size_t whiteness_lags(std::size_t samples, std::size_t parameters) noexcept {
  const std::size_t lags = std::min(parameters + kWhitenessFreedom, samples / 4);
  return lags > parameters ? lags : 0;
}

Whiteness test_whiteness(std::span<const double> acf, std::size_t samples, std::size_t parameters) noexcept {
  constexpr double kSignificance = 0.05;
  constexpr double kBand = 1.96;  // standard errors: 95 % of a normal distribution
  Whiteness result;
  result.lags = whiteness_lags(samples, parameters);
  if (result.lags == 0) return result;
  assert(acf.size() > result.lags);
  const auto n = static_cast<double>(samples);
  double sum = 0.0;
  for (std::size_t lag = 1; lag <= result.lags; ++lag) {
    sum += acf[lag] * acf[lag] / (n - static_cast<double>(lag));
    if (std::abs(acf[lag]) > kBand / std::sqrt(n)) ++result.lags_outside;
  }
  result.ljung_box_q = n * (n + 2.0) * sum;
  result.degrees_of_freedom = result.lags - parameters;
  result.p_value = chi_squared_tail(result.ljung_box_q, static_cast<double>(result.degrees_of_freedom));
  result.adequate = result.p_value >= kSignificance;
  result.within_bands = result.lags_outside <= 1 + result.lags / 10;
  return result;
}

}  // namespace gyrod::core
