/// Shorthands of the denoiser tests.
#pragma once

#include <span>

#include "core/denoise/denoiser.hpp"
#include "support/signals.hpp"

namespace gyrod::testing {

struct Denoised {
  Signal out;
  core::WindowReport report;
};

inline Denoised denoise(std::span<const double> window, const core::DenoiserOptions& options = {}) {
  Denoised result{Signal(window.size()), {}};
  core::Denoiser(window.size(), options).denoise(window, result.out, result.report);
  return result;
}

inline core::DenoiserOptions with_rule(core::ScreeningRule rule) {
  core::DenoiserOptions options;
  options.screening.rule = rule;
  return options;
}

}  // namespace gyrod::testing
