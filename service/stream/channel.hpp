/// One sensor's state in the engine.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stream/counters.hpp"
#include "stream/engine.hpp"
#include "stream/fast_loop.hpp"
#include "stream/health_judge.hpp"
#include "stream/health_watch.hpp"
#include "stream/hop_schedule.hpp"
#include "stream/sample_gate.hpp"
#include "stream/sample_ring.hpp"
#include "stream/splice.hpp"

namespace gyrod::stream {

/// What stands at a position of a channel.
enum class Place : std::uint8_t {
  kMeasured,  ///< a sample that is to leave
  kHistory,  ///< a sample that was published before this start: as above for window, filter and learner, but does not leave
  kBridged,  ///< an interpolated place of a missing sample
};

/// Positions that a channel remembers: the window at hand, those that wait, and the stretch up to the next, widest hop.
[[nodiscard]] std::size_t channel_positions(const EngineOptions& options, unsigned doublings) noexcept;

/// Everything a channel owns, sized when it opens; of model methods the ring once more for each doubling of windows.
///
/// Two parties touch it. The *intake* (the thread that pushes) judges and appends samples and submits
/// windows. The *owner* (at most one worker at a time, or the intake itself) works on the oldest window. What
/// both touch lies behind the mutex: the job queue, the counts, the last report. The ring needs no lock: the
/// owner reads only positions of submitted windows, and the intake never overwrites those (has_room()).
class Channel {
 public:
  Channel(std::string sensor, const EngineOptions& options, const ModelMethodFactory* models);

  [[nodiscard]] const std::string& sensor() const noexcept { return sensor_; }

  // --- intake only
  // ---------------------------------------------------------------------------------------------------
  /// Takes the newest sample into the ring, and shows it to who learns the noise.
  void append(const Sample& sample, Place place);
  SampleGate gate;
  HopSchedule schedule;
  SampleRing ring;
  std::optional<FastLoop> fast_loop;  ///< model methods only
  /// Models in use are older than configured, or still missing. Model methods only.
  bool models_late = false;
  /// The window was closed for silence: the next sample begins a new one, whatever is missing before it.
  bool asleep = false;
  ChannelNoise noise;                     ///< what windows are given from now on
  std::unique_ptr<NoiseLearner> learner;  ///< may be none
  HealthWatch watch;

  /// Nothing comes: what leaves from now on leaves, perhaps, to nobody. Before the segment is closed.
  void note_silence(double now_s) noexcept;
  /// The sensor is not in sight any more, or was not before it came back: what had left until then. See Engine::come_again(). Before the
  /// segment is closed.
  void lose_sight(double now_s) noexcept;
  /// What had been seen may come once more.
  void expect_history() noexcept;
  /// Another process has served the sensor up to the mark: what comes of that is history.
  void continue_after(const PublishedMark& mark) noexcept;
  /// The newest sample that this process has taken, or that it knows to have been taken elsewhere.
  [[nodiscard]] std::optional<PublishedMark> taken_up_to() const noexcept;
  /// Whether the sample was published before this start (EngineOptions::published_before), or comes once more.
  [[nodiscard]] bool is_history(const Sample& sample) noexcept;
  /// From now on nothing is history.
  void end_history() noexcept { published_before_.reset(); }

  /// Samples have come at this time of the engine's clock.
  void hear(double now_s);
  /// Leaves a copy of what `watch` has seen for judge_health().
  void show_health();
  /// Nothing comes though it should: counts it, and what comes next begins a new window. @pre why is one of the silent states
  void fall_silent(ChannelState why);
  /// The sensor has ended. @param why kEnded, or one of the silent states
  void end(ChannelState why = ChannelState::kEnded) noexcept { state_ = why; }
  /// Engine time of the newest push.
  [[nodiscard]] double heard_s() const noexcept { return heard_s_; }

  /// True where one more position may be appended without overwriting what a window still needs.
  [[nodiscard]] bool has_room() const;
  /// True where one more window may be submitted.
  [[nodiscard]] bool can_submit() const;
  /// Puts a window behind the others. @return true if the channel must be handed to the scheduler
  /// @pre can_submit()
  [[nodiscard]] bool submit(const WindowJob& job);

  void count_received();
  void count_rejected(RejectReason reason);
  /// Counts what the gate saw in an accepted sample.
  void count_accepted(const Verdict& verdict);
  void count_bridged();
  void count_widened();
  /// Counts estimates without look-ahead that were handed over.
  void count_realtime(std::size_t samples);
  void count_misfits(std::uint64_t misfits);
  /// The origin of the models that were offered since the last call, if any.
  [[nodiscard]] std::optional<ModelOrigin> take_models();

