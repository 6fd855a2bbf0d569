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

double clock_that_stands_still() { return 0.0; }

/// Puts each denoised sample where its number says. What the engine refuses stays as measured.
class Collector final : public stream::Sink {
 public:
  explicit Collector(Rates& rates) : rates_(rates) {}

 private:
  void on_samples(std::string_view, std::span<const stream::DenoisedSample> samples) noexcept override {
    for (const stream::DenoisedSample& sample : samples) {
      for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
        if (!rates_[axis].empty()) rates_[axis][sample.sequence] = sample.rate_radps[axis];
      }
    }
  }
  void on_report(std::string_view, const stream::NoiseReport&) noexcept override {}
  void on_end(std::string_view) noexcept override {}

  Rates& rates_;
};

Rates windowed(const files::Record& record, const settings::Settings& settings) {
  Rates rates = record.gyro_radps;
  Collector collector(rates);
  stream::Engine engine(offline_engine_options(settings), method(settings), collector,
                        clock_that_stands_still);
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
  with_scheme.denoise.scheme = scheme;
  if (!whole_record) return windowed(record, with_scheme);
  std::array<core::WindowReport, stream::kAxes> reports;
  return denoise_whole(record.gyro_radps, core::whole_record_options(denoiser_options(with_scheme.denoise)),
                       reports);
}

}  // namespace gyrod::app
