/// Methods with results that can be written down, for tests of the engine.
#pragma once

#include <atomic>
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
  void denoise(std::span<const double> window, std::span<double> out,
               core::WindowReport& report) noexcept override {
    if (on_window_) on_window_();
    double sum = 0.0;
    for (const double value : window) sum += value;
    report = {};
    report.window_samples = window.size();
    report.mean = sum / static_cast<double>(window.size());
    for (std::size_t n = 0; n < window.size(); ++n) {
      out[n] = window[n] + 1e-3 * static_cast<double>(window.size()) + 1e-6 * report.mean;
    }
  }

 private:
  std::function<void()> on_window_;
};

[[nodiscard]] inline stream::WindowMethodFactory window_marker(std::function<void()> on_window = {}) {
  return {[on_window](std::size_t) { return std::make_unique<WindowMarker>(on_window); }};
}

/// Model method: the model is the last sample of its window; the filter answers x[t - lag] + 1000 * model.
/// With samples that count up, the answer tells which window's model was in use.
struct LastSampleModel final : stream::Model {
  double last = 0.0;
};

class LastSampleFilter final : public stream::SampleFilter {
 public:
  explicit LastSampleFilter(std::size_t lag) : recent_(lag + 1) {}
  void use(const stream::Model& model) noexcept override {
    last_ = static_cast<const LastSampleModel&>(model).last;
  }
  double step(double sample) noexcept override {
    recent_[next_++ % recent_.size()] = sample;
    return answer(recent_.size() - 1);
  }
  [[nodiscard]] double held(std::size_t age) const noexcept override { return answer(age); }
  void reset() noexcept override {
    next_ = 0;
    last_ = 0.0;
  }

 private:
  [[nodiscard]] double answer(std::size_t age) const noexcept {
    return next_ <= age ? 0.0 : recent_[(next_ - 1 - age) % recent_.size()] + 1000.0 * last_;
  }
  std::vector<double> recent_;
  std::size_t next_ = 0;
  double last_ = 0.0;
};

class LastSampleMethod final : public stream::ModelMethod {
 public:
  explicit LastSampleMethod(std::function<void()> on_window) : on_window_(std::move(on_window)) {}
  [[nodiscard]] std::size_t min_samples() const noexcept override { return 1; }
  void fit(std::span<const double> window, stream::Model& model,
           core::WindowReport& report) noexcept override {
    if (on_window_) on_window_();
    report = {};
    report.noise_floor = window.back();
    static_cast<LastSampleModel&>(model).last = window.back();
  }

 private:
  std::function<void()> on_window_;
};

[[nodiscard]] inline stream::ModelMethodFactory last_sample_method(std::function<void()> on_window = {}) {
  return {[on_window](std::size_t) { return std::make_unique<LastSampleMethod>(on_window); },
          [] { return std::make_unique<LastSampleModel>(); },
          [](std::size_t lag) { return std::make_unique<LastSampleFilter>(lag); }};
}

}  // namespace gyrod::testing
