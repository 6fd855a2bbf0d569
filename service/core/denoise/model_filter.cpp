#include "core/denoise/model_filter.hpp"

#include <algorithm>

namespace gyrod::core {
namespace {

/// A spline is so smooth that its AR model predicts it to 1e-17, which no gain can be computed from, nor believed: the least innovation
/// variance, in parts of the energy.
constexpr double kBelievedInnovation = 1e-7;

ModelFigures figures_of(const Identification& found) noexcept {
  ModelFigures figures;
  figures.family = found.model.family();
  figures.ar_order = found.model.p;
  figures.ma_order = found.model.q;
  figures.ar_coefficients = found.model.a;
  figures.ma_coefficients = found.model.b;
  figures.innovation_variance = found.model.innovation_variance;
  figures.tested = found.residuals.lags > 0;
  figures.adequate = found.residuals.adequate;
  figures.ljung_box_p = found.residuals.p_value;
  return figures;
}

}  // namespace

ModelFilter::ModelFilter(std::size_t max_samples, ModelChoice choice, std::size_t max_ar_order) {
  if (choice == ModelChoice::kAr) {
    ar_fitter_.emplace(max_samples, max_ar_order);
  } else {
    identifier_.emplace(max_samples, IdentificationOptions{.max_ar_order = max_ar_order});
  }
}

ModelFigures ModelFilter::filter(std::span<double> series, const FilterNoise& noise) noexcept {
  return identifier_ ? filter_identified(series, noise) : filter_ar(series, noise);
}

ModelFigures ModelFilter::filter_ar(std::span<double> series, const FilterNoise& noise) noexcept {
  const ArModel model = ar_fitter_->fit(series);
  ModelFigures figures;
  figures.ar_order = model.order;
  figures.ar_coefficients = model.a;
  figures.innovation_variance = model.innovation_variance;
  if (model.order == 0) return figures;
  figures.family = ModelFamily::kAr;
  const double driving =
      std::max(model.innovation_variance * noise.signal_share, kBelievedInnovation * noise.energy);
  figures.used = ar_kalman_.design(model.coefficients(), driving, noise.noise_variance);
  if (figures.used) ar_kalman_.filter(series);
  return figures;
}

ModelFigures ModelFilter::filter_identified(std::span<double> series, const FilterNoise& noise) noexcept {
  identification_ = identifier_->identify(series);
  const ArmaModel& model = identification_.model;
  ModelFigures figures = figures_of(identification_);
  if (figures.family == ModelFamily::kNone) return figures;
  // The slowest modes have an innovation variance that not even extended precision finds a gain for. One that is larger gives a wider
  // filter, which lets more noise through and no signal less.
  constexpr double kRaise = 10.0;
  const double most = std::max(kBelievedInnovation * noise.energy, model.innovation_variance);
  double driving = model.innovation_variance * noise.signal_share;
  while (driving > 0.0 && driving <= most && !figures.used) {
    figures.used = arma_kalman_.design(model, driving, noise.noise_variance);
    driving *= kRaise;
  }
  if (figures.used) arma_kalman_.filter(series);
  return figures;
}

}  // namespace gyrod::core
