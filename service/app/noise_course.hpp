/// What is known of one axis's noise in the course of a record.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/noise/noise_model.hpp"
#include "stream/sample.hpp"

namespace gyrod::app {

/// The model of windows of which at least so many samples of the record lie behind the end.
struct KnownNoise {
  std::size_t from_sample = 0;
  core::NoiseModel model;  ///< as it is used, core::kNoiseMargin included
  bool in_motion = false;  ///< learned in motion, behind a low-pass of the sensor's own
};

/// Each holds until the next, by rising from_sample; before the first, and where there is none, nothing is known.
using NoiseCourse = std::vector<KnownNoise>;

/// One model from the first window on.
[[nodiscard]] NoiseCourse known_throughout(const core::NoiseModel& model);

/// The model of a window that ends before sample `end`; one that is not usable where nothing is known by then.
[[nodiscard]] core::NoiseModel known_at(const NoiseCourse& course, std::size_t end) noexcept;

/// What the daemon would learn of a sensor that measures these rates, at rest or in motion, by stream::StandstillNoise, the sample rate known and without an
/// accelerometer: a course for each axis, in the unit of the rates. Rest is what is at rest on all axes; an axis that is empty or never changes
/// does not count, and has the strongest of the others' models.
/// @param rates_dps x, y, z, deg/s, finite, each empty or as long as the others
/// @param rate_hz above 0
/// Allocates; takes 0.2 us a sample.
[[nodiscard]] std::array<NoiseCourse, stream::kAxes> learned_from(
    const std::array<std::span<const double>, stream::kAxes>& rates_dps, double rate_hz);

}  // namespace gyrod::app
