/// Counts heap allocations, for tests that prove a path makes none. Link gyrod_test_allocation_counter.
#pragma once

#include <cstdint>

namespace gyrod::testing {

/// False under sanitizers, which bring their own heap: tests of allocations skip there.
[[nodiscard]] bool counts_allocations() noexcept;

/// Calls of malloc, calloc, realloc and aligned_alloc (and so of operator new) by all threads since the
/// process began.
[[nodiscard]] std::uint64_t allocations() noexcept;

}  // namespace gyrod::testing
