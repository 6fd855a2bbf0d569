#include <atomic>
#include <memory>
#include <utility>

#include <gtest/gtest.h>

#include "stream/engine.hpp"
#include "stream/joint_method.hpp"
#include "stream/paper_method.hpp"
#include "support/allocation_counter.hpp"
#include "support/samples.hpp"
#include "support/toy_methods.hpp"

namespace gyrod::stream {
namespace {

class NullSink final : public Sink {
 public:
  void on_samples(std::string_view, std::span<const DenoisedSample>) noexcept override {}
  void on_report(std::string_view, const NoiseReport&) noexcept override {}
  void on_end(std::string_view) noexcept override {}
};

EngineOptions short_windows(std::size_t workers) {
  EngineOptions options;
  options.window_samples = 256;
  options.max_hop_samples = 128;
  options.workers = workers;
  options.max_delay_s = 3600.0;
  return options;
}

std::uint64_t allocations_after_warm_up(const MethodFactory& method, std::size_t workers) {
  NullSink sink;
  Engine engine(short_windows(workers), method, sink);
  const auto samples = testing::noisy_samples(4000);
  const std::span<const Sample> all{samples};
  engine.push("imu", all.first(1000));
  engine.wait_idle();
  const std::uint64_t before = testing::allocations();
  for (std::size_t n = 1000; n < 4000; n += 8) engine.push("imu", all.subspan(n, 8));
  engine.wait_idle();
  return testing::allocations() - before;
}

TEST(SamplePath, AllocatesNothingAfterWarmUp) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "sanitizers bring their own heap";
  EXPECT_EQ(allocations_after_warm_up(paper_method({}), 0), 0U);
  EXPECT_EQ(allocations_after_warm_up(paper_method({}), 2), 0U);
  EXPECT_EQ(allocations_after_warm_up(testing::last_sample_method(), 2), 0U);
}

TEST(SamplePath, AllocatesForEachDoublingOfAFastSensorsWindowsAndNeverAgain) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "sanitizers bring their own heap";
  const auto samples = testing::at_rate(testing::noisy_samples(8000), 1000);
  const std::span<const Sample> all{samples};
  for (const MethodFactory& method :
       {MethodFactory{testing::last_sample_method()}, MethodFactory{joint_method({})}}) {
    NullSink sink;
    Engine engine(short_windows(2), method, sink);
    const auto allocations_in = [&](std::size_t from, std::size_t to) {
      const std::uint64_t before = testing::allocations();
      for (std::size_t n = from; n < to; n += 8) engine.push("imu", all.subspan(n, 8));
      engine.wait_idle();
      return testing::allocations() - before;
    };
    EXPECT_GT(allocations_in(0, 1024), 0U) << "256 to 512 to 1024 samples";
    EXPECT_EQ(allocations_in(1032, 4000), 0U);
    engine.end_of_stream("imu");
    EXPECT_EQ(allocations_in(4000, 8000), 0U) << "the second stretch has what the first one needed";
  }
}

/// Whether a worker takes memory.
class WatchedMethod final : public ModelMethod {
 public:
  explicit WatchedMethod(std::unique_ptr<ModelMethod> method, std::atomic<std::uint64_t>& allocations)
      : method_(std::move(method)), allocations_(allocations) {}
  [[nodiscard]] std::size_t min_samples() const noexcept override { return method_->min_samples(); }
  void compare(const std::array<WindowInput, kAxes>& axes) noexcept override { method_->compare(axes); }
  void fit(const WindowInput& window, Model& model, core::WindowReport& report) noexcept override {
    const std::uint64_t before = testing::allocations();
    method_->fit(window, model, report);
    allocations_ += testing::allocations() - before;
  }
  void follow_noise(const WindowInput& window, Model& model) noexcept override {
    method_->follow_noise(window, model);
  }

 private:
  std::unique_ptr<ModelMethod> method_;
  std::atomic<std::uint64_t>& allocations_;
};

// A fit cannot say that there is no memory: what it needs of a longer window is there before.
TEST(SamplePath, WorkersAllocateNothingWhereWindowsDouble) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "sanitizers bring their own heap";
  std::atomic<std::uint64_t> allocations{0};
  ModelMethodFactory watched = joint_method({});
  watched.method = [&allocations, made = watched.method](std::size_t window, std::size_t hop) {
    return std::make_unique<WatchedMethod>(made(window, hop), allocations);
  };
  NullSink sink;
  Engine engine(short_windows(0), watched, sink);
  const auto samples = testing::at_rate(testing::noisy_samples(8000), 1000);
  engine.push("imu", samples);
  engine.wait_idle();
  EXPECT_EQ(allocations, 0U);
}

TEST(SamplePath, TheCounterCounts) {
  if (!testing::counts_allocations()) GTEST_SKIP() << "sanitizers bring their own heap";
  const std::uint64_t before = testing::allocations();
  const auto samples = testing::noisy_samples(10);
  EXPECT_EQ(samples.size(), 10U);
  EXPECT_GT(testing::allocations(), before);
}

}  // namespace
}  // namespace gyrod::stream
