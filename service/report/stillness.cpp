#include "report/stillness.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/signal/moments.hpp"

namespace gyrod::report {

Stillness stillness(std::span<const double> record, double sample_rate_hz) {
  constexpr std::size_t kLeastMeans = 10;
  if (record.size() < 2) return {};
  double squares = 0.0;
  for (std::size_t n = 1; n < record.size(); ++n) {
    const double step = record[n] - record[n - 1];
    squares += step * step;
  }
  const auto second = static_cast<std::size_t>(std::max(1.0, std::round(sample_rate_hz)));
  const std::size_t length = std::max<std::size_t>(1, std::min(second, record.size() / kLeastMeans));
  std::vector<double> means;
  for (std::size_t begin = 0; begin + length <= record.size(); begin += length) {
    means.push_back(core::mean(record.subspan(begin, length)));
  }
  return {std::sqrt(core::variance(means)),
          std::sqrt(squares / static_cast<double>(record.size() - 1) / 2.0)};
}

}  // namespace gyrod::report
