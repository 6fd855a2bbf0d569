#include "app/record_denoiser.hpp"

#include <cmath>
#include <string_view>

#include "app/batch_denoiser.hpp"
#include "app/options.hpp"
#include "core/denoise/record_analysis.hpp"
#include "stream/engine.hpp"

namespace gyrod::app {
namespace {

using Rates = std::array<std::vector<double>, stream::kAxes>;

constexpr std::string_view kSensor = "record";

double clock_of_a_record() { return 0.0; }

/// Puts each denoised sample where its number says. What the engine refuses stays as measured.
class Collector final : public stream::Sink {
 public:
  Collector(Rates& rates, EstimateKind estimate) : rates_(rates), estimate_(estimate) {}

 private:
  void on_samples(std::string_view, std::span<const stream::DenoisedSample> samples) noexcept override {
    if (estimate_ == EstimateKind::kDenoised) put(samples);
  }
  void on_realtime(std::string_view, std::span<const stream::DenoisedSample> samples) noexcept override {
    if (estimate_ == EstimateKind::kRealtime) put(samples);
  }
  void on_report(std::string_view, const stream::NoiseReport&) noexcept override {}
  void on_end(std::string_view) noexcept override {}

  void put(std::span<const stream::DenoisedSample> samples) noexcept {
    for (const stream::DenoisedSample& sample : samples) {
      for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
        if (!rates_[axis].empty()) rates_[axis][sample.sequence] = sample.rate_radps[axis];
      }
    }
  }

  Rates& rates_;
  EstimateKind estimate_;
};

Rates windowed(const files::Record& record, const settings::Settings& settings, EstimateKind estimate) {
  Rates rates = record.gyro_radps;
  Collector collector(rates, estimate);
  NoiseSources noise(settings.noise, remembered_noise(settings.noise));
  stream::Engine engine(offline_engine_options(settings, noise), method(settings), collector,
                        clock_of_a_record);
  const double period_ns = 1e9 / record.sample_rate_hz;
  for (std::size_t n = 0; n < record.size(); ++n) {
    stream::Sample sample;
    sample.sequence = n;
    sample.stamp_ns = std::llround(static_cast<double>(n) * period_ns);
    for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
      if (!record.gyro_radps[axis].empty()) sample.rate_radps[axis] = record.gyro_radps[axis][n];
    }
    engine.push(kSensor, {&sample, 1});
  }
  engine.end_of_stream(kSensor);
  return rates;
}

}  // namespace

std::array<std::vector<double>, stream::kAxes> denoise_record(const files::Record& record,
                                                              const settings::Settings& settings,
                                                              core::Scheme scheme, bool whole_record) {
  settings::Settings with_scheme = settings;
  with_scheme.denoise.method = settings::Method::kPaper;
  with_scheme.denoise.scheme = scheme;
  if (!whole_record) return windowed(record, with_scheme, EstimateKind::kDenoised);
  std::array<core::WindowReport, stream::kAxes> reports;
  return denoise_whole(record.gyro_radps, core::whole_record_options(denoiser_options(with_scheme.denoise)),
                       reports);
}

std::array<std::vector<double>, stream::kAxes> estimate_record(const files::Record& record,
                                                               const settings::Settings& settings,
                                                               EstimateKind estimate) {
  settings::Settings with_method = settings;
  with_method.denoise.method = settings::Method::kJoint;
  return windowed(record, with_method, estimate);
}

}  // namespace gyrod::app
