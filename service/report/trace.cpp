#include "report/trace.hpp"

#include <algorithm>
#include <cassert>

namespace gyrod::report {

Trace min_max_trace(std::span<const double> series, double period, std::size_t most) {
  assert(most >= 2);
  if (series.size() <= most) return {period, {series.begin(), series.end()}};
  const std::size_t stretches = most / 2;
  const std::size_t length = (series.size() + stretches - 1) / stretches;
  Trace trace{period * static_cast<double>(length) / 2.0, {}};
  trace.values.reserve(most);
  for (std::size_t begin = 0; begin < series.size(); begin += length) {
    const auto stretch = series.subspan(begin, std::min(length, series.size() - begin));
    const auto [least, greatest] = std::ranges::minmax_element(stretch);
    trace.values.push_back(least < greatest ? *least : *greatest);
    trace.values.push_back(least < greatest ? *greatest : *least);
  }
  return trace;
}

}  // namespace gyrod::report
