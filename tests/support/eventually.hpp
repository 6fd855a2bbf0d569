/// Bounded waiting on a condition, for integration tests.
#pragma once

#include <chrono>
#include <thread>

#include "support/slow_build.hpp"

namespace gyrod::testing {

/// Longest wait for anything; never reached when all is well.
inline constexpr std::chrono::seconds kEventually{kSlowBuild ? 180 : 60};

/// Looks until the condition holds. @return false if it did not in time
template <typename Condition>
[[nodiscard]] bool eventually(const Condition& condition, std::chrono::seconds timeout = kEventually) {
  constexpr std::chrono::milliseconds kLookAgain{5};
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (!condition()) {
    if (std::chrono::steady_clock::now() >= deadline) return false;
    std::this_thread::sleep_for(kLookAgain);
  }
  return true;
}

}  // namespace gyrod::testing
