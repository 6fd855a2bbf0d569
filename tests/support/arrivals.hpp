/// What a subscriber of a sample topic is given, with the times: for tests of losses, duplicates and pauses.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "bus/domain.hpp"
#include "bus/recorder.hpp"
#include "stream/sample.hpp"
#include "support/eventually.hpp"

namespace gyrod::testing {

/// Reads a topic on a thread of its own and keeps all of one sensor; of all sensors where it is empty, and then only the samples mean
/// something. Thread-safe.
class Arrivals final : private bus::RecordHandler {
 public:
  using Clock = std::chrono::steady_clock;

  Arrivals(const bus::Domain& domain, const bus::BusOptions& options, const std::string& topic,
           std::string sensor)
      : sensor_(std::move(sensor)),
        recorder_(domain, options, topic, std::chrono::seconds{60}),
        thread_([this] { work(); }) {}
  ~Arrivals() override {
    stopping_ = true;
    thread_.join();
  }
  Arrivals(const Arrivals&) = delete;
  Arrivals& operator=(const Arrivals&) = delete;

  [[nodiscard]] std::size_t writers() const { return recorder_.matched_writers(); }
  [[nodiscard]] std::size_t count() const {
    const std::lock_guard lock(mutex_);
    return samples_.size();
  }
  [[nodiscard]] std::vector<stream::DenoisedSample> samples() const {
    const std::lock_guard lock(mutex_);
    return samples_;
  }
  /// @return false if so many more do not come in time
  [[nodiscard]] bool more_arrive(std::size_t samples) const {
    const std::size_t before = count();
    return eventually([&] { return count() >= before + samples; });
  }
  /// Sequence numbers between the first and the last that never came.
  [[nodiscard]] std::uint64_t missing() const {
    const auto all = numbers();
    return all.empty() ? 0 : *all.rbegin() - *all.begin() + 1 - all.size();
  }
  /// The order in which numbers came, where it is not one after the other: "7>9 9>8 ...".
  [[nodiscard]] std::string jumps() const {
    const std::lock_guard lock(mutex_);
    std::string text;
    for (std::size_t i = 1; i < samples_.size(); ++i) {
      if (samples_[i].sequence == samples_[i - 1].sequence + 1) continue;
      text += std::to_string(samples_[i - 1].sequence) + ">" + std::to_string(samples_[i].sequence) + " ";
    }
    return text;
  }
  /// Samples that came more than once.
  [[nodiscard]] std::size_t duplicates() const { return count() - numbers().size(); }
  /// The longest time in which nothing came, between the first and the last.
  [[nodiscard]] double longest_pause_s() const {
    const std::lock_guard lock(mutex_);
    double longest_s = 0.0;
    for (std::size_t i = 1; i < times_.size(); ++i)
      longest_s = std::max(longest_s, std::chrono::duration<double>(times_[i] - times_[i - 1]).count());
    return longest_s;
  }

 private:
  void work() {
    constexpr std::chrono::milliseconds kLook{20};
    while (!stopping_) {
      // After the end of the last writer nothing is waited for.
      if (recorder_.poll(kLook, *this) == bus::Recorder::Poll::kEnded) std::this_thread::sleep_for(kLook);
    }
  }
  void on_samples(std::string_view sensor, std::span<const stream::DenoisedSample> samples) override {
    if (!sensor_.empty() && sensor != sensor_) return;
    const std::lock_guard lock(mutex_);
    samples_.insert(samples_.end(), samples.begin(), samples.end());
    times_.insert(times_.end(), samples.size(), Clock::now());
  }
  void on_end(std::string_view) override {}
  [[nodiscard]] std::set<std::uint64_t> numbers() const {
    const std::lock_guard lock(mutex_);
    std::set<std::uint64_t> all;
    for (const auto& sample : samples_) all.insert(sample.sequence);
    return all;
  }

  std::string sensor_;
  bus::Recorder recorder_;
  mutable std::mutex mutex_;
  std::vector<stream::DenoisedSample> samples_;
  std::vector<Clock::time_point> times_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace gyrod::testing
