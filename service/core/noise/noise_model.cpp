#include "core/noise/noise_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/signal/levinson.hpp"
#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

/// |1 - c_1 e^-iw - ... - c_p e^-ipw|^2.
double response(std::span<const double> coefficients, double radians) noexcept {
  const SineCosine turn = portable_sine_cosine(0.5 * std::numbers::inv_pi * radians);
  SineCosine at;
  double real = 1.0;
  double imaginary = 0.0;
  for (const double coefficient : coefficients) {
    at = {at.sine * turn.cosine + at.cosine * turn.sine, at.cosine * turn.cosine - at.sine * turn.sine};
    real -= coefficient * at.cosine;
    imaginary += coefficient * at.sine;
  }
  return real * real + imaginary * imaginary;
}

bool is_line(const SpectralLine& line) noexcept {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  return positive(line.cycles) && line.cycles < 0.5 && positive(line.half_width) && positive(line.variance);
}

}  // namespace

NoiseModel white_noise(double variance) noexcept {
  NoiseModel model;
  model.white_variance = variance;
  return model;
}

double noise_spectrum(const NoiseModel& model, double radians) noexcept {
  double power = model.white_variance;
  if (model.colour_order > 0) power += model.colour_variance / response(model.colour_coefficients(), radians);
  const double cycles = 0.5 * std::numbers::inv_pi * radians;
  for (const SpectralLine& line : model.lines())
    power += spread_density(line, std::min(cycles, 1.0 - cycles));
  return power;
}

double spread_density(const SpectralLine& line, double cycles) noexcept {
  const double low = (1.0 - kLineSpread) * line.cycles;
  const double high = std::min((1.0 + kLineSpread) * line.cycles, 0.5);
  return cycles < low || cycles > high ? 0.0 : 0.5 * line.variance / (high - low);
}

NoiseModel without_lines(const NoiseModel& model) noexcept {
  NoiseModel result = model;
  result.line_count = 0;
  result.line = {};
  return result;
}

double noise_variance(const NoiseModel& model) noexcept {
  double variance = model.white_variance;
  if (model.colour_order > 0)
    variance += model.colour_variance * ar_variance_gain(model.colour_coefficients());
  for (const SpectralLine& line : model.lines()) variance += line.variance;
  return variance;
}

NoiseModel scaled(const NoiseModel& model, double factor) noexcept {
  NoiseModel result = model;
  result.white_variance *= factor * factor;
  result.colour_variance *= factor * factor;
  for (SpectralLine& line : result.line) line.variance *= factor * factor;
  return result;
}

bool is_usable(const NoiseModel& model) noexcept {
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!finite(model.white_variance) || model.white_variance <= 0.0) return false;
  if (!finite(model.colour_variance) || model.colour_variance < 0.0) return false;
  if (model.colour_order > kMaxNoiseColour) return false;
  if (model.line_count > kMaxNoiseLines || !std::ranges::all_of(model.lines(), is_line)) return false;
  const auto coefficients = model.colour_coefficients();
  return std::ranges::all_of(coefficients, finite) && std::isfinite(ar_variance_gain(coefficients));
}

}  // namespace gyrod::core
