/// The noise report of one window of a sensor: what monitoring and the noise topic show.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/denoise/window_report.hpp"
#include "stream/model_fit.hpp"
#include "stream/sample.hpp"

namespace gyrod::stream {

struct NoiseReport {
  /// Which window of this channel, from 1; DenoisedSample::model_epoch refers to it.
  std::uint64_t model_epoch = 0;
  /// Sequence number and stamp of the newest sample of the window.
  std::uint64_t last_sequence = 0;
  std::int64_t last_stamp_ns = 0;
  /// Samples between the newest one of the window and the newest one released.
  std::uint32_t lag_samples = 0;
  /// Hop in use, samples (wider than configured under overload).
  std::uint32_t hop_samples = 0;
  /// Sample rate in use, Hz; 0 while unknown.
  double sample_rate_hz = 0.0;
  NoiseSource noise_source = NoiseSource::kNone;
  std::uint32_t flags = 0;  ///< SampleFlag bits of the samples released with this window
  /// Time a worker spent on this window, all axes, s.
  double window_time_s = 0.0;
  /// Figures of x, y, z; energies and floors in rad/s.
  std::array<core::WindowReport, kAxes> axis{};
  /// Of the models that were in use when the window ended, x, y, z; none with a window method.
  std::optional<std::array<ModelFit, kAxes>> model_fit;
  /// Whether the sensor was at rest when the window ended; none where nobody looks.
  std::optional<bool> at_rest;
};

}  // namespace gyrod::stream
