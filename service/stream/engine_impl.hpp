/// Inside of Engine: the intake (what push() does) and the work (what a worker does).
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "stream/channel.hpp"
#include "stream/engine.hpp"
#include "stream/registry.hpp"
#include "stream/scheduler.hpp"
#include "stream/workbench.hpp"

namespace gyrod::stream {

/// Lock order: homeless, then registry, then channel, then scheduler or idle. In push() and in the workers none is held while the sink or a
/// method runs; stop() walks over the channels under the registry's shared lock.
class Engine::Impl {
 public:
  Impl(EngineOptions options, MethodFactory method, Sink& sink, Clock clock);

  std::size_t push(std::string_view sensor, std::span<const Sample> samples) noexcept;
  void end_of_stream(std::string_view sensor) noexcept;
  void come_again(std::string_view sensor) noexcept;
  void give_up(std::string_view sensor) noexcept;
  [[nodiscard]] std::optional<PublishedMark> taken_up_to(std::string_view sensor) const noexcept;
  void continue_after(std::string_view sensor, const PublishedMark& mark) noexcept;
  void fall_silent(std::string_view sensor, ChannelState why) noexcept;
  void tend() noexcept;
  void judge_health();
  void fit_curves();
  void hurry_after(std::chrono::milliseconds deadline) noexcept;
  bool stop(std::chrono::milliseconds deadline);
  void wait_idle();
  [[nodiscard]] EngineSnapshot snapshot() const;
  [[nodiscard]] std::vector<ChannelSnapshot> channels(std::size_t limit) const;
  void visit_channels(std::size_t limit, const std::function<void(const ChannelSnapshot&)>& visit) const;
  [[nodiscard]] std::optional<ChannelSnapshot> channel(std::string_view sensor) const;
  [[nodiscard]] const EngineOptions& options() const noexcept { return options_; }

 private:
  // Intake, in the thread that pushes (intake.cpp).
  [[nodiscard]] Channel* channel_for(std::string_view sensor, RejectReason& refusal);
  void refuse(std::size_t samples, RejectReason reason);
  void listen_again();
  bool take(Channel& channel, const Sample& sample);
  void bridge(Channel& channel, const Sample& next, std::uint64_t count);
  void append(Channel& channel, const Sample& sample, Place place);
  void hop(Channel& channel);
  void close_segment(Channel& channel, bool ends_stream);
  void adjust_hop(Channel& channel);
  void fall_silent(Channel& channel, ChannelState why);
  void forget(double now_s);

  // Fast loop of model methods, in the thread that pushes (intake_models.cpp).
  void step_fast_loop(Channel& channel, const Sample& newest, Place place);
  [[nodiscard]] std::uint32_t state_flags(const Channel& channel) const;
  [[nodiscard]] bool adopt_models(Channel& channel);
  void follow_rate(Channel& channel);
  [[nodiscard]] bool make_room(Channel& channel, unsigned doublings);
  [[nodiscard]] bool models_are_late(const Channel& channel) const;
  void release_estimate(Channel& channel, Position position, const std::array<Estimate, kAxes>& estimate,
                        std::uint32_t flags);
  void release_held(Channel& channel);
  void flush(Channel& channel);

  // Work, in a worker, or in the thread that pushes where that must not wait any longer (engine.cpp).
  void submit(Channel& channel, WindowJob job);
  bool work(Channel& channel, Workbench& bench, bool scheduled);
  void release(Channel& channel, const WindowJob& job, const Workbench& bench);
  void release_report(Channel& channel, const WindowJob& job, const NoiseReport& report);
  [[nodiscard]] bool too_late(double submitted_s);
  /// Waits while the condition holds; windows that grow too old meanwhile are passed through here.
  template <typename Condition>
  void wait_while(Channel& channel, const Condition& condition) {
    while (condition()) {
      waits_ = true;
      const auto oldest = channel.oldest_submission();
      if (oldest && too_late(*oldest) && work(channel, *benches_.back(), false)) continue;
      flush(channel);
      wait_for_progress();
    }
  }
  void wait_for_progress();

  EngineOptions options_;
  MethodFactory method_;
  Sink& sink_;
  Clock clock_;
  Registry registry_;
  mutable std::mutex homeless_mutex_;
  Counts homeless_;              ///< of samples refused before they had a channel, and of forgotten channels
  std::uint64_t forgotten_ = 0;  ///< channels
  std::vector<std::unique_ptr<Workbench>> benches_;  ///< one a worker, and the intake's at the end
  std::atomic<bool> stopping_{false};
  std::atomic<double> deadline_s_{std::numeric_limits<double>::infinity()};  ///< of the stop
  std::atomic<bool> hurry_{false};  ///< the stop's deadline has passed: release everything undenoised
  mutable std::mutex idle_mutex_;
  std::condition_variable window_done_;
  std::size_t outstanding_ = 0;  ///< windows submitted and not done, behind idle_mutex_
  // Whether gyrod itself listens: while push() waits, nobody is heard.
  std::atomic<bool> waits_{false};
  std::atomic<double> deaf_until_s_{0.0};
  std::vector<Channel*> judged_;  ///< the judge's, kept for its memory
  std::size_t next_to_fit_ = 0;   ///< the judge's
  mutable std::mutex health_mutex_;
  HealthCounts by_health_{};
  HealthCounts health_changes_{};
  unsigned overload_step_ = 0;
  // What the fast loop has made in this call of push(), of the one sensor that is pushed.
  std::vector<DenoisedSample> outbox_;
  std::vector<DenoisedSample> realtime_outbox_;
  std::optional<Scheduler> scheduler_;  ///< last: its threads use all of the above
};

}  // namespace gyrod::stream
