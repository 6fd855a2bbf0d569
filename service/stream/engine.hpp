/// The streaming engine: samples in, denoised samples out, in order, counted, on a pool of workers.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "stream/counters.hpp"
#include "stream/health.hpp"
#include "stream/method.hpp"
#include "stream/noise_learner.hpp"
#include "stream/report.hpp"
#include "stream/sample.hpp"

namespace gyrod::stream {

/// Where released samples go. Samples of one sensor come by one thread at a time and in sequence order: the thread that finished
/// the work (a worker, or the caller of Engine). A report comes from the worker that made it; with a model method that can be
/// while the caller of Engine hands over samples of the same sensor. Must not call back into the engine.
class Sink {
 public:
  virtual ~Sink() = default;
  /// @param sensor valid during the call
  /// @param samples of a window method a hop's, of a model method what push() has made so far, at most kMaxModelReleaseSamples
  virtual void on_samples(std::string_view sensor, std::span<const DenoisedSample> samples) noexcept = 0;
  /// Model methods only: what the newest samples are taken for without look-ahead, one for each sample accepted, in order. From the
  /// caller of Engine, before push() returns and before it waits for workers. The same samples come again by on_samples(), `lag` later.
  virtual void on_realtime(std::string_view /*sensor*/,
                           std::span<const DenoisedSample> /*samples*/) noexcept {}
  /// One report a window, after the window's samples.
  virtual void on_report(std::string_view sensor, const NoiseReport& report) noexcept = 0;
  /// The sensor has ended (end_of_stream) or is forgotten (tend), after the last of its samples and reports. A stop alone ends no
  /// sensor.
  virtual void on_end(std::string_view sensor) noexcept = 0;
  /// The state of an axis has changed, or is known for the first time (`before`: warming up). From judge_health().
  virtual void on_health(std::string_view /*sensor*/, const SensorHealth& /*before*/,
                         const SensorHealth& /*now*/) noexcept {}
  /// The sensor's channel has closed for good: after on_end(), from tend().
  virtual void on_forgotten(std::string_view /*sensor*/) noexcept {}
};

struct EngineOptions {
  /// Samples of a full window, before it is stretched. 64..65536.
  std::size_t window_samples = 1024;
  /// Samples between windows. 1..window_samples/2.
  std::size_t hop_samples = 32;
  /// Widest hop under overload, samples; hop_samples..window_samples/2.
  std::size_t max_hop_samples = 256;
  /// Model methods: windows of fast sensors are longer than that, as doublings_at() says, and all hops, too, as hop_doublings() says.
  bool stretch_windows = true;
  /// Look-ahead of a released sample, samples. 0..window_samples/4; of a model method at most kMaxModelLagSamples.
  std::size_t lag_samples = 16;
  /// Windows of one channel that may wait for a worker. 1..64.
  std::size_t max_queued_windows = 4;
  /// Workers; 0 computes in the thread that pushes (offline use, tests).
  std::size_t workers = 2;
  /// Sensors at the most; further ids are refused and counted. 1..100000.
  std::size_t max_channels = 1024;
  /// Sample rate, Hz; 0 estimates it from the stamps.
  double sample_rate_hz = 0.0;
  /// Angular rates beyond this are refused, rad/s. Default: ten times the range of a common 1000 deg/s
  /// sensor.
  double max_rate_radps = 175.0;
  /// Missing samples that are bridged by interpolation; a longer gap closes the window. 0..window_samples/4.
  std::size_t max_bridged_samples = 16;
  /// Age of a waiting window at which overload is declared, s. 0.01..3600.
  double max_delay_s = 1.0;
  /// A sensor that has sent nothing for so long is silent: what its window holds is released, s. 0..86400, 0: never. See tend().
  double silent_after_s = 5.0;
  /// A sensor that has sent nothing for so long, or ended so long ago, is forgotten: its channel closes, s. silent_after_s..31536000,
  /// or 0: never. See tend().
  double forget_after_s = 3600.0;
  /// When a sensor is in which state.
  HealthOptions health = {};
  /// What is known beforehand of a sensor's noise: asked once, when its channel opens. May be empty: nothing. May throw std::bad_alloc
  /// only, which refuses the channel.
  std::function<ChannelNoise(std::string_view sensor)> noise;
  /// The newest sample of the sensor that was published before this start, by another process that served it: asked once, when its
  /// channel opens. Samples up to it fill the window and do not leave again; they are counted as RejectReason::kHistory. Holds for 10 s
  /// from the sensor's first samples on. May be empty: nothing was published before.
  std::function<std::optional<PublishedMark>(std::string_view sensor)> published_before;
  /// Makes what learns a sensor's noise, when its channel opens; it may answer with none. May be empty: nobody learns. May throw
  /// std::bad_alloc only.
  std::function<std::unique_ptr<NoiseLearner>(std::string_view sensor)> learner;
};

/// How often the window of a model method is doubled at this sample rate (0 while unknown), once windows of fewer doublings are full.
[[nodiscard]] unsigned doublings_at(const EngineOptions& options, double sample_rate_hz) noexcept;

/// Accepted samples of one sensor that the engine has not released, at the most: of a window method the window at hand, those that wait, and the
/// stretch up to the next, widest hop; of a model method no more than its lag.
[[nodiscard]] std::size_t most_held_samples(const EngineOptions& options) noexcept;

/// Seconds of a steady clock; tests inject their own.
using Clock = std::function<double()>;

/// Thread safety: push(), end_of_stream() and stop() may be called from any one thread at a time (the bus
/// thread); the snapshots from any thread at any time.
class Engine {
 public:
  /// @throws std::invalid_argument for an option outside its range, naming it; std::runtime_error where a worker does not start
  Engine(EngineOptions options, MethodFactory method, Sink& sink, Clock clock = {});
  /// Stops as by stop() with a deadline of zero: what is not released by then passes through undenoised.
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Takes samples of one sensor, oldest first. Opens a channel for a new sensor. Refuses bad samples, each
  /// counted under one reason. Waits while the sensor's windows wait for a worker (backpressure), at most
  /// until overload is declared. Does not allocate once the channel is open, but where windows of a model method double: kMostDoublings
  /// times a channel at the most.
  /// @return samples that will leave; the rest was refused, or has left before (EngineOptions::published_before)
  std::size_t push(std::string_view sensor, std::span<const Sample> samples) noexcept;

