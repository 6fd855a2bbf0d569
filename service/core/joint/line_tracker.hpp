/// Where the line of a sensor's own noise is by now.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/joint/joint_options.hpp"
#include "core/joint/spectral_mode.hpp"
#include "core/noise/noise_model.hpp"

namespace gyrod::core {

/// A frequency and how well it is known, cycles per sample.
struct LinePlace {
  double cycles = 0.0;
  double deviation = 0.0;
};

/// A line of the noise as it is taken for in a window. Power 0 where there is none.
struct NoiseLine {
  double cycles = 0.0;
  double half_width = 0.0;  ///< its own, and what is not known of its frequency; cycles per sample
  double power = 0.0;       ///< variance, in the noise's unit squared
  SpectralMode mode{};      ///< an AR(2) process of that frequency, width and variance

  /// Whether a mode at this frequency may be the rest of it.
  [[nodiscard]] bool reaches(double centre_cycles, const LineOptions& options) const noexcept;
};

/// What a window shows of the noise, at bins 0 .. n/2 of a transform: all in the noise's unit squared.
struct LineEvidence {
  std::span<const double> periodogram;
  std::span<const double> rest;  ///< spectrum of the noise without its lines
  std::span<const double>
      explained;  ///< spectrum of what the fit makes of the rest of the window, wherever it took the lines to be
  double resolution = 0.0;  ///< width of a bin of the window itself, cycles per sample: 1 / samples
  double power = 0.0;       ///< of the line
  double share = 0.0;       ///< how much of a window is new since the last one, 0..1
};

/// Lines of MEMS gyros wander with temperature, by a per cent within seconds and by a tenth within an hour, and hardly change their power. So
/// of kPlaces frequencies within a quarter of where a line is believed to be each has a probability w. At first these fall off within some per cent of that.
/// With every window they spread, by `drift` of the frequency a
/// window, `leak` of them goes back to what it was at first, and Bayes' rule follows with
///   ln L_i = -sum over bins within reach of (ln M + min(I / M, 4)),   M = rest + max(explained, line at place i),
/// to the power of share: windows that overlap say the same again. The larger of the two stands there as the fit has made a mode of a line
/// that it did not know to be there; so what decides is where the window has the line's power. What is far
/// above both is motion, and decides nothing.
/// A plain value; allocates nothing.
/// Source: docs/joint.md, "The noise's lines".
class LineTracker {
 public:
  static constexpr std::size_t kPlaces = 41;
  /// Places reach this far, in parts of the frequency.
  static constexpr double kReach = 0.25;

  /// The line that is believed, of the noise at variance 1; variance 0: none. What is known of where it is stays, but where it has moved by more than a
  /// twentieth it is looked for anew.
  void believe(const SpectralLine& line) noexcept;
  /// Whether it was told of a line there, not more than a twentieth away, before.
  [[nodiscard]] bool knows(const SpectralLine& line) const noexcept;
  /// The line, as far as it is known by now.
  [[nodiscard]] NoiseLine line(const LineOptions& options) const noexcept;
  [[nodiscard]] LinePlace place() const noexcept;
  /// Takes what a window shows. @pre line(options).power > 0; the spans are of one size
  void observe(const LineEvidence& window, const LineOptions& options) noexcept;

 private:
  using Places = std::array<double, kPlaces>;

  [[nodiscard]] double cycles_at(std::size_t place) const noexcept;
  /// Beyond half a cycle there is nothing.
  [[nodiscard]] bool exists(std::size_t place) const noexcept { return cycles_at(place) < 0.5; }
  void look_anew(double cycles) noexcept;
  void spread(double share, const LineOptions& options) noexcept;
  [[nodiscard]] double half_width(double cycles, const LineOptions& options) const noexcept;
  [[nodiscard]] Places log_likelihoods(const LineEvidence& window, const LineOptions& options) const noexcept;

  double power_ = 0.0;
  double half_width_ = 0.0;
  double anchor_ = 0.0;  ///< of the places: where the line was believed to be
  Places prior_{};
  Places weight_{};
};

using LineTrackers = std::array<LineTracker, kMaxNoiseLines>;

/// Tells trackers of the lines that are believed now, line i to tracker i: each line stays with the tracker that knows it, whichever that was; one that is no more
/// may come back.
void believe(std::span<const SpectralLine> lines, LineTrackers& trackers) noexcept;

}  // namespace gyrod::core
