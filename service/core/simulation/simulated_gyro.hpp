/// A three-axis MEMS gyro that is not there: seeded, endless, with the truth beside every measurement.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/simulation/drive_motion.hpp"
#include "core/simulation/gyro_errors.hpp"

namespace gyrod::core {

struct SimulatedGyroOptions {
  /// Hz, 1..100000.
  double sample_rate_hz = 100.0;
  /// Same seed and options, same bits, on any machine.
  std::uint64_t seed = 1;
  /// Stamp of sample 0, ns since the epoch; sample n follows n / sample_rate_hz later, rounded to 1 ns.
  std::int64_t first_stamp_ns = 0;
  /// Errors of x, y, z; their noise is independent.
  std::array<GyroErrorOptions, 3> errors{};
  /// Motion of the car it is mounted in; nothing: still, truth 0.
  std::optional<DriveOptions> drive;
};

struct SimulatedSample {
  std::uint64_t sequence = 0;
  std::int64_t stamp_ns = 0;
  std::array<double, 3> truth_radps{};
  std::array<double, 3> measured_radps{};
};

/// Constant memory, allocates nothing; copies go on independently. One thread at a time.
class SimulatedGyro {
 public:
  /// @throws std::invalid_argument for an option outside its range, naming it
  explicit SimulatedGyro(const SimulatedGyroOptions& options);

  /// Samples 0, 1, 2, ...
  [[nodiscard]] SimulatedSample next() noexcept;

 private:
  double sample_rate_hz_;
  std::int64_t first_stamp_ns_;
  std::uint64_t sequence_ = 0;
  std::optional<DriveMotion> drive_;
  std::array<GyroErrors, 3> errors_;
};

}  // namespace gyrod::core
