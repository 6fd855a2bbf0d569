#include "core/evaluation/butterworth.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace gyrod::core {
namespace {

FilterSection first_order(double k) noexcept {
  return {.b0 = k / (1.0 + k), .b1 = k / (1.0 + k), .b2 = 0.0, .a1 = (k - 1.0) / (k + 1.0), .a2 = 0.0};
}

FilterSection second_order(double k, double q) noexcept {
  const double norm = 1.0 + k / q + k * k;
  const double b0 = k * k / norm;
  return {.b0 = b0,
          .b1 = 2.0 * b0,
          .b2 = b0,
          .a1 = 2.0 * (k * k - 1.0) / norm,
          .a2 = (1.0 - k / q + k * k) / norm};
}

void filter_by_section(const FilterSection& section, std::span<double> x) noexcept {
  double first = x[0] * (1.0 - section.b0);
  double second = x[0] * (section.b2 - section.a2);
  for (double& value : x) {
    const double in = value;
    const double out = section.b0 * in + first;
    first = section.b1 * in - section.a1 * out + second;
    second = section.b2 * in - section.a2 * out;
    value = out;
  }
}

}  // namespace

std::vector<FilterSection> butterworth(std::size_t order, double cutoff) {
  assert(order >= 1 && order <= 16 && cutoff > 0.0 && cutoff < 0.5);
  const double k = std::tan(std::numbers::pi * cutoff);
  std::vector<FilterSection> sections;
  if (order % 2 == 1) sections.push_back(first_order(k));
  for (std::size_t pair = 1; pair <= order / 2; ++pair) {
    const double angle =
        std::numbers::pi * (2.0 * static_cast<double>(pair) - 1.0) / (2.0 * static_cast<double>(order));
    sections.push_back(second_order(k, 1.0 / (2.0 * std::sin(angle))));
  }
  return sections;
}

void filter_forward(std::span<const FilterSection> sections, std::span<double> x) noexcept {
  if (x.empty()) return;
  for (const FilterSection& section : sections) filter_by_section(section, x);
}

std::vector<double> filter_zero_phase(std::span<const FilterSection> sections, double cutoff,
                                      std::span<const double> x) {
  if (x.empty()) return {};
  const std::size_t size = x.size();
  const auto wanted = static_cast<std::size_t>(std::ceil(std::min(1.5 / cutoff, 1e9)));
  const std::size_t pad = std::min(size - 1, wanted);
  std::vector<double> padded(size + 2 * pad);
  for (std::size_t k = 1; k <= pad; ++k) {
    padded[pad - k] = 2.0 * x[0] - x[k];
    padded[pad + size - 1 + k] = 2.0 * x[size - 1] - x[size - 1 - k];
  }
  std::ranges::copy(x, padded.begin() + static_cast<std::ptrdiff_t>(pad));
  filter_forward(sections, padded);
  std::ranges::reverse(padded);
  filter_forward(sections, padded);
  std::ranges::reverse(padded);
  const auto begin = padded.begin() + static_cast<std::ptrdiff_t>(pad);
  return {begin, begin + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace gyrod::core
