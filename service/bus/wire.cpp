#include "bus/wire.hpp"

#include <cstdint>

namespace gyrod::bus {
namespace {

void to_wire(const core::ImfFigures& figures, gyrod_ImfReport& wire) noexcept {
  wire.imf_class = static_cast<std::uint32_t>(figures.imf_class);
  wire.pcc = figures.pcc;
  wire.acf_variance = figures.acf_variance;
  wire.acf_concentration = figures.acf_concentration;
  wire.mean_period_samples = figures.mean_period_samples;
  wire.energy_rad2ps2 = figures.energy;
  wire.excess = figures.excess;
  wire.noise_excess_low = figures.noise_excess_low;
  wire.noise_excess_high = figures.noise_excess_high;
  wire.noise_probability = figures.noise_probability;
  const auto order = static_cast<std::uint32_t>(figures.model.ar_order);
  // A C struct has no const pointers; a write only reads through them.
  wire.ar_coefficients = {order, order, const_cast<double*>(figures.model.ar_coefficients.data()), false};
}

void to_wire(const core::WindowReport& report, std::span<gyrod_ImfReport> imfs,
             gyrod_AxisReport& wire) noexcept {
  wire.window_samples = static_cast<std::uint32_t>(report.window_samples);
  wire.j = static_cast<std::uint32_t>(report.j);
  wire.k = static_cast<std::uint32_t>(report.k);
  wire.noise_floor_radps = report.noise_floor;
  wire.output_noise_radps = report.output_noise;
  wire.mean_radps = report.mean;
  for (std::size_t i = 0; i < report.imf_count; ++i) to_wire(report.imf[i], imfs[i]);
  const auto imf_count = static_cast<std::uint32_t>(report.imf_count);
  wire.imfs = {imf_count, imf_count, imfs.data(), false};
}

/// The part of a report that model methods fill.
void to_wire(const core::WindowReport& window, const stream::ModelFit& fit, double sample_rate_hz,
             gyrod_AxisReport& wire) noexcept {
  wire.normalised_innovation = fit.normalised_innovation;
  wire.model_misfit = fit.misfit;
  wire.model_fallbacks = fit.fallbacks;
  wire.model_modes = static_cast<std::uint32_t>(window.modes);
  wire.tone_frequency_hz = window.tone_frequency_cycles * sample_rate_hz;
  wire.tone_amplitude_radps = window.tone_amplitude;
}

}  // namespace

void to_wire(const stream::NoiseReport& report, ImfReports& imfs, gyrod_NoiseReport& wire) noexcept {
  wire.model_epoch = report.model_epoch;
  wire.last_sequence_number = report.last_sequence;
  wire.last_stamp_ns = report.last_stamp_ns;
  wire.lag_samples = report.lag_samples;
  wire.hop_samples = report.hop_samples;
  wire.sample_rate_hz = report.sample_rate_hz;
  wire.noise_source = static_cast<std::uint32_t>(report.noise_source);
  wire.flags = report.flags;
  wire.window_time_s = report.window_time_s;
  wire.at_rest = report.at_rest.value_or(false);
  constexpr stream::ModelFit kNoModel{.normalised_innovation = 0.0};
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    to_wire(report.axis[axis], imfs[axis], wire.axis[axis]);
    to_wire(report.axis[axis], report.model_fit ? (*report.model_fit)[axis] : kNoModel, report.sample_rate_hz,
            wire.axis[axis]);
  }
}

void to_wire(const stream::SensorHealth& before, const stream::SensorHealth& now, std::int64_t stamp_ns,
             gyrod_HealthReport& wire) noexcept {
  wire.stamp_ns = stamp_ns;
  wire.state = static_cast<std::uint32_t>(now.state);
  wire.previous_state = static_cast<std::uint32_t>(before.state);
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    wire.axis[axis] = {.state = static_cast<std::uint32_t>(now.axis[axis].state),
                       .previous_state = static_cast<std::uint32_t>(before.axis[axis].state),
                       .value = now.axis[axis].value,
                       .limit = now.axis[axis].limit};
  }
}

}  // namespace gyrod::bus
