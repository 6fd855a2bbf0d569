/// The seam between the engine and the algorithms. Two kinds of method fit it:
///   - a window method answers a window with denoised samples; the engine releases the part [end-lag-hop,
///   end-lag);
///   - a model method answers a window with a model. A filter runs sample by sample, and a model made from
///   the window that
///     ends at sample n*hop is used from sample (n+1)*hop on, always.
/// Either way the moment of use is fixed by sample number, never by how fast a worker was.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <variant>

#include "core/denoise/window_report.hpp"
#include "stream/sample.hpp"

namespace gyrod::stream {

/// One worker's copy of a window method. Owns its workspace; a call allocates nothing and is a pure function
/// of its input.
class WindowMethod {
 public:
  virtual ~WindowMethod() = default;
  /// Shortest window that can be denoised, samples; a shorter one is passed through by the engine.
  [[nodiscard]] virtual std::size_t min_samples() const noexcept = 0;
  /// Denoises one axis of one window.
  /// @param window min_samples().. window_samples finite values, rad/s
  /// @param out    same size, the denoised window
  virtual void denoise(std::span<const double> window, std::span<double> out,
                       core::WindowReport& report) noexcept = 0;
};

/// What a model method's slow loop hands to its fast loop; sized once, reused from window to window.
class Model {
 public:
  virtual ~Model() = default;
};

/// The fast loop of one axis. A call allocates nothing.
class SampleFilter {
 public:
  virtual ~SampleFilter() = default;
  /// Uses this model from the next sample on. The filter keeps the recent samples that it needs for the
  /// hand-over.
  virtual void use(const Model& model) noexcept = 0;
  /// Takes the sample x[t]; returns the estimate of x[t - lag] given x[..t]. The first `lag` answers are not
  /// used.
  virtual double step(double sample) noexcept = 0;
  /// The estimate of x[t - age] given all samples up to the newest, 0 <= age < lag: what a closing stream
  /// releases.
  [[nodiscard]] virtual double held(std::size_t age) const noexcept = 0;
  /// Forgets everything, as just opened.
  virtual void reset() noexcept = 0;
};

/// One worker's copy of a model method's slow loop.
class ModelMethod {
 public:
  virtual ~ModelMethod() = default;
  [[nodiscard]] virtual std::size_t min_samples() const noexcept = 0;
  /// Fits `model` to one axis of one window.
  virtual void fit(std::span<const double> window, Model& model, core::WindowReport& report) noexcept = 0;
};

/// Makes the parts of a window method.
struct WindowMethodFactory {
  /// One a worker.
  std::function<std::unique_ptr<WindowMethod>(std::size_t window_samples)> method;
};

/// Makes the parts of a model method.
struct ModelMethodFactory {
  /// One a worker.
  std::function<std::unique_ptr<ModelMethod>(std::size_t window_samples)> method;
  /// One an axis of a channel.
  std::function<std::unique_ptr<Model>()> model;
  /// One an axis of a channel.
  std::function<std::unique_ptr<SampleFilter>(std::size_t lag_samples)> filter;
};

using MethodFactory = std::variant<WindowMethodFactory, ModelMethodFactory>;

}  // namespace gyrod::stream
