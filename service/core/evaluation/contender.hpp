/// Whatever makes an estimate of a rate from a noisy record, so that all are judged alike.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gyrod::core {

/// Samples [begin, end) of the truth.
struct SampleRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Where an estimate is put together from pieces: the first sample of each piece is n with n mod period = first.
struct SeamPattern {
  std::size_t period = 0;  ///< above 0
  std::size_t first = 0;
};

/// Of windows that end at multiples of the hop, or of models that begin there: what is released begins a lag before. @pre hop > 0
[[nodiscard]] constexpr SeamPattern seams_every(std::size_t hop, std::size_t lag) noexcept {
  return {hop, (hop - lag % hop) % hop};
}

/// What one estimator made of one record. All rates in one unit, that of the record.
struct Contender {
  std::string name;
  /// The estimate of sample t is published when sample t + lag_samples has come in.
  std::size_t lag_samples = 0;
  /// estimate[t] is of the truth at t, whenever it was published; NaN where there is none.
  std::vector<double> estimate;
  /// The standard deviation that the estimator itself claims for each estimate; nothing: it claims none.
  std::optional<std::vector<double>> std;
  std::optional<SeamPattern> seams;
  /// Whether its own model says, when a sample comes in, that it does not explain what comes; nothing: it has no model.
  std::optional<std::vector<bool>> misfit;
  /// Whether it says that a sensor's own low-pass hides the noise, which it does not know.
  std::optional<std::vector<bool>> hidden_noise;
  /// The noise's standard deviation as the model has it in the end, in parts of what is believed, where it says that that is wrong; else 1.
  double noise_ratio = 1.0;
};

/// An estimator that can be run on any record: guards run it on records with a swing added, turns on records of their own.
struct Method {
  std::string name;
  std::size_t lag_samples = 0;
  /// @param noisy finite  @return estimates of every sample of it
  std::function<Contender(std::span<const double> noisy)> run;
};

}  // namespace gyrod::core
