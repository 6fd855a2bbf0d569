/// What a navigation starts with: state and biases.
#pragma once

#include <optional>

#include "app/navigation_comparison.hpp"
#include "core/inertial/dead_reckoning.hpp"
#include "files/navigation_columns.hpp"
#include "files/record.hpp"

namespace gyrod::app {

/// Samples [first, end) of a record: one navigation.
struct NavigationSpan {
  std::size_t first = 0;
  std::size_t end = 0;
};

/// Applies NavigationOptions to one record and its truth, for any run. All it is made of has to outlive it.
class NavigationSetup {
 public:
  struct Start {
    core::NavigationState state;
    core::SensorBias bias;
  };

  /// @throws files::FileError if biases are to come from a truth that has no attitude
  NavigationSetup(const files::Record& record, const files::Accelerometer& accelerometer,
                  const std::optional<files::NavigationTruth>& truth, const NavigationOptions& options);

  [[nodiscard]] BiasSource bias_source() const noexcept { return bias_source_; }
  [[nodiscard]] bool attitude_from_truth() const noexcept { return truth_ && truth_->truth.has_attitude(); }
  /// A stretch at rest before the start is used.
  [[nodiscard]] bool needs_levelling() const noexcept {
    return !attitude_from_truth() || bias_source_ == BiasSource::kLevelling;
  }
  /// The heading is found by matching velocities.
  [[nodiscard]] bool matches_heading() const noexcept {
    return truth_ && !attitude_from_truth() && truth_->truth.has_velocity() && !options_.heading_deg;
  }

  [[nodiscard]] core::InertialSeries series_of(const NavigationRun& run) const;

  /// The run's biases for the whole record; nothing unless they come from the truth.
  /// @throws files::FileError if no second of the truth can be used
  [[nodiscard]] std::optional<core::SensorBias> constant_bias(const core::InertialSeries& series) const;

  /// @param constant from constant_bias() of the same series
  [[nodiscard]] Start start_of(const core::InertialSeries& series, const NavigationSpan& span,
                               const std::optional<core::SensorBias>& constant) const;

 private:
  [[nodiscard]] core::NavigationState known_state(std::size_t index) const;
  [[nodiscard]] core::InertialSample mean_at_rest(const core::InertialSeries& series,
                                                  std::size_t start) const;
  [[nodiscard]] Start start_with_heading(const core::InertialSeries& series, const NavigationSpan& span,
                                         const std::optional<core::SensorBias>& constant,
                                         double heading_rad) const;
  [[nodiscard]] double matched_heading(const core::InertialSeries& series, const NavigationSpan& span,
                                       const Start& start) const;

  const files::Record& record_;
  const files::Accelerometer& accelerometer_;
  const std::optional<files::NavigationTruth>& truth_;
  const NavigationOptions& options_;
  BiasSource bias_source_;
};

}  // namespace gyrod::app
