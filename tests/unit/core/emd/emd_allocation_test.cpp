// Nothing is allocated after the constructor.
#include <gtest/gtest.h>

#include "support/allocation_counter.hpp"
#include "unit/core/emd/emd_support.hpp"

namespace gyrod {
namespace {

using namespace testing;

TEST(EmdAllocation, DecomposingAllocatesNothing) {
  if (!counts_allocations()) {
    GTEST_SKIP() << "the sanitizer brings its own heap";
  }
  const Signal signal = white_noise(1024, 1);
  Signal imf(1024);
  for (const auto kernel : {core::EmdKernel::kFastest, core::EmdKernel::kReference}) {
    const std::uint64_t before_constructor = allocations();
    core::Emd emd(1024, {}, kernel);
    const std::uint64_t before = allocations();
    EXPECT_GT(before, before_constructor) << "the counter counts";
    for (const std::size_t size : {1024U, 17U, 1024U}) {
      emd.start(std::span(signal).first(size));
      while (emd.next_imf(std::span(imf).first(size))) {
      }
    }
    EXPECT_EQ(allocations(), before);
  }
}

}  // namespace
}  // namespace gyrod
