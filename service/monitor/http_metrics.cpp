#include "monitor/http_metrics.hpp"

#include <string>
#include <utility>

#include "monitor/metric_builders.hpp"

namespace gyrod::monitor {

/// A series of each kind, also where there is none of it: an alert may then ask for a rise.
void add_http_metrics(const HttpSnapshot& http, std::vector<prometheus::MetricFamily>& families) {
  prometheus::MetricFamily answers =
      family("gyrod_http_requests_total", "HTTP requests answered, by status.", kCounter);
  for (std::size_t i = 0; i < http.answers.size(); ++i) {
    const std::string code = i < kStatuses.size() ? std::to_string(kStatuses[i]) : "other";
    answers.metric.push_back(metric(kCounter, static_cast<double>(http.answers[i]), {{"code", code}}));
  }
  prometheus::MetricFamily refusals =
      family("gyrod_http_refused_total", "HTTP requests and connections turned away, each under one reason.",
             kCounter);
  for (std::size_t i = 0; i < kRefusals; ++i) {
    const std::string reason(name_of(static_cast<Refusal>(i)));
    refusals.metric.push_back(metric(kCounter, static_cast<double>(http.refusals[i]), {{"reason", reason}}));
  }
  families.push_back(std::move(answers));
  families.push_back(std::move(refusals));
}

}  // namespace gyrod::monitor
