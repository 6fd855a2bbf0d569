/// How well a model that filters sample by sample explains what comes in.
#pragma once

#include <cstdint>

namespace gyrod::stream {

/// Of one axis, since its filter was opened or reset. With the innovation nu[t] = z[t] - (the model's prediction of z[t] from
/// z[..t-1]) and S[t] its variance as the model has it, nu^2 / S is 1 on average where the model holds.
struct ModelFit {
  /// Mean of nu^2 / S over about the last second or seconds. 1 where nothing is known.
  double normalised_innovation = 1.0;
  /// The model does not explain the input: the published standard deviation is not to be trusted. Has hysteresis; a function of the samples alone.
  bool misfit = false;
  /// Times `misfit` was entered.
  std::uint64_t misfits = 0;
  /// Parts of a model (of all models used) that could not be made from their window and stayed as they were before.
  std::uint64_t fallbacks = 0;

  /// The noise is not as strong as it is believed to be, and has not been for some time: a calibration is of another sensor, or old. `misfit` with
  /// it.
  bool wrong_noise = false;
  /// Nothing is known of the noise, and it cannot be guessed, for some time: a low-pass of the sensor's own hides it, and next to nothing is taken
  /// off. `misfit` with it.
  bool hidden_noise = false;
  /// Where it is not as strong as believed: its standard deviation, as the models find it, in parts of the believed one; else 1.
  double noise_ratio = 1.0;

  friend bool operator==(const ModelFit&, const ModelFit&) = default;
};

}  // namespace gyrod::stream
