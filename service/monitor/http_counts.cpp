#include "monitor/http_counts.hpp"

#include <algorithm>

namespace gyrod::monitor {
namespace {

std::size_t place_of(int status) noexcept {
  return static_cast<std::size_t>(std::ranges::find(kStatuses, status) - kStatuses.begin());
}

template <class Counters, class Numbers>
void copy(const Counters& counters, Numbers& numbers) noexcept {
  std::ranges::transform(counters, numbers.begin(),
                         [](const auto& count) { return count.load(std::memory_order_relaxed); });
}

}  // namespace

std::string_view name_of(Refusal why) noexcept {
  switch (why) {
    case Refusal::kHost:
      return "host";
    case Refusal::kNoCredentials:
      return "no_credentials";
    case Refusal::kWrongCredentials:
      return "wrong_credentials";
    case Refusal::kGuessing:
      return "guessing";
    case Refusal::kRate:
      return "rate";
    case Refusal::kMethod:
      return "method";
    case Refusal::kMalformed:
      return "malformed";
    case Refusal::kTooLarge:
      return "too_large";
    case Refusal::kTimeout:
      return "timeout";
    case Refusal::kTls:
      return "tls";
    case Refusal::kNoPlace:
      return "no_place";
    case Refusal::kNotTaken:
      return "not_taken";
    case Refusal::kStreams:
      return "streams";
  }
  return "";
}

std::uint64_t HttpSnapshot::answered(int status) const noexcept { return answers[place_of(status)]; }

void HttpCounts::count(int status, std::optional<Refusal> refusal) noexcept {
  if (status != 0) answers_[place_of(status)].fetch_add(1, std::memory_order_relaxed);
  if (refusal) count(*refusal);
}

void HttpCounts::count(Refusal why, std::size_t times) noexcept {
  refusals_[static_cast<std::size_t>(why)].fetch_add(times, std::memory_order_relaxed);
}

HttpSnapshot HttpCounts::snapshot() const noexcept {
  HttpSnapshot now;
  copy(answers_, now.answers);
  copy(refusals_, now.refusals);
  return now;
}

}  // namespace gyrod::monitor
