#include "app/status_log.hpp"

#include <spdlog/spdlog.h>

namespace gyrod::app {
namespace {

constexpr std::chrono::minutes kSumEvery{1};

}  // namespace

void StatusLog::tick(const stream::EngineSnapshot& now, std::size_t matched_writers) {
  log_changes(now, matched_writers);
  last_ = now;
  last_writers_ = matched_writers;
  const auto time = std::chrono::steady_clock::now();
  if (time < next_sum_) return;
  log_growth(now.totals);
  next_sum_ = time + kSumEvery;
}

void StatusLog::log_changes(const stream::EngineSnapshot& now, std::size_t matched_writers) const {
  if (matched_writers != last_writers_)
    spdlog::info("{} writers send to gyrod, before {}", matched_writers, last_writers_);
  if (now.channels != last_.channels) spdlog::info("{} sensors, before {}", now.channels, last_.channels);
  const auto& [total, before] = std::pair(now.totals, last_.totals);
  if (total.hops_widened > before.hops_widened)
    spdlog::warn("overload: windows come less often (hop widened)");
  if (total.overloads > before.overloads)
    spdlog::warn("overload: samples pass through undenoised ({} times)", total.overloads - before.overloads);
  constexpr auto kHistory = static_cast<std::size_t>(stream::RejectReason::kHistory);
  if (total.rejected[kHistory] > before.rejected[kHistory])
    spdlog::info("{} samples that were published before fill windows",
                 total.rejected[kHistory] - before.rejected[kHistory]);
  if (total.restarts > before.restarts)
    spdlog::warn("sequence or clock of a sensor began anew ({} times)", total.restarts - before.restarts);
}

void StatusLog::log_growth(const stream::Counts& now) {
  for (std::size_t i = 0; i < stream::kRejectReasons; ++i) {
    const std::uint64_t more = now.rejected[i] - last_sum_.rejected[i];
    if (more > 0 && static_cast<stream::RejectReason>(i) != stream::RejectReason::kHistory)
      spdlog::warn("{} more samples refused: {}", more,
                   stream::name_of(static_cast<stream::RejectReason>(i)));
  }
  if (now.missing > last_sum_.missing)
    spdlog::warn("{} more samples missing from the input", now.missing - last_sum_.missing);
  last_sum_ = now;
}

}  // namespace gyrod::app
