/// The estimators that `gyrod evaluate` judges: the one place that knows them.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "app/noise_course.hpp"
#include "app/sensor_axes.hpp"
#include "core/evaluation/contender.hpp"
#include "settings/settings.hpp"

namespace gyrod::app {

/// What an estimator may know beforehand.
struct MethodContext {
  const settings::Settings& settings;
  double rate_hz = 0.0;
  NoiseCourse noise;           ///< the sensor's, deg/s, for takes_noise_model(); nothing: unknown
  bool learns_itself = false;  ///< instead of that: what each run shows at rest, by the one axis that it has
  std::size_t axis = 0;        ///< that runs are of
  /// What the sensor measures on its other axes, on runs of equal length; null: not known.
  std::shared_ptr<const SensorAxes> sensor = nullptr;
};

/// An estimator that is asked for.
struct WantedMethod {
  std::string name;             ///< one of evaluated_method_names()
  std::size_t lag_samples = 0;  ///< instead of that in the settings; at most largest_lag()
};

/// What --methods takes: "direct", "emd", "acf-emd", "improved"; "joint", the two-speed estimator with a lag, and "realtime", its answers at
/// once.
[[nodiscard]] std::vector<std::string> evaluated_method_names();

/// Whether a method's answers are of the newest sample, whatever lag it may have.
[[nodiscard]] bool answers_at_once(const std::string& name) noexcept;

/// Whether a method uses what is known of the sensor's noise, and guesses it where nothing is.
[[nodiscard]] bool takes_noise_model(const std::string& name) noexcept;

/// Largest lag in samples that a method takes.
[[nodiscard]] std::size_t largest_lag(const std::string& name, const settings::Settings& settings);

/// Their rates are in deg/s. Methods that differ in their lag only, or in answering at once, share their models of a record where they are run on
/// the same one: the first that is takes the time. Not to be run by several threads at once.
/// @pre the settings of the context outlive the methods
/// @param records that are remembered for that, at most: of those that one method is run on before the next is
/// @return one for each of `wanted`, in their order
[[nodiscard]] std::vector<core::Method> evaluated_methods(const std::vector<WantedMethod>& wanted,
                                                          const MethodContext& context,
                                                          std::size_t records = 1);

/// As above, one.
[[nodiscard]] core::Method evaluated_method(const WantedMethod& wanted, const MethodContext& context);

}  // namespace gyrod::app
