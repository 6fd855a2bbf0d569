/// Noise reports from the publisher to readers.
#include <gyrod.h>
#include <string_view>

#include <gtest/gtest.h>

#include "bus/publisher.hpp"
#include "bus/qos.hpp"
#include "bus/topic_reader.hpp"
#include "unit/bus/bus_test.hpp"

namespace gyrod::bus::test {
namespace {

class NoiseReportTest : public BusTest {};

/// A report with every array full; axis x holds other figures than y.
stream::NoiseReport full_report() {
  stream::NoiseReport report{9, 12345,  -6, 16, 32,  99.5, stream::NoiseSource::kStandstill,
                             5, 0.0015, {}, {}, true};
  report.model_fit.emplace();
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    (*report.model_fit)[axis] = {1.5 + static_cast<double>(axis), axis == 1, 3 + axis, 5 + axis};
    core::WindowReport& window = report.axis[axis];
    const auto base = static_cast<double>(axis + 1);
    window = {.window_samples = 1024,
              .imf_count = core::kMaxImfs,
              .j = 3,
              .k = 6,
              .noise_floor = base * 0.1,
              .output_noise = base * 0.2,
              .mean = base * 0.3,
              .modes = axis + 2,
              .tone_frequency_cycles = base * 0.01,
              .tone_amplitude = base * 0.02,
              .direct_model = {},
              .imf = {}};
    for (std::size_t i = 0; i < core::kMaxImfs; ++i) {
      const double value = base * 100.0 + static_cast<double>(i);
      core::ImfFigures& imf = window.imf[i];
      imf = {static_cast<core::ImfClass>(i % 3),
             value + 0.1,
             value + 0.2,
             value + 0.3,
             value + 0.4,
             value + 0.5,
             value + 0.6,
             value + 0.7,
             value + 0.8,
             value + 0.9,
             {.family = core::ModelFamily::kAr, .ar_order = core::kMaxArOrder}};
      for (std::size_t p = 0; p < core::kMaxArOrder; ++p)
        imf.model.ar_coefficients[p] = value * static_cast<double>(p + 1);
    }
  }
  return report;
}

void expect_same(const gyrod_ImfReport& wire, const core::ImfFigures& imf) {
  EXPECT_EQ(wire.imf_class, static_cast<std::uint32_t>(imf.imf_class));
  EXPECT_EQ(wire.pcc, imf.pcc);
  EXPECT_EQ(wire.acf_variance, imf.acf_variance);
  EXPECT_EQ(wire.acf_concentration, imf.acf_concentration);
  EXPECT_EQ(wire.mean_period_samples, imf.mean_period_samples);
  EXPECT_EQ(wire.energy_rad2ps2, imf.energy);
  EXPECT_EQ(wire.excess, imf.excess);
  EXPECT_EQ(wire.noise_excess_low, imf.noise_excess_low);
  EXPECT_EQ(wire.noise_excess_high, imf.noise_excess_high);
  EXPECT_EQ(wire.noise_probability, imf.noise_probability);
  ASSERT_EQ(wire.ar_coefficients._length, imf.model.ar_order);
  for (std::size_t p = 0; p < imf.model.ar_order; ++p)
    EXPECT_EQ(wire.ar_coefficients._buffer[p], imf.model.ar_coefficients[p]);
}

void expect_same(const gyrod_AxisReport& wire, const core::WindowReport& window) {
  EXPECT_EQ(wire.window_samples, window.window_samples);
  EXPECT_EQ(wire.j, window.j);
  EXPECT_EQ(wire.k, window.k);
  EXPECT_EQ(wire.noise_floor_radps, window.noise_floor);
  EXPECT_EQ(wire.output_noise_radps, window.output_noise);
  EXPECT_EQ(wire.mean_radps, window.mean);
  ASSERT_EQ(wire.imfs._length, window.imf_count);
  for (std::size_t i = 0; i < window.imf_count; ++i) expect_same(wire.imfs._buffer[i], window.imf[i]);
}

void expect_same(const gyrod_NoiseReport& wire, const stream::NoiseReport& report) {
  EXPECT_EQ(wire.model_epoch, report.model_epoch);
  EXPECT_EQ(wire.last_sequence_number, report.last_sequence);
  EXPECT_EQ(wire.last_stamp_ns, report.last_stamp_ns);
  EXPECT_EQ(wire.lag_samples, report.lag_samples);
  EXPECT_EQ(wire.hop_samples, report.hop_samples);
  EXPECT_EQ(wire.sample_rate_hz, report.sample_rate_hz);
  EXPECT_EQ(wire.noise_source, static_cast<std::uint32_t>(report.noise_source));
  EXPECT_EQ(wire.flags, report.flags);
  EXPECT_EQ(wire.window_time_s, report.window_time_s);
  EXPECT_EQ(wire.at_rest, report.at_rest.value_or(false));
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    expect_same(wire.axis[axis], report.axis[axis]);
    const core::WindowReport& window = report.axis[axis];
    const stream::ModelFit fit = report.model_fit ? (*report.model_fit)[axis] : stream::ModelFit{0.0};
    EXPECT_EQ(wire.axis[axis].normalised_innovation, fit.normalised_innovation);
    EXPECT_EQ(wire.axis[axis].model_misfit, fit.misfit);
    EXPECT_EQ(wire.axis[axis].model_fallbacks, fit.fallbacks);
    EXPECT_EQ(wire.axis[axis].model_modes, window.modes);
    EXPECT_EQ(wire.axis[axis].tone_frequency_hz, window.tone_frequency_cycles * report.sample_rate_hz);
    EXPECT_EQ(wire.axis[axis].tone_amplitude_radps, window.tone_amplitude);
  }
}

TEST_P(NoiseReportTest, AFullAndAnEmptyReportSurviveAndTheLastOneServesALateReader) {
  Publisher publisher(writer_domain(), options_);
  const stream::NoiseReport empty{};
  publisher.publish_report("overwritten", empty);
  publisher.publish_report("overwritten", full_report());
  publisher.publish_report("empty", empty);

  Qos qos;
  qos.reliable(0).keep_all().with_the_past();
  const Domain domain = reader_domain();
  const TopicReader<gyrod_NoiseReport> reader(domain.participant(), options_.topics.noise, qos);
  std::size_t full_ones = 0;
  std::size_t empty_ones = 0;
  wait_until([&] {
    reader.take([&](const gyrod_NoiseReport& wire, const dds_sample_info_t&) {
      const bool is_empty = std::string_view(wire.sensor) == "empty";
      expect_same(wire, is_empty ? empty : full_report());
      ++(is_empty ? empty_ones : full_ones);
    });
    return empty_ones + full_ones == 2;
  });
  EXPECT_EQ(full_ones, 1U);
  EXPECT_EQ(empty_ones, 1U);
}

INSTANTIATE_TEST_SUITE_P(Bus, NoiseReportTest, testing::Values(Route::kInProcess, Route::kUdp), route_name);

}  // namespace
}  // namespace gyrod::bus::test
