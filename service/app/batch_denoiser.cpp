#include "app/batch_denoiser.hpp"

#include <algorithm>
#include <future>
#include <utility>

#include "app/abandonable.hpp"
#include "core/signal/interpolation.hpp"

namespace gyrod::app {
namespace {

/// Rows handed on between two looks: some ten milliseconds.
constexpr std::size_t kRowsBetweenLooks = 4096;

struct Whole {
  std::array<std::vector<double>, stream::kAxes> denoised;
  std::array<core::WindowReport, stream::kAxes> reports;
};

struct Axis {
  std::vector<double> denoised;
  core::WindowReport report;
};

Axis denoise_axis(const std::vector<double>& measured, const core::DenoiserOptions& options) {
  Axis axis{measured, {}};
  if (measured.size() < core::Denoiser::kMinSamples) return axis;
  core::Denoiser(measured.size(), options).denoise(measured, axis.denoised, axis.report);
  return axis;
}

}  // namespace

BatchDenoiser::BatchDenoiser(const settings::Settings& settings, const core::DenoiserOptions& options,
                             RowHandler& handler, DenoiseSummary& summary, std::function<bool()> wanted)
    : options_(options),
      handler_(handler),
      summary_(summary),
      wanted_(std::move(wanted)),
      gate_({.sample_rate_hz = settings.engine.sample_rate_hz,
             .max_rate_radps = settings.engine.max_rate_radps,
             .max_bridged_samples = settings.engine.max_bridged_samples}) {}

void BatchDenoiser::push(files::RecordingRow& row) {
  ++counts_.received;
  const stream::Verdict verdict = gate_.judge(row.sample);
  if (verdict.kind == stream::Verdict::Kind::kRefuse) {
    ++counts_.rejected[static_cast<std::size_t>(verdict.reason)];
    rows_.push_back({std::move(row.text), 0, kRefused});
    return;
  }
  counts_.missing += verdict.missing;
  counts_.gaps += verdict.kind == stream::Verdict::Kind::kGap ? 1U : 0U;
  counts_.restarts += verdict.kind == stream::Verdict::Kind::kRestart ? 1U : 0U;
  if (verdict.kind != stream::Verdict::Kind::kAccept || stretches_.empty()) stretches_.emplace_back();
  append(row.sample, verdict.bridge);
  rows_.push_back({std::move(row.text), stretches_.back().size() - 1, stretches_.size() - 1});
}

/// Adds a sample to the newest stretch, after so many on a straight line.
void BatchDenoiser::append(const stream::Sample& sample, std::uint64_t bridge) {
  Stretch& stretch = stretches_.back();
  if (stretch.size() == 0) bridge = 0;
  counts_.bridged += bridge;
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    std::vector<double>& rates = stretch.measured[axis];
    const double left = bridge > 0 ? rates.back() : 0.0;
    for (std::size_t step = 0; step < bridge; ++step)
      rates.push_back(core::bridge(left, sample.rate_radps[axis], step, bridge));
    rates.push_back(sample.rate_radps[axis]);
  }
}

void BatchDenoiser::finish() {
  for (Stretch& stretch : stretches_) {
    if (!denoise(stretch)) return;
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (i % kRowsBetweenLooks == 0 && !wanted_()) return;
    hand_on(rows_[i]);
  }
  rows_.clear();
}

bool BatchDenoiser::denoise(Stretch& stretch) {
  auto whole = while_wanted(wanted_, [measured = stretch.measured, options = options_] {
    Whole made;
    made.denoised = denoise_whole(measured, options, made.reports);
    return made;
  });
  if (!whole) return false;
  stretch.denoised = std::move(whole->denoised);
  if (stretch.size() < core::Denoiser::kMinSamples) return true;
  stream::NoiseReport report;
  report.sample_rate_hz = gate_.rate_hz();
  report.axis = whole->reports;
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis)
    stretch.output_noise[axis] = report.axis[axis].output_noise;
  ++counts_.windows;
  summary_.add(report);
  return true;
}

void BatchDenoiser::hand_on(Row& row) {
  const std::string text = std::move(row.text);
  if (row.stretch == kRefused) {
    handler_.on_refused(text);
    return;
  }
  const Stretch& stretch = stretches_[row.stretch];
  Rates measured{};
  Rates denoised{};
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    measured[axis] = stretch.measured[axis][row.position];
    denoised[axis] = stretch.denoised[axis][row.position];
  }
  ++counts_.published;
  counts_.passed_through += stretch.size() < core::Denoiser::kMinSamples ? 1U : 0U;
  summary_.add(measured, denoised);
  handler_.on_denoised(text, denoised, stretch.output_noise);
}

std::array<std::vector<double>, stream::kAxes> denoise_whole(
    const std::array<std::vector<double>, stream::kAxes>& rate_radps, const core::DenoiserOptions& options,
    std::array<core::WindowReport, stream::kAxes>& reports) {
  std::array<std::future<Axis>, stream::kAxes> running;
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    running[axis] =
        std::async(std::launch::async, denoise_axis, std::cref(rate_radps[axis]), std::cref(options));
  }
  std::array<std::vector<double>, stream::kAxes> denoised;
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    Axis done = running[axis].get();
    denoised[axis] = std::move(done.denoised);
    reports[axis] = done.report;
  }
  return denoised;
}

}  // namespace gyrod::app
