#include "core/simulation/simulated_gyro.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "core/simulation/random.hpp"

namespace gyrod::core {
namespace {

constexpr double kLargestRateHz = 100'000.0;
constexpr double kNsPerS = 1e9;

void require(bool good, const char* name, double value, const char* expected) {
  if (!good)
    throw std::invalid_argument(std::string(name) + " is " + std::to_string(value) + ", expected " +
                                expected);
}

void require_not_negative(const char* name, double value) {
  require(std::isfinite(value) && value >= 0.0, name, value, "a number not below 0");
}

void check(const GyroErrorOptions& errors) {
  require_not_negative("white_noise_density", errors.white_noise_density);
  require_not_negative("bias_instability_radps", errors.bias_instability_radps);
  require_not_negative("rate_random_walk", errors.rate_random_walk);
  require(std::isfinite(errors.bias_radps), "bias_radps", errors.bias_radps, "a finite number");
  require_not_negative("step_radps", errors.step_radps);
  require_not_negative("range_radps", errors.range_radps);
}

void check(const DriveOptions& drive) {
  require_not_negative("road_vibration_radps", drive.road_vibration_radps);
  require_not_negative("engine_tone_radps", drive.engine_tone_radps);
  require_not_negative("engine_tone_hz", drive.engine_tone_hz);
}

const SimulatedGyroOptions& checked(const SimulatedGyroOptions& options) {
  const double rate = options.sample_rate_hz;
  require(rate >= 1.0 && rate <= kLargestRateHz, "sample_rate_hz", rate, "1 to 100000");
  for (const auto& errors : options.errors) check(errors);
  if (options.drive) check(*options.drive);
  return options;
}

/// Seed number `index` of those that grow from one seed.
std::uint64_t child_seed(std::uint64_t seed, std::size_t index) noexcept {
  Random parent(seed);
  for (std::size_t skipped = 0; skipped < index; ++skipped) static_cast<void>(parent.next());
  return parent.next();
}

GyroErrors errors_of(const SimulatedGyroOptions& options, std::size_t axis) noexcept {
  return {options.errors[axis], options.sample_rate_hz, child_seed(options.seed, 1 + axis)};
}

}  // namespace

SimulatedGyro::SimulatedGyro(const SimulatedGyroOptions& options)
    : sample_rate_hz_(checked(options).sample_rate_hz),
      first_stamp_ns_(options.first_stamp_ns),
      errors_{errors_of(options, 0), errors_of(options, 1), errors_of(options, 2)} {
  if (options.drive) drive_.emplace(*options.drive, options.sample_rate_hz, child_seed(options.seed, 0));
}

SimulatedSample SimulatedGyro::next() noexcept {
  SimulatedSample sample;
  sample.sequence = sequence_;
  const double since_first_ns = std::round(static_cast<double>(sequence_) * kNsPerS / sample_rate_hz_);
  sample.stamp_ns = first_stamp_ns_ + static_cast<std::int64_t>(since_first_ns);
  ++sequence_;
  if (drive_) sample.truth_radps = drive_->next();
  for (std::size_t axis = 0; axis < errors_.size(); ++axis) {
    sample.measured_radps[axis] = errors_[axis].measure(sample.truth_radps[axis]);
  }
  return sample;
}

}  // namespace gyrod::core
