/// The paper's algorithm as a window method of the engine.
#pragma once

#include "core/denoise/denoiser.hpp"
#include "stream/method.hpp"

namespace gyrod::stream {

/// Windowed improved EMD with AR-Kalman filtering of the mixed modes: core::Denoiser on every window. Noise known from a calibration or
/// a standstill takes the place of IMF 1's.
[[nodiscard]] WindowMethodFactory paper_method(const core::DenoiserOptions& options);

}  // namespace gyrod::stream
