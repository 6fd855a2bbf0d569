/// Tells from the samples alone whether the sensor is at rest.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/noise/axis_spectra.hpp"
#include "core/noise/noise_fit.hpp"
#include "core/noise/own_low_pass.hpp"
#include "core/signal/periodogram.hpp"

namespace gyrod::core {

/// Rates, or specific forces, about x, y, z.
using Triple = std::array<double, 3>;

/// What the last eight blocks say.
enum class RestVerdict : std::uint8_t {
  kTooEarly,  ///< not eight blocks and two segments yet since the beginning, a gap, or blocks of another length
  kFrozen,    ///< no axis changes at all: not a sensor at rest
  kUneven,  ///< within the last eight blocks the level of some axis changed more than a constant noise would
  kWandering,  ///< the mean of some axis varies more than its noise explains: slow motion
  kTone,       ///< most of some axis is in narrow lines: an engine, a fan
  kRest        ///< none of these
};

/// Judges blocks of samples, eight at a time. A block is one second, or 100 samples where those take longer. At rest is who has, on each
/// axis that is alive, n samples a block, block variances v_i and block means m_i:
///   even:    max v_i / min v_i <= exp(7.5 sqrt(2 / min(r n, 400)));
///   steady:  var(m_i) n / mean(v_i) <= 8 s   (white noise: 1; chi-squared of 7 degrees, and twice that for colour),
///            m_i and n of parts of a block, one second each, where blocks are longer;
///   no tone: LineShares::all of the segments of the last four to eight blocks <= 0.4, and LineShares::further on all axes but one
///            <= 0.055 (2 / segments)^(9/4) / r, at least 0.005: little more than chance. A sensor has a line or two, a road many.
/// r and s are 1 but for a sensor that low-passes its noise: OwnLowPass::independent() and slow(). r n is taken to be 40 at least. Blocks are
/// twice and four times as long where it is below 75, until it is 90 or they are, for as long as the noise is narrow; a run begins anew then.
/// A block that is not even with those before begins a new run, and eight blocks of a run are judged.
/// The accelerometer, where there is one, must be even and steady (24, for it flickers), too, or within 0.02 m/s^2 on the axis: of a coarse
/// one, whose last digit comes and goes, no block is like the other. It has r and s of its own, and no more than the number of specific
/// forces that differ from the one before count: one that is slower than the gyro, and holds or repeats its last, tells so much less; n is
/// that number in the second rule. Neither level nor bias is judged: that takes a memory
/// (standstill_learner.hpp). The verdict is a function of samples and sample rate alone: no clock.
/// Constant memory of about 80 kB; nothing allocates after construction. One thread at a time.
class RestDetector {
 public:
  static constexpr std::size_t kBlocks = 8;

  /// @pre sample_rate_hz > 0
  explicit RestDetector(double sample_rate_hz);

  /// One sample, finite. @return whether it ended a block, so that verdict(), variance(), mean() and fresh() are new
  /// @param accelerometer specific force, m/s^2, finite, or nullptr. Where this changes from one sample to the next it is a gap
  bool step(const Triple& rate, const Triple* accelerometer = nullptr) noexcept;

  /// One sample that nobody measured, on the line between its neighbours: what is interpolated has less noise. Two in a hundred of a block
  /// make no difference that counts; more of them are a gap. @return as step()
  bool bridge(const Triple& rate, const Triple* accelerometer = nullptr) noexcept;

  /// A gap: what follows does not join what was.
  void interrupt() noexcept;

  /// The sample rate turns out to be another: begins anew with it. Allocates nothing. @pre sample_rate_hz > 0
  void retime(double sample_rate_hz) noexcept;

  [[nodiscard]] RestVerdict verdict() const noexcept { return verdict_; }
  /// Mean of the block variances, the unit of the rate squared; 0 for an axis that does not change.
  [[nodiscard]] const Triple& variance() const noexcept { return variance_; }
  /// Mean rate over the eight blocks.
  [[nodiscard]] const Triple& mean() const noexcept { return mean_; }
  /// The half overlapping segments of kNoiseSegment samples that ended within the last block; all lie within the eight blocks.
  [[nodiscard]] const AxisSums& fresh() const noexcept { return fresh_; }
  [[nodiscard]] std::size_t block_samples() const noexcept { return block_samples_; }

 private:
  static constexpr std::size_t kInputs = 6;  ///< three rates, three specific forces

  /// One block of one input.
  struct Block {
    double mean = 0.0;
    double variance = 0.0;
    double variance_of_means = 0.0;  ///< of its parts
  };
  /// Sums over the block at work, counted from its first sample.
  struct Sums {
    double first = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    double part = 0.0;  ///< of the part at work
    double means = 0.0;
    double squared_means = 0.0;
  };
  using Window = std::array<Block, kBlocks>;
  struct Segments {
    std::array<NoiseSpectrum, 3> power{};
    double count = 0.0;
  };

  void add(std::size_t input, double value) noexcept;
  void end_part() noexcept;
  void end_block() noexcept;
  void set_parts(std::size_t parts) noexcept;
  void settle_block() noexcept;
  void end_segment() noexcept;
  void begin_run() noexcept;
  void add_fresh() noexcept;
  void end_half() noexcept;
  void take_force(const Triple& force) noexcept;
  [[nodiscard]] const OwnLowPass& low_pass_of(std::size_t input) const noexcept {
    return input < 3 ? low_pass_ : force_low_pass_;
  }
  [[nodiscard]] double fewest_in(std::size_t input, std::size_t blocks) const noexcept;
  void average() noexcept;
  [[nodiscard]] RestVerdict judge() noexcept;
  [[nodiscard]] bool newest_is_even() const noexcept;
  [[nodiscard]] double wandering(std::size_t input) const noexcept;
  [[nodiscard]] bool is_motionless(std::size_t input, std::size_t blocks) const noexcept;
  void listen() noexcept;

  OwnLowPass low_pass_;
  OwnLowPass force_low_pass_;
  std::size_t part_samples_ = 0;  ///< of a part of a block: the shortest block
  std::size_t parts_ = 1;         ///< of a block
  std::size_t block_samples_ = 0;
  std::size_t inputs_ = 3;
  std::size_t in_block_ = 0;
  std::size_t bridged_ = 0;  ///< of these
  std::size_t most_bridged_ = 0;
  std::size_t blocks_ = 0;  ///< of this run, kBlocks at most
  std::size_t newest_ = 0;
  bool after_gap_ = true;
  std::array<Sums, kInputs> sums_{};
  std::array<Window, kInputs> windows_{};
  Triple force_{};          ///< the last one
  std::size_t forces_ = 0;  ///< of the block at work that differ from the one before, its first among them
  std::array<double, kBlocks> force_counts_{};  ///< likewise, of the blocks
  Periodogram periodogram_;
  std::array<std::vector<double>, 3> segment_;  ///< the samples of the segment at work
  std::size_t in_segment_ = 0;
  AxisTransforms transforms_{};  ///< of the last segment
  AxisSums fresh_;
  Segments this_half_;  ///< of the run's blocks 1 to 4, 5 to 8 and so on: those at work
  Segments last_half_;
  std::size_t in_half_ = 0;  ///< blocks
  bool listened_ = false;
  bool tone_ = false;
  NoiseSpectrum scratch_{};
  RestVerdict verdict_ = RestVerdict::kTooEarly;
  Triple variance_{};
  Triple mean_{};
};

}  // namespace gyrod::core
