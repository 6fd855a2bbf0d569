#include "monitor/metric_builders.hpp"

#include <limits>

namespace gyrod::monitor {

prometheus::MetricFamily histogram(std::string name, std::string help, const stream::TimeHistogram& times) {
  prometheus::ClientMetric made;
  std::uint64_t cumulative = 0;
  for (std::size_t i = 0; i < times.buckets.size(); ++i) {
    cumulative += times.buckets[i];
    const bool bounded = i < stream::TimeHistogram::kUpperBoundsS.size();
    const double bound =
        bounded ? stream::TimeHistogram::kUpperBoundsS[i] : std::numeric_limits<double>::infinity();
    made.histogram.bucket.push_back({cumulative, bound});
  }
  made.histogram.sample_count = cumulative;
  made.histogram.sample_sum = times.sum_s;
  prometheus::MetricFamily result =
      family(std::move(name), std::move(help), prometheus::MetricType::Histogram);
  result.metric.push_back(std::move(made));
  return result;
}

}  // namespace gyrod::monitor