  // --- owner
  // ---------------------------------------------------------------------------------------------------------
  std::optional<Splice> splice;  ///< window methods only
  /// Takes ownership of the oldest window; none where there is none or another owner is at work.
  /// @param scheduled the caller took the channel from the scheduler's queue
  [[nodiscard]] std::optional<WindowJob> begin_work(bool scheduled);
  /// The window is done and released: drops it, gives ownership up.
  /// @param denoised false where it was passed through (overload step 2, or too short)
  /// @return true if the channel must be handed to the scheduler again
  [[nodiscard]] bool end_work(bool denoised);
  /// Models of this segment are ready for the fast loop.
  void offer_models(const ModelOrigin& origin);

  // --- who judges health: one thread
  // ------------------------------------------------------------------------------------------------
  struct Judgement {
    SensorHealth before;
    SensorHealth now;
    bool changed = false;
    unsigned overload_step = 0;
  };
  /// Judges what was shown last. @param context but for the overload step, which the channel knows
  [[nodiscard]] Judgement judge_health(HealthContext context);
  /// The curves, where they rest on a tenth more terms than those that were fitted last.
  [[nodiscard]] std::optional<AllanCurves> curves_to_fit(double& sample_rate_hz) const;
  void keep_fit(const AllanCurves& fitted, const std::array<core::NoiseCoefficients, kAxes>& coefficients);

  // --- any thread
  // ----------------------------------------------------------------------------------------------------
  /// Counts released samples.
  void count_published(std::span<const DenoisedSample> samples);
  /// Overload step 2 is in force, or no longer.
  void set_pass_through(bool active);
  void keep_report(const NoiseReport& report);
  [[nodiscard]] std::uint64_t next_epoch();
  /// Submission time of the oldest window not done; none where there is none.
  [[nodiscard]] std::optional<double> oldest_submission() const;
  /// Nobody works on it or is about to: what the intake does not touch, nobody does.
  [[nodiscard]] bool idle() const;
  [[nodiscard]] bool silent() const noexcept { return is_silent(state_); }
  [[nodiscard]] Counts counts() const;
  [[nodiscard]] ChannelSnapshot snapshot() const;

 private:
  /// What a sensor keeps comes at once when it is found. A sensor that began anew with number and clock while nobody looked seems to send
  /// history, too; it is not taken for that any longer.
  static constexpr double kLongestHistory_s = 10.0;

  void take_block(const RestEvidence& rest);
  void look_for_history(double now_s);
  /// A silence is just over that was longer than the one that lasts: readers were lost in the longest.
  [[nodiscard]] bool heard_again_after_longer(double now_s) const noexcept;
  [[nodiscard]] std::optional<PublishedMark> last_published() const noexcept;
  /// The channel has work, no owner and no place in the scheduler's queue: takes the place.
  [[nodiscard]] bool must_schedule();

  std::string sensor_;
  mutable std::mutex mutex_;
  std::vector<WindowJob> jobs_;  ///< ring of the windows not done, oldest at first_job_
  std::size_t first_job_ = 0;
  std::size_t job_count_ = 0;
  bool owned_ = false;
  bool scheduled_ = false;  ///< stands in the scheduler's queue
  Counts counts_;
  NoiseReport last_report_;
  std::uint64_t epoch_ = 0;
  bool pass_through_ = false;
  unsigned worst_step_ = 0;  ///< of overload, since judge_health()
  double heard_s_ = 0.0;     ///< the intake's alone
  std::atomic<ChannelState> state_{ChannelState::kActive};
  std::optional<PublishedMark> before_silence_;    ///< the intake's alone
  double silence_s_ = 0.0;                         ///< how long it was; the intake's alone
  std::optional<double> heard_again_s_;            ///< when it ended; the intake's alone
  std::optional<PublishedMark> seen_;              ///< the intake's alone
  std::optional<double> history_until_s_;          ///< the intake's alone
  double history_lasts_s_ = kLongestHistory_s;     ///< the intake's alone
  std::optional<PublishedMark> published_before_;  ///< the intake's alone
  std::optional<ModelOrigin> offered_;
  std::uint32_t hop_samples_ = 0;
  double rate_hz_ = 0.0;
  HealthEvidence evidence_;
  HealthJudge judge_;  ///< the judge's alone
  std::optional<SensorHealth> health_;
  AllanCurves curves_{};
  double curves_rate_hz_ = 0.0;
  std::array<double, kAxes> bias_radps_{};
  double bias_s_ = 0.0;
  std::uint64_t fitted_terms_ = 0;
  std::array<core::NoiseCoefficients, kAxes> coefficients_{};
};

}  // namespace gyrod::stream
