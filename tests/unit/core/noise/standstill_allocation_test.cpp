// Nothing is allocated after the constructor.
#include <gtest/gtest.h>

#include "core/evaluation/butterworth.hpp"
#include "core/noise/hidden_noise_learner.hpp"
#include "core/noise/standstill_learner.hpp"
#include "support/allocation_counter.hpp"
#include "unit/core/noise/rest_support.hpp"

namespace gyrod::core {
namespace {

TEST(StandstillAllocation, LearningAndForgettingAllocateNothing) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "the sanitizer brings its own heap";
  const testing::Axes loud = testing::still_axes(6000, 0.6, 1);
  const testing::Axes quiet = testing::still_axes(6000, 0.2, 2);
  StandstillLearner learner(100.0);
  const auto before = testing::allocations();
  testing::run(learner, loud, [] {});
  testing::run(learner, quiet, [] {});
  const bool restored = learner.restore(learner.state());
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_TRUE(restored);
  EXPECT_GT(learner.revision(), 4U) << "it learned";
}

TEST(HiddenNoiseAllocation, LearningAndForgettingAllocateNothing) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "the sanitizer brings its own heap";
  testing::Axes axes = testing::still_axes(40'000, 0.3, 1);
  for (auto& axis : axes) filter_forward(butterworth(2, 0.1), axis);
  HiddenNoiseLearner learner(1000.0);
  const auto before = testing::allocations();
  testing::run(learner, axes, [] {});
  const auto revision = learner.revision();
  learner.interrupt();
  learner.retime(200.0);
  EXPECT_EQ(testing::allocations(), before);
  EXPECT_GT(revision, 0U) << "it learned";
}

}  // namespace
}  // namespace gyrod::core