  /// The sensor has ended: releases what its channel holds (flagged kTail) and forgets its window; the
  /// channel and its counts stay, and a later sample opens a new window.
  void end_of_stream(std::string_view sensor) noexcept;

  /// The sensor was out of sight and is back, and may send once more what was taken of it, before the rest: what had left before it fell
  /// silent fills the window and does not leave again, as with EngineOptions::published_before. Where it has not ended, its window is
  /// closed first. What left later leaves again, as readers may have been lost with the sensor: what the window held, and what had waited
  /// to be taken while this process stood still.
  void come_again(std::string_view sensor) noexcept;

  /// Another process serves the sensor from now on: as end_of_stream(), and what that one serves is not missing when the sensor is
  /// served here again.
  void give_up(std::string_view sensor) noexcept;

  /// The newest sample of the sensor that was accepted here, or published before (EngineOptions::published_before, continue_after());
  /// none if there is none. By the thread that pushes.
  [[nodiscard]] std::optional<PublishedMark> taken_up_to(std::string_view sensor) const noexcept;

  /// Another process has served the sensor until now, and has accepted its samples up to the mark: where they come, in the minute from the
  /// sensor's next samples on, they fill the window and do not leave, as with EngineOptions::published_before. Opens a channel for a new
  /// sensor; nothing where that is refused.
  void continue_after(std::string_view sensor, const PublishedMark& mark) noexcept;

  /// The bus tells that the sensor does not send though it should: what tend() does of a silent sensor, at once. Where it has ended, only
  /// its state says why; nothing where it is silent already. @pre why is kDeadlineMissed or kLivelinessLost
  void fall_silent(std::string_view sensor, ChannelState why) noexcept;

  /// Looks after sensors that send nothing: time alone brings no sample, so whoever pushes calls this about once a second.
  ///   silent:    its window is closed as by a gap, its last samples flagged kTail; what comes next begins a new window. Where
  ///              samples were late and not lost, this changes bits and flags against a run in which they came in time;
  ///   forgotten: the channel closes, and its memory is free for another. Its counts stay in the totals. If it comes back it is new, with
  ///              the noise that EngineOptions::noise knows by then.
  void tend() noexcept;

  /// Says of every sensor how it is, by what was pushed until now: to be called about once a second, by the thread that calls tend();
  /// others may push meanwhile.
  void judge_health();

  /// Fits the Allan curves of one sensor, at most, whose curves have grown by a tenth: some 30 ms of computing. By the thread that calls
  /// tend(); others may push meanwhile.
  void fit_curves();

  /// Releases all that is held, denoised while the deadline lasts and then passed through: nothing accepted
  /// is lost. After it every push is refused and counted.
  /// @return true if all of it was denoised within the deadline
  bool stop(std::chrono::milliseconds deadline);

  /// What is not denoised in that time passes through undenoised, also what is pushed later: bounds the time
  /// until stop(). Any thread.
  void hurry_after(std::chrono::milliseconds deadline) noexcept;

  /// Waits until no window waits or is computed. For tests and offline use.
  void wait_idle();

  [[nodiscard]] EngineSnapshot snapshot() const;
  /// Every channel in the order of opening; `limit` bounds the copy.
  [[nodiscard]] std::vector<ChannelSnapshot> channels(std::size_t limit) const;
  /// The same one by one, without room for all at once. No lock is held while `visit` works: one that closes meanwhile may hide
  /// others from this call.
  void visit_channels(std::size_t limit, const std::function<void(const ChannelSnapshot&)>& visit) const;
  /// None where there is no such channel.
  [[nodiscard]] std::optional<ChannelSnapshot> channel(std::string_view sensor) const;
  [[nodiscard]] const EngineOptions& options() const noexcept;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gyrod::stream
