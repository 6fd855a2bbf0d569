#include "stream/paper_method.hpp"

namespace gyrod::stream {
namespace {

class PaperMethod final : public WindowMethod {
 public:
  PaperMethod(std::size_t window_samples, const core::DenoiserOptions& options)
      : denoiser_(window_samples, options) {}

  [[nodiscard]] std::size_t min_samples() const noexcept override { return core::Denoiser::kMinSamples; }

  void denoise(std::span<const double> window, std::span<double> out,
               core::WindowReport& report) noexcept override {
    denoiser_.denoise(window, out, report);
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
