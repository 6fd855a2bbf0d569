#include "stream/paper_method.hpp"

#include <cassert>
#include <optional>

namespace gyrod::stream {
namespace {

/// Variance of the noise, where it is known from elsewhere, all of it: the noise line is that of white noise, and white noise of as much
/// energy is nearest. The white part alone, half the least density, would make every IMF of a sensor at rest look like signal.
std::optional<double> known_noise(const WindowInput& window) noexcept {
  if (window.noise_source < NoiseSource::kStandstill) return std::nullopt;
  assert(core::is_usable(window.noise));
  return core::noise_variance(window.noise);
}

class PaperMethod final : public WindowMethod {
 public:
  PaperMethod(std::size_t window_samples, const core::DenoiserOptions& options)
      : denoiser_(window_samples, options) {}

  [[nodiscard]] std::size_t min_samples() const noexcept override { return core::Denoiser::kMinSamples; }

  void denoise(const WindowInput& window, std::span<double> out,
               core::WindowReport& report) noexcept override {
    denoiser_.denoise(window.samples, out, report, known_noise(window));
  }

 private:
  core::Denoiser denoiser_;
};

}  // namespace

WindowMethodFactory paper_method(const core::DenoiserOptions& options) {
  return {[options](std::size_t window_samples) {
    return std::make_unique<PaperMethod>(window_samples, options);
  }};
}

}  // namespace gyrod::stream
