// Nothing is allocated after the constructor.
#include <gtest/gtest.h>

#include "support/allocation_counter.hpp"
#include "unit/core/denoise/denoiser_support.hpp"

namespace gyrod {
namespace {

using namespace testing;

TEST(DenoiserAllocation, SchemesAndIdentifiedModelsAllocateNothing) {
  if (!counts_allocations()) {
    GTEST_SKIP() << "the sanitizer brings its own heap";
  }
  const Signal window = sum(white_noise(1024, 1), tone(1024, 0.003), 0.5);
  Signal out(1024);
  core::WindowReport report;
  for (const auto scheme : core::kAllSchemes) {
    core::DenoiserOptions options;
    options.scheme = scheme;
    options.models = core::ModelChoice::kIdentified;
    options.keep_mean = true;
    core::Denoiser denoiser(1024, options);
    const std::uint64_t before = allocations();
    denoiser.denoise(window, out, report);
    EXPECT_EQ(allocations(), before) << core::name_of(scheme);
  }
  EXPECT_TRUE(report.imf[report.j].model.used) << "an identified model was among what ran";
}

TEST(DenoiserAllocation, DenoisingAllocatesNothing) {
  if (!counts_allocations()) {
    GTEST_SKIP() << "the sanitizer brings its own heap";
  }
  const Signal window = sum(white_noise(1024, 1), tone(1024, 0.003), 0.5);
  Signal out(1024);
  core::WindowReport report;
  std::size_t models = 0;
  for (const auto rule :
       {core::ScreeningRule::kPaper, core::ScreeningRule::kWindowed, core::ScreeningRule::kSignificance}) {
    const std::uint64_t before_constructor = allocations();
    core::Denoiser denoiser(1024, with_rule(rule));
    const std::uint64_t before = allocations();
    EXPECT_GT(before, before_constructor) << "the counter counts";
    for (const std::size_t size : {1024U, 16U, 999U}) {
      denoiser.denoise(std::span(window).first(size), std::span(out).first(size), report);
      models += report.k - report.j;
    }
    EXPECT_EQ(allocations(), before);
  }
  EXPECT_GT(models, 0U) << "AR models and Kalman filters were among what ran";
}

}  // namespace
}  // namespace gyrod
