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
#include "core/noise/noise_model.hpp"
#include "stream/model_fit.hpp"
#include "stream/sample.hpp"

namespace gyrod::stream {

/// What a method is given of one axis at a hop's end.
struct WindowInput {
  /// Which one, 0..2.
  std::size_t axis = 0;
  /// Finite values, rad/s, oldest first; min_samples() to window_samples of them.
  std::span<const double> samples;
  /// Hz; 0 while unknown.
  double sample_rate_hz = 0.0;
  /// Where `noise` comes from. kNone: the method judges by the window itself, and the report says kImf1.
  NoiseSource noise_source = NoiseSource::kNone;
  /// Of this axis, (rad/s)^2; meaningless for kNone.
  core::NoiseModel noise;
  /// Least variance of the noise that the models of the sensor's other axes have found so far, (rad/s)^2; 0 where none has. Model methods
  /// only.
  double others_noise = 0.0;
};

/// One worker's copy of a window method. Owns its workspace; a call allocates nothing and is a pure function
/// of its input.
class WindowMethod {
 public:
  virtual ~WindowMethod() = default;
  /// Shortest window that can be denoised, samples; a shorter one is passed through by the engine.
  [[nodiscard]] virtual std::size_t min_samples() const noexcept = 0;
  /// Denoises one axis of one window.
  /// @param out    as many as the window's samples: the denoised window
  /// @param report receives the figures, output_noise among them: it is published as every sample's standard
  /// deviation
  virtual void denoise(const WindowInput& window, std::span<double> out,
                       core::WindowReport& report) noexcept = 0;
};

/// What a model method's slow loop hands to its fast loop; sized once, reused from window to window. May remember what earlier windows
/// of the same stream said.
class Model {
 public:
  virtual ~Model() = default;
  /// Forgets every window, as just made: the stream has ended. Allocates nothing. After a gap, the same sensor going on, it is not
  /// called.
  virtual void reset() noexcept = 0;
  /// For windows of so many samples at the most: fits of them allocate nothing. Called while nobody fits. @throws std::bad_alloc
  virtual void make_room(std::size_t window_samples) { static_cast<void>(window_samples); }
  /// Variance of the sensor's own noise as the last window had it, (rad/s)^2; 0 where it does not know.
  [[nodiscard]] virtual double noise_variance() const noexcept { return 0.0; }
};

/// Longest lag of a model method, samples: its filters carry as many past states along.
inline constexpr std::size_t kMaxModelLagSamples = 32;

/// Most samples of a model method that leave together, in one call of Sink: what a longer run of input makes, leaves in parts.
inline constexpr std::size_t kMaxModelReleaseSamples = 64;

/// An estimate of the true rate and of its error's variance.
struct Estimate {
  double rate = 0.0;      ///< rad/s
  double variance = 0.0;  ///< (rad/s)^2; 0 where unknown
};

/// What a filter makes of one sample.
struct Estimates {
  Estimate realtime;  ///< of x[t] given x[..t]
  Estimate denoised;  ///< of x[t - lag] given x[..t]
};

/// The fast loop of one axis. A call allocates nothing, and the answers are a pure function of the calls since reset().
class SampleFilter {
 public:
  virtual ~SampleFilter() = default;
  /// What is known of the axis's own noise, (rad/s)^2, before a stretch's first sample, for the answers until the first model. Holds until it is
  /// called again. @param noise usable, or nothing is known
  virtual void expect_noise(const core::NoiseModel& noise) noexcept { static_cast<void>(noise); }
  /// Most that the axis's noise can be, (rad/s)^2, as far as the sensor's axes together tell, where nothing is known of it. Before step(), until the first
  /// model; infinite where they do not tell.
  virtual void bound_noise(double variance) noexcept { static_cast<void>(variance); }
  /// Uses this model from the next sample on. Must copy what it needs: the slow loop writes into the same object
  /// again while the filter runs. The filter keeps the recent samples that it needs for the hand-over.
  virtual void use(const Model& model) noexcept = 0;
  /// Takes the sample x[t]. Before the first model it answers with an estimate of its own, the sample itself
  /// where it has no better. The first `lag` answers of `denoised` are not used.
  virtual Estimates step(double sample) noexcept = 0;
  /// The estimate of x[t - age] given all samples up to the newest, 0 <= age < lag: what a closing stream
  /// releases.
  [[nodiscard]] virtual Estimate held(std::size_t age) const noexcept = 0;
  /// How well the model explains the samples up to the newest. Asked after every step.
  [[nodiscard]] virtual ModelFit model_fit() const noexcept = 0;
  /// Forgets everything, as just opened, also the counts of model_fit().
  virtual void reset() noexcept = 0;
};

/// One worker's copy of a model method's slow loop. A call allocates nothing and is a pure function of its input, of which compare() and the model
/// as the stream's last window left it is a part: windows of a channel are fitted in their order, by whichever worker.
class ModelMethod {
 public:
  virtual ~ModelMethod() = default;
  [[nodiscard]] virtual std::size_t min_samples() const noexcept = 0;
  /// Looks at the windows of all axes, of one time and length, of which fit() is called next, one after the other.
  virtual void compare(const std::array<WindowInput, kAxes>& axes) noexcept { static_cast<void>(axes); }
  /// Fits `model`, the axis's own, to one axis of one window.
  virtual void fit(const WindowInput& window, Model& model, core::WindowReport& report) noexcept = 0;
  /// Does of that only what Model::noise_variance() needs: for sensors of which one axis alone is asked for.
  virtual void follow_noise(const WindowInput& window, Model& model) noexcept {
    static_cast<void>(window);
    static_cast<void>(model);
  }
};

/// Makes the parts of a window method.
struct WindowMethodFactory {
  /// One a worker.
  std::function<std::unique_ptr<WindowMethod>(std::size_t window_samples)> method;
};

/// Makes the parts of a model method.
struct ModelMethodFactory {
  /// One a worker, and for each window and hop in use.
  std::function<std::unique_ptr<ModelMethod>(std::size_t window_samples, std::size_t hop_samples)> method;
  /// One an axis of a channel, with room for windows of this length.
  std::function<std::unique_ptr<Model>(std::size_t window_samples)> model;
  /// One an axis of a channel.
  std::function<std::unique_ptr<SampleFilter>(std::size_t lag_samples)> filter;
};

using MethodFactory = std::variant<WindowMethodFactory, ModelMethodFactory>;

}  // namespace gyrod::stream
