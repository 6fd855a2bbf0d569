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

}  // namespace

NoiseModel white_noise(double variance) noexcept {
  NoiseModel model;
  model.white_variance = variance;
  return model;
}

double noise_spectrum(const NoiseModel& model, double radians) noexcept {
  if (model.colour_order == 0) return model.white_variance;
  return model.white_variance + model.colour_variance / response(model.colour_coefficients(), radians);
}

double noise_variance(const NoiseModel& model) noexcept {
  if (model.colour_order == 0) return model.white_variance;
  return model.white_variance + model.colour_variance * ar_variance_gain(model.colour_coefficients());
}

NoiseModel scaled(const NoiseModel& model, double factor) noexcept {
  NoiseModel result = model;
  result.white_variance *= factor * factor;
  result.colour_variance *= factor * factor;
  return result;
}

bool is_usable(const NoiseModel& model) noexcept {
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!finite(model.white_variance) || model.white_variance <= 0.0) return false;
  if (!finite(model.colour_variance) || model.colour_variance < 0.0) return false;
  if (model.colour_order > kMaxNoiseColour) return false;
  const auto coefficients = model.colour_coefficients();
  return std::ranges::all_of(coefficients, finite) && std::isfinite(ar_variance_gain(coefficients));
}

}  // namespace gyrod::core
