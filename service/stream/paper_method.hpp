/// The paper's algorithm as a window method of the engine.
#pragma once

#include "core/denoise/denoiser.hpp"
#include "stream/method.hpp"

namespace gyrod::stream {

/// Windowed improved EMD with AR-Kalman filtering of the mixed modes: core::Denoiser on every window.
[[nodiscard]] WindowMethodFactory paper_method(const core::DenoiserOptions& options);

}  // namespace gyrod::stream
