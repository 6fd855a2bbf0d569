#include "live/daemon_watch.hpp"

#include <algorithm>
#include <utility>

namespace gyrod::live {
namespace {

std::string overload_sentence(unsigned step, unsigned before) {
  if (step == 0) return "Overload is over, before step " + std::to_string(before) + " of 2.";
  const std::string what =
      step == 1 ? "windows come less often (hop widened)" : "samples pass through undenoised";
  return "Overload step " + std::to_string(step) + " of 2, before " + std::to_string(before) + ": " + what +
         ".";
}

}  // namespace

std::vector<std::string> DaemonWatch::look(double now_s, const stream::EngineSnapshot& now,
                                           std::size_t max_channels) {
  constexpr auto kReason = static_cast<std::size_t>(stream::RejectReason::kTooManyChannels);
  std::vector<std::string> news;
  look_for_overload(now_s, now, news);
  look_at_refusals(now_s, now.totals.rejected[kReason], max_channels, news);
  return news;
}

/// Steps that came and went between two calls are in the counts.
void DaemonWatch::look_for_overload(double now_s, const stream::EngineSnapshot& now,
                                    std::vector<std::string>& news) {
  const bool widened = now.totals.hops_widened > std::exchange(hops_widened_, now.totals.hops_widened);
  const bool passed = now.totals.overloads > std::exchange(overloads_, now.totals.overloads);
  const unsigned step = std::max({now.overload_step, widened ? 1U : 0U, passed ? 2U : 0U});
  if (step == step_) busy_s_ = now_s;
  if (step == step_ || (step < step_ && now_s - busy_s_ < kCalmS)) return;
  busy_s_ = now_s;
  news.push_back(overload_sentence(step, std::exchange(step_, step)));
}

void DaemonWatch::look_at_refusals(double now_s, std::uint64_t refused, std::size_t max_channels,
                                   std::vector<std::string>& news) {
  if (refused == refused_ || now_s < next_sum_s_) return;
  next_sum_s_ = now_s + kSumS;
  news.push_back(std::to_string(refused - std::exchange(refused_, refused)) +
                 " samples refused, of sensors beyond limits.max_channels (" + std::to_string(max_channels) +
                 ").");
}

}  // namespace gyrod::live
