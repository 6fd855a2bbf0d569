/// What the tests of the engine share.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <vector>

#include <gtest/gtest.h>

#include "stream/engine.hpp"
#include "support/recording_sink.hpp"
#include "support/samples.hpp"
#include "support/toy_methods.hpp"

namespace gyrod::stream {

using testing::counting_samples;
using testing::noisy_samples;
using testing::RecordingSink;
using testing::sample_at;
using testing::window_marker;

inline EngineOptions small_options(std::size_t workers = 0) {
  EngineOptions options;
  options.window_samples = 128;
  options.hop_samples = 32;
  options.max_hop_samples = 64;
  options.lag_samples = 16;
  options.workers = workers;
  options.max_channels = 8;
  options.max_delay_s = 3600.0;  // never overloaded, however slow the machine
  options.max_rate_radps = 1e6;  // samples that count up are legal
  return options;
}

inline void expect_conserved(const Counts& counts) {
  EXPECT_EQ(counts.received, counts.published + counts.rejected_total() + counts.in_flight);
}

inline std::vector<std::uint64_t> sequences(const std::vector<DenoisedSample>& samples) {
  std::vector<std::uint64_t> all;
  for (const DenoisedSample& sample : samples) all.push_back(sample.sequence);
  return all;
}

inline bool same_bits(const std::vector<DenoisedSample>& a, const std::vector<DenoisedSample>& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const DenoisedSample& x, const DenoisedSample& y) {
        return x.sequence == y.sequence && x.stamp_ns == y.stamp_ns && x.rate_radps == y.rate_radps &&
               x.rate_std_radps == y.rate_std_radps && x.flags == y.flags &&
               x.noise_floor_radps == y.noise_floor_radps && x.model_epoch == y.model_epoch;
      });
}

[[nodiscard]] inline bool has_flag(const DenoisedSample& sample, SampleFlag flag) {
  return (sample.flags & static_cast<std::uint32_t>(flag)) != 0;
}

/// Lets tests hold workers inside a window.
class Gatekeeper {
 public:
  void pass() {
    std::unique_lock lock(mutex_);
    ++waiting_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return open_; });
    --waiting_;
  }
  /// Waits until somebody waits at the gate, which is closed.
  void wait_for_entry() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_ > 0; });
  }
  void set_open(bool open) {
    {
      const std::lock_guard lock(mutex_);
      open_ = open;
    }
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = true;
  int waiting_ = 0;
};

}  // namespace gyrod::stream
