#include "stream/scheduler.hpp"

#include <cstdlib>
#include <sys/resource.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gyrod::stream {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kOwnsTheAddressSpace = true;
#else
constexpr bool kOwnsTheAddressSpace = false;
#endif

/// Starts workers where the process may not map so many stacks, and ends as the exception says.
[[noreturn]] void start_too_many() {
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = 512UL << 20U;  // room for the test and some stacks of 8 MiB
  setrlimit(RLIMIT_AS, &limit);
  try {
    const Scheduler scheduler(4096, 1, [](std::size_t, Channel&) {});
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    std::exit(3);
  }
  std::exit(0);
}

TEST(SchedulerDeathTest, EndsTheWorkersThatRunAndSaysWhichDoesNotStart) {
  if (kOwnsTheAddressSpace) GTEST_SKIP() << "a sanitizer needs the address space that this takes away";
  EXPECT_EXIT(start_too_many(), ::testing::ExitedWithCode(3),
              "workers: thread [0-9]+ of 4096 does not start");
}

}  // namespace
}  // namespace gyrod::stream
