/// Bounded waiting on a condition, for integration tests.
#pragma once

#include <chrono>
#include <thread>

namespace gyrod::testing {

/// Looks until the condition holds. @return false if it did not in time
template <typename Condition>
[[nodiscard]] bool eventually(const Condition& condition,
                              std::chrono::seconds timeout = std::chrono::seconds{60}) {
  constexpr std::chrono::milliseconds kLookAgain{5};
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (!condition()) {
    if (std::chrono::steady_clock::now() >= deadline) return false;
    std::this_thread::sleep_for(kLookAgain);
  }
  return true;
}

}  // namespace gyrod::testing
