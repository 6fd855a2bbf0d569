/// The samples that flow through the engine: SI units, time in nanoseconds since the Unix epoch.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace gyrod::stream {

inline constexpr std::size_t kAxes = 3;
inline constexpr std::array<const char*, kAxes> kAxisNames = {"x", "y", "z"};

/// One angular-rate sample of one sensor as it arrived.
struct Sample {
  /// Counts up by one per sample of a sensor; a step larger than one is a loss.
  std::uint64_t sequence = 0;
  /// When the sensor measured, ns since the epoch.
  std::int64_t stamp_ns = 0;
  /// x, y, z, rad/s.
  std::array<double, kAxes> rate_radps{};
  /// x, y, z, m/s^2: what the accelerometer beside the gyro measured, where there is one. It only helps to tell rest.
  std::optional<std::array<double, kAxes>> specific_force_mps2 = {};
};

/// The newest sample of a sensor that somebody has published.
struct PublishedMark {
  std::uint64_t sequence = 0;
  std::int64_t stamp_ns = 0;
};

/// What a released sample's `flags` say. Bits, combined by or.
enum class SampleFlag : std::uint32_t {
  /// The window was not full yet: denoised on what there was.
  kWarmingUp = 1U << 0U,
  /// Released at the end of a stream, before a long gap or at a stop; the last of them saw less than `lag` newer samples.
  kTail = 1U << 1U,
  /// Undenoised: the window was too short to decompose, or overload step 2 is in force.
  kPassThrough = 1U << 2U,
  /// Overload step 1 was in force: the hop was wider, or the model older, than configured.
  kHopWidened = 1U << 3U,
  /// The model does not explain the input: the standard deviation is not to be trusted. Model methods only.
  kModelMisfit = 1U << 4U,
};

/// Where a noise floor comes from, best source last.
enum class NoiseSource : std::uint32_t {
  kNone = 0,        ///< not known yet
  kImf1 = 1,        ///< variance of IMF 1 of the window in use
  kStandstill = 2,  ///< learned online at rest
  kCalibrated = 3,  ///< from a still recording or the data sheet
};

/// Stable snake_case name, as used in the API and in summaries.
[[nodiscard]] std::string_view name_of(NoiseSource source) noexcept;

/// One sample as it leaves, with the sequence number and stamp it came with.
struct DenoisedSample {
  std::uint64_t sequence = 0;
  std::int64_t stamp_ns = 0;
  std::array<double, kAxes> rate_radps{};
  /// Estimated standard deviation of the error of rate_radps, per axis, rad/s; 0 if unknown.
  std::array<double, kAxes> rate_std_radps{};
  /// SampleFlag bits.
  std::uint32_t flags = 0;
  NoiseSource noise_source = NoiseSource::kNone;
  /// Standard deviation of the input's white noise as known when the sample was denoised, per axis, rad/s; 0
  /// if unknown.
  std::array<double, kAxes> noise_floor_radps{};
  /// Counts the windows (or models) of this sensor: the one that made this sample. Restarts at 1 when a
  /// channel opens.
  std::uint64_t model_epoch = 0;
};

}  // namespace gyrod::stream
