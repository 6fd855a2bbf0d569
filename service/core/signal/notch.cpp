#include "core/signal/notch.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

struct NotchTerms {
  double zero = 0.0;    ///< 2 c
  double pole = 0.0;    ///< 2 r c
  double square = 0.0;  ///< r^2
};

void pass_notch(std::span<double> samples, const NotchTerms& of) noexcept {
  std::array<double, 2> in{};
  std::array<double, 2> out{};
  for (double& sample : samples) {
    const double x = sample;
    sample = x - of.zero * in[0] + in[1] + of.pole * out[0] - of.square * out[1];
    in = {x, in[0]};
    out = {sample, out[0]};
  }
}

}  // namespace

void notch(std::span<double> samples, double cycles, double half_width) noexcept {
  const double r = portable_exp(-2.0 * std::numbers::pi * half_width);
  const double twice = 2.0 * portable_sine_cosine(cycles).cosine;
  const NotchTerms terms{.zero = twice, .pole = r * twice, .square = r * r};
  pass_notch(samples, terms);
  std::ranges::reverse(samples);
  pass_notch(samples, terms);
  std::ranges::reverse(samples);
}

}  // namespace gyrod::core
