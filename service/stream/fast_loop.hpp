/// The fast loop of a model method: one filter an axis, and the hand-over of models by sample number.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "core/joint/start_noise.hpp"
#include "stream/method.hpp"
#include "stream/noise_learner.hpp"
#include "stream/sample.hpp"
#include "stream/sample_ring.hpp"

namespace gyrod::stream {

/// Which window a model comes from, and what is known since then.
struct ModelOrigin {
  std::uint64_t segment = 0;  ///< stretch of the channel that the window belongs to
  Position window_end = 0;    ///< of the window
  std::uint64_t epoch = 0;
  NoiseSource noise_source = NoiseSource::kNone;
  std::array<double, kAxes> noise_floor_radps{};
};

/// Runs in the thread that pushes. Allocates nothing after construction but in make_room().
class FastLoop {
 public:
  FastLoop(const ModelMethodFactory& factory, std::size_t window_samples, std::size_t lag_samples) {
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      filters_[axis] = factory.filter(lag_samples);
      models_[axis] = factory.model(window_samples);
    }
  }

  /// What the filters make of the newest position.
  struct Answer {
    std::array<Estimate, kAxes> realtime;  ///< for this position
    std::array<Estimate, kAxes> denoised;  ///< for the position `lag` before it
  };

  /// What is known of the noise before a stretch's first sample.
  void expect_noise(const ChannelNoise& noise) noexcept {
    const bool known = noise.source != NoiseSource::kNone;
    for (std::size_t axis = 0; axis < kAxes; ++axis)
      filters_[axis]->expect_noise(known ? noise.axis[axis] : core::NoiseModel{});
  }

  /// Takes a sample (or a bridged position).
  [[nodiscard]] Answer step(const std::array<double, kAxes>& rate_radps) noexcept {
    Answer answer;
    misfit_ = false;
    if (origin_.epoch == 0) bound_noise(rate_radps);
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      const Estimates estimates = filters_[axis]->step(rate_radps[axis]);
      answer.realtime[axis] = estimates.realtime;
      answer.denoised[axis] = estimates.denoised;
      claimed_[axis] += estimates.denoised.variance;
      model_fit_[axis] = filters_[axis]->model_fit();
      misfit_ = misfit_ || model_fit_[axis].misfit;
    }
    ++steps_;
    return answer;
  }

  /// Estimates for the position `age` before the newest, 0 <= age < lag.
  [[nodiscard]] std::array<Estimate, kAxes> held(std::size_t age) const noexcept {
    std::array<Estimate, kAxes> estimate{};
    for (std::size_t axis = 0; axis < kAxes; ++axis) estimate[axis] = filters_[axis]->held(age);
    return estimate;
  }

  /// Uses the models that the slow loop has made. @pre no slow loop is writing them
  void adopt(const ModelOrigin& origin) noexcept {
    for (std::size_t axis = 0; axis < kAxes; ++axis) filters_[axis]->use(*models_[axis]);
    origin_ = origin;
  }

  /// Forgets samples and models.
  void reset() noexcept {
    for (auto& filter : filters_) filter->reset();
    origin_ = {};
    start_noise_.reset();
    model_fit_ = {};
    claimed_ = {};
    steps_ = 0;
    misfit_ = false;
    misfits_told_ = 0;
  }

  /// As of the last step(), x, y, z.
  [[nodiscard]] const std::array<ModelFit, kAxes>& model_fit() const noexcept { return model_fit_; }
  /// The model of an axis does not explain the input.
  [[nodiscard]] bool misfit() const noexcept { return misfit_; }
  /// Times that began, over all axes, since the last call.
  [[nodiscard]] std::uint64_t take_new_misfits() noexcept {
    std::uint64_t misfits = 0;
    for (const ModelFit& fit : model_fit_) misfits += fit.misfits;
    return misfits - std::exchange(misfits_told_, misfits);
  }

  /// Mean variance of the denoised estimates, (rad/s)^2, since the last call; 0 where there was no step.
  [[nodiscard]] std::array<double, kAxes> take_mean_variance() noexcept {
    std::array<double, kAxes> mean{};
    for (std::size_t axis = 0; axis < kAxes && steps_ > 0; ++axis)
      mean[axis] = std::min(claimed_[axis] / static_cast<double>(steps_), std::numeric_limits<double>::max());
    claimed_ = {};
    steps_ = 0;
    return mean;
  }

  /// Of the models in use; epoch 0 where there are none yet.
  [[nodiscard]] const ModelOrigin& origin() const noexcept { return origin_; }

  /// What the slow loop writes into, while it owns the channel.
  [[nodiscard]] Model& model(std::size_t axis) noexcept { return *models_[axis]; }
  /// For longer windows. @pre no slow loop is writing the models @throws std::bad_alloc
  void make_room(std::size_t window_samples) {
    for (auto& model : models_) model->make_room(window_samples);
  }
  /// The stream has ended. @pre the caller owns the channel
  void reset_models() noexcept {
    for (auto& model : models_) model->reset();
  }

 private:
  /// Nothing is known yet but what the first samples tell.
  void bound_noise(const std::array<double, kAxes>& rate_radps) noexcept {
    start_noise_.step(rate_radps);
    for (std::size_t axis = 0; axis < kAxes; ++axis) filters_[axis]->bound_noise(start_noise_.most(axis));
  }

  std::array<std::unique_ptr<SampleFilter>, kAxes> filters_;
  std::array<std::unique_ptr<Model>, kAxes> models_;
  ModelOrigin origin_;
  core::StartNoise start_noise_;  ///< until there is one
  std::array<ModelFit, kAxes> model_fit_;
  std::array<double, kAxes> claimed_{};  ///< sum of variances, over steps_
  std::uint64_t steps_ = 0;
  bool misfit_ = false;
  std::uint64_t misfits_told_ = 0;
};

}  // namespace gyrod::stream
