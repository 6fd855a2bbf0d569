/// The fast loop of a model method: one filter an axis, and the hand-over of models by sample number.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "stream/method.hpp"
#include "stream/sample.hpp"

namespace gyrod::stream {

/// Which window a model comes from, and what is known since then.
struct ModelOrigin {
  std::uint64_t segment = 0;  ///< stretch of the channel that the window belongs to
  std::uint64_t epoch = 0;
  NoiseSource noise_source = NoiseSource::kNone;
  std::array<double, kAxes> noise_floor_radps{};
};

/// Runs in the thread that pushes. Allocates nothing after construction.
class FastLoop {
 public:
  FastLoop(const ModelMethodFactory& factory, std::size_t lag_samples) {
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
      filters_[axis] = factory.filter(lag_samples);
      models_[axis] = factory.model();
    }
  }

  /// Takes a sample (or a bridged position); returns the estimates for the position `lag` before it.
  [[nodiscard]] std::array<double, kAxes> step(const std::array<double, kAxes>& rate_radps) noexcept {
    std::array<double, kAxes> estimate{};
    for (std::size_t axis = 0; axis < kAxes; ++axis) estimate[axis] = filters_[axis]->step(rate_radps[axis]);
    return estimate;
  }

  /// Estimates for the position `age` before the newest, 0 <= age < lag.
  [[nodiscard]] std::array<double, kAxes> held(std::size_t age) const noexcept {
    std::array<double, kAxes> estimate{};
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
  }

  /// Of the models in use; epoch 0 where there are none yet.
  [[nodiscard]] const ModelOrigin& origin() const noexcept { return origin_; }

  /// What the slow loop writes into, while it owns the channel.
  [[nodiscard]] Model& model(std::size_t axis) noexcept { return *models_[axis]; }

 private:
  std::array<std::unique_ptr<SampleFilter>, kAxes> filters_;
  std::array<std::unique_ptr<Model>, kAxes> models_;
  ModelOrigin origin_;
};

}  // namespace gyrod::stream
