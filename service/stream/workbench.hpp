/// What one worker works with: its copy of the method and its buffers.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "stream/channel.hpp"
#include "stream/counters.hpp"
#include "stream/method.hpp"

namespace gyrod::stream {

/// Turns a window job into released samples and a report. work() allocates nothing. One a worker.
class Workbench {
 public:
  /// @param factory outlives the bench
  Workbench(const EngineOptions& options, const MethodFactory& factory);

  /// Models of windows that are doubled so many times can be made from here on. While another thread is in work(), with jobs of fewer doublings.
  /// By one thread. @throws std::bad_alloc, as it was before
  void make_room(unsigned doublings);

  /// Works on one window of the channel; the result stands in samples() and report() until the next call.
  /// @param pass_through release the samples as measured, flagged (overload step 2, or the stop's deadline
  /// has passed)
  /// @pre the caller owns the channel
  void work(Channel& channel, const WindowJob& job, bool pass_through) noexcept;

  /// Released samples, in order. Empty for a model method, whose samples the fast loop releases.
  [[nodiscard]] std::span<const DenoisedSample> samples() const noexcept { return samples_; }
  [[nodiscard]] const NoiseReport& report() const noexcept { return report_; }
  /// False where the last job was passed through: there is nothing to report.
  [[nodiscard]] bool has_report() const noexcept { return has_report_; }

  /// Shortest window that the method takes.
  [[nodiscard]] std::size_t min_samples() const noexcept;
  /// Time that work() took, for the report.
  void set_window_time(double seconds) noexcept { report_.window_time_s = seconds; }
  /// Adds to the histograms of this worker.
  void count_times(double window_time_s, double added_latency_s);
  /// Adds this worker's histograms to the snapshot.
  void add_times_to(EngineSnapshot& snapshot) const;

 private:
  /// For windows of one length.
  struct ModelTool {
    std::unique_ptr<ModelMethod> method;
    std::vector<double> window;  ///< of each axis, one after the other
  };

  void collect(const Channel& channel, const WindowJob& job) noexcept;
  void denoise(Channel& channel, const WindowJob& job) noexcept;
  void fit(ModelTool& tool, Channel& channel, const WindowJob& job) noexcept;
  void describe(Channel& channel, const WindowJob& job) noexcept;

  std::size_t window_samples_;
  std::size_t hop_samples_;
  const ModelMethodFactory* models_;                 ///< none for a window method
  std::unique_ptr<WindowMethod> window_method_;      ///< none for a model method
  std::array<ModelTool, kMostDoublings + 1> tools_;  ///< by doublings
  std::vector<double> window_;                       ///< of a window method
  std::vector<double> denoised_;
  std::vector<DenoisedSample> samples_;
  NoiseReport report_;
  bool has_report_ = false;

  mutable std::mutex times_mutex_;
  TimeHistogram window_time_;
  TimeHistogram added_latency_;
};

}  // namespace gyrod::stream
