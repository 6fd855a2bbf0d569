#include "app/evaluation_series.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/signal/interpolation.hpp"
#include "core/signal/moments.hpp"

namespace gyrod::app {

void bridge_gaps(std::vector<double>& values, std::size_t most) {
  const auto known = [](double value) { return std::isfinite(value); };
  auto last = std::ranges::find_if(values, known);
  while (last != values.end()) {
    const auto next = std::find_if(last + 1, values.end(), known);
    const auto lost = static_cast<std::size_t>(next - last) - 1;
    for (std::size_t step = 0; next != values.end() && lost <= most && step < lost; ++step)
      *(last + 1 + static_cast<std::ptrdiff_t>(step)) = core::bridge(*last, *next, step, lost);
    last = next;
  }
}

std::vector<double> with_gaps_bridged(std::vector<double> values) {
  const auto known = [](double value) { return std::isfinite(value); };
  const auto first = std::ranges::find_if(values, known);
  const auto last = std::find_if(values.rbegin(), values.rend(), known);
  std::fill(values.begin(), first, *first);
  std::fill(values.rbegin(), last, *last);
  bridge_gaps(values, values.size());
  return values;
}

std::vector<double> composite(std::vector<double> truth, const std::vector<double>& noise) {
  std::vector<double> noisy = with_gaps_bridged(std::move(truth));
  for (std::size_t n = 0; n < noisy.size(); ++n) noisy[n] += noise[n];
  return noisy;
}

std::vector<double> without_mean(std::vector<double> values) {
  const double mean = core::mean(values);
  for (double& value : values) value -= mean;
  return values;
}

std::vector<double> stretch(std::span<const double> all, std::size_t start, std::size_t samples) {
  std::vector<double> part(samples);
  for (std::size_t n = 0; n < samples; ++n) part[n] = all[(start + n) % all.size()];
  return part;
}

std::vector<std::span<const double>> spare(std::span<const double> all, std::size_t start,
                                           std::size_t samples) {
  const std::size_t end = start + samples;
  if (end <= all.size()) return {all.first(start), all.subspan(end)};
  const std::size_t again = std::min(end - all.size(), start);
  return {all.subspan(again, start - again)};
}

std::vector<double> scaled(std::vector<double> values, double scale) {
  for (double& value : values) value *= scale;
  return values;
}

}  // namespace gyrod::app
