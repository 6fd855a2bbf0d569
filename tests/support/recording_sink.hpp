/// A sink that keeps what the engine releases, for tests.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "stream/engine.hpp"

namespace gyrod::testing {

/// Thread-safe; samples() and reports() are copies.
class RecordingSink : public stream::Sink {
 public:
  void on_samples(std::string_view sensor,
                  std::span<const stream::DenoisedSample> samples) noexcept override {
    const std::lock_guard lock(mutex_);
    auto& all = samples_[std::string{sensor}];
    all.insert(all.end(), samples.begin(), samples.end());
    calls_.push_back(samples.size());
  }
  void on_realtime(std::string_view sensor,
                   std::span<const stream::DenoisedSample> samples) noexcept override {
    const std::lock_guard lock(mutex_);
    auto& all = realtime_[std::string{sensor}];
    all.insert(all.end(), samples.begin(), samples.end());
    realtime_calls_.push_back(samples.size());
  }
  void on_report(std::string_view sensor, const stream::NoiseReport& report) noexcept override {
    const std::lock_guard lock(mutex_);
    reports_[std::string{sensor}].push_back(report);
  }
  void on_end(std::string_view sensor) noexcept override {
    const std::lock_guard lock(mutex_);
    ended_after_[std::string{sensor}].push_back(samples_[std::string{sensor}].size());
  }
  /// Number of samples that had been released when the sensor's end was told, once an end.
  [[nodiscard]] std::vector<std::size_t> ended_after(const std::string& sensor) const {
    const std::lock_guard lock(mutex_);
    const auto found = ended_after_.find(sensor);
    return found == ended_after_.end() ? std::vector<std::size_t>{} : found->second;
  }
  [[nodiscard]] std::vector<stream::DenoisedSample> samples(const std::string& sensor) const {
    const std::lock_guard lock(mutex_);
    const auto found = samples_.find(sensor);
    return found == samples_.end() ? std::vector<stream::DenoisedSample>{} : found->second;
  }
  [[nodiscard]] std::vector<stream::DenoisedSample> realtime(const std::string& sensor) const {
    const std::lock_guard lock(mutex_);
    const auto found = realtime_.find(sensor);
    return found == realtime_.end() ? std::vector<stream::DenoisedSample>{} : found->second;
  }
  /// Samples of each call of on_samples(), any sensor.
  [[nodiscard]] std::vector<std::size_t> calls() const {
    const std::lock_guard lock(mutex_);
    return calls_;
  }
  /// Samples of each call of on_realtime(), any sensor.
  [[nodiscard]] std::vector<std::size_t> realtime_calls() const {
    const std::lock_guard lock(mutex_);
    return realtime_calls_;
  }
  [[nodiscard]] std::vector<stream::NoiseReport> reports(const std::string& sensor) const {
    const std::lock_guard lock(mutex_);
    const auto found = reports_.find(sensor);
    return found == reports_.end() ? std::vector<stream::NoiseReport>{} : found->second;
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::vector<stream::DenoisedSample>> samples_;
  std::map<std::string, std::vector<stream::DenoisedSample>> realtime_;
  std::vector<std::size_t> calls_;
  std::vector<std::size_t> realtime_calls_;
  std::map<std::string, std::vector<stream::NoiseReport>> reports_;
  std::map<std::string, std::vector<std::size_t>> ended_after_;
};

}  // namespace gyrod::testing
