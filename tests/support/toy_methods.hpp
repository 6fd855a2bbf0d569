/// Methods with results that can be written down, for tests of the engine.
#pragma once

#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "stream/method.hpp"

namespace gyrod::testing {

/// Window method: every sample becomes itself plus the window's length and mean, so that the result tells
/// which window made it. `on_window` runs first, in the worker: tests block or count there.
class WindowMarker final : public stream::WindowMethod {
 public:
  explicit WindowMarker(std::function<void()> on_window) : on_window_(std::move(on_window)) {}
  [[nodiscard]] std::size_t min_samples() const noexcept override { return 16; }
  void denoise(const stream::WindowInput& window, std::span<double> out,
               core::WindowReport& report) noexcept override {
    if (on_window_) on_window_();
    double sum = 0.0;
    for (const double value : window.samples) sum += value;
    const auto size = static_cast<double>(window.samples.size());
    report = {};
    report.window_samples = window.samples.size();
    report.tone_amplitude = window.samples.front();
    report.mean = sum / size;
    report.noise_floor = std::sqrt(window.noise.white_variance);
    report.output_noise = 0.5 * size;
    for (std::size_t n = 0; n < out.size(); ++n)
      out[n] = window.samples[n] + 1e-3 * size + 1e-6 * report.mean;
  }

 private:
  std::function<void()> on_window_;
};

[[nodiscard]] inline stream::WindowMethodFactory window_marker(std::function<void()> on_window = {}) {
  return {[on_window](std::size_t) { return std::make_unique<WindowMarker>(on_window); }};
}

/// Model method: the model is the last sample of its window; the filter answers x[t - lag] + 1000 * model, and in real time
/// x[t] + 1000 * model, with the model's square plus one as variance. With samples that count up, the answer tells which window's model
/// was in use. A rate below kMisfit does not fit the model. The report's modes count the windows that the model remembers,
/// its mean is what the other axes' models say of the noise: their last samples.
inline constexpr double kMisfit = -1e5;

struct LastSampleModel final : stream::Model {
  void reset() noexcept override { *this = {}; }
  [[nodiscard]] double noise_variance() const noexcept override { return last; }
  double last = 0.0;
  std::size_t windows = 0;  ///< fitted since it was made or reset
};

class LastSampleFilter final : public stream::SampleFilter {
 public:
  explicit LastSampleFilter(std::size_t lag) : recent_(lag + 1) {}
  void use(const stream::Model& model) noexcept override {
    last_ = static_cast<const LastSampleModel&>(model).last;
  }
  stream::Estimates step(double sample) noexcept override {
    recent_[next_++ % recent_.size()] = sample;
    const bool misfit = sample < kMisfit;
    fit_.misfits += misfit && !fit_.misfit ? 1U : 0U;
    fit_.misfit = misfit;
    fit_.normalised_innovation = misfit ? 9.0 : 1.0;
    return {answer(0), answer(recent_.size() - 1)};
  }
  [[nodiscard]] stream::Estimate held(std::size_t age) const noexcept override { return answer(age); }
  [[nodiscard]] stream::ModelFit model_fit() const noexcept override { return fit_; }
  void reset() noexcept override {
    next_ = 0;
    last_ = 0.0;
    fit_ = {};
  }

 private:
  [[nodiscard]] stream::Estimate answer(std::size_t age) const noexcept {
    if (next_ <= age) return {};
    return {recent_[(next_ - 1 - age) % recent_.size()] + 1000.0 * last_, last_ * last_ + 1.0};
  }
  std::vector<double> recent_;
  std::size_t next_ = 0;
  double last_ = 0.0;
  stream::ModelFit fit_;
};

class LastSampleMethod final : public stream::ModelMethod {
 public:
  explicit LastSampleMethod(std::function<void()> on_window) : on_window_(std::move(on_window)) {}
  [[nodiscard]] std::size_t min_samples() const noexcept override { return 1; }
  void fit(const stream::WindowInput& window, stream::Model& model,
           core::WindowReport& report) noexcept override {
    if (on_window_) on_window_();
    report = {};
    report.noise_floor = window.samples.back();
    report.window_samples = window.samples.size();
    report.tone_amplitude = window.samples.front();
    auto& state = static_cast<LastSampleModel&>(model);
    state.last = window.samples.back();
    report.modes = ++state.windows;
    report.mean = window.others_noise;
  }

 private:
  std::function<void()> on_window_;
};

[[nodiscard]] inline stream::ModelMethodFactory last_sample_method(std::function<void()> on_window = {}) {
  return {[on_window](std::size_t, std::size_t) { return std::make_unique<LastSampleMethod>(on_window); },
          [](std::size_t) { return std::make_unique<LastSampleModel>(); },
          [](std::size_t lag) { return std::make_unique<LastSampleFilter>(lag); }};
}

}  // namespace gyrod::testing
