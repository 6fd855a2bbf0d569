/// The figures of screening and modelling as JSON, the same wherever they are written.
#pragma once

#include <nlohmann/json.hpp>

#include "core/denoise/identification.hpp"
#include "core/denoise/window_report.hpp"

namespace gyrod::app {

/// Family, orders, coefficients, innovation variance in rad^2/s^2, and, where they were tested, the residuals. null without a model.
[[nodiscard]] nlohmann::ordered_json model_json(const core::ModelFigures& model);

/// One object an IMF, the fastest first: class, pcc, ACF figures, mean period, energy in rad^2/s^2, excess, and the model of a mixed one.
[[nodiscard]] nlohmann::ordered_json imfs_json(const core::WindowReport& report);

/// Decision and evidence of an identification: what ACF and PACF say, the best of each family by BIC, Ljung-Box, the paper's bands.
[[nodiscard]] nlohmann::ordered_json identification_json(const core::Identification& identification);

}  // namespace gyrod::app
