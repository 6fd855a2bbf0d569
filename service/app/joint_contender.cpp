#include "app/joint_contender.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/denoise/window_report.hpp"
#include "core/joint/noise_tracker.hpp"
#include "core/joint/start_noise.hpp"
#include "stream/hop_schedule.hpp"
#include "stream/joint_method.hpp"
#include "stream/others_noise.hpp"

namespace gyrod::app {
namespace {

using Axes = std::array<std::span<const double>, stream::kAxes>;

/// A filter, and what it answers: estimates and claimed deviations, each at the sample that it is of.
class Answering {
 public:
  Answering(const JointAnswer& answer, std::size_t samples, std::unique_ptr<stream::SampleFilter> with)
      : filter(std::move(with)), lag_(answer.realtime ? 0 : answer.lag_samples), realtime_(answer.realtime) {
    contender.name = realtime_ ? "realtime" : "joint";
    contender.lag_samples = lag_;
    contender.estimate.assign(samples, std::numeric_limits<double>::quiet_NaN());
    contender.std.emplace(samples, std::numeric_limits<double>::quiet_NaN());
    contender.misfit.emplace(samples, false);
    contender.hidden_noise.emplace(samples, false);
  }

  void step(std::size_t t, double sample) {
    const stream::Estimates both = filter->step(sample);
    (*contender.misfit)[t] = filter->model_fit().misfit;
    (*contender.hidden_noise)[t] = filter->model_fit().hidden_noise;
    if (t >= lag_) put(t - lag_, realtime_ ? both.realtime : both.denoised);
  }

  /// Adds what would still come after the last sample.
  void finish(std::size_t hop) {
    contender.seams = core::seams_every(hop, lag_);
    contender.noise_ratio = filter->model_fit().noise_ratio;
    const std::size_t samples = contender.estimate.size();
    for (std::size_t age = 0; age < std::min(lag_, samples); ++age) put(samples - 1 - age, filter->held(age));
  }

  std::unique_ptr<stream::SampleFilter> filter;
  core::Contender contender;

 private:
  void put(std::size_t t, const stream::Estimate& estimate) {
    contender.estimate[t] = estimate.rate;
    (*contender.std)[t] = std::sqrt(estimate.variance);
  }

  std::size_t lag_;
  bool realtime_;
};

/// What the axes have at a sample; what is not measured is 0, as in the daemon.
std::array<double, stream::kAxes> sample_at(const Axes& noisy, std::size_t t) {
  std::array<double, stream::kAxes> sample{};
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    if (!noisy[axis].empty()) sample[axis] = noisy[axis][t];
  }
  return sample;
}

/// The windows of a record, and the models of each: what the stream's intake and its workers do.
class SlowLoop {
 public:
  /// @param run, noisy outlive the loop
  SlowLoop(const JointRun& run, std::size_t axis, const Axes& noisy)
      : run_(run),
        axis_(axis),
        noisy_(noisy),
        factory_(stream::joint_method(run.options, run.max_signal_hz)),
        schedule_({.window = static_cast<stream::Position>(run.window_samples),
                   .hop = static_cast<stream::Position>(run.options.hop_samples),
                   .max_hop = static_cast<stream::Position>(run.options.hop_samples),
                   .lag = 0}) {
    for (auto& model : models_) model = factory_.model(run.window_samples);
    unmeasured_.resize(run.window_samples << run.doublings, 0.0);
    prepare_method();
  }

  /// Makes the model that is used from sample `end` on, if one is. @return null where there is none
  const stream::Model* model_from(std::size_t end) {
    const auto position = static_cast<stream::Position>(end);
    if (end == 0 || !schedule_.due(position)) return nullptr;
    const stream::Model* made = nullptr;
    if (window_ && length() >= method_->min_samples()) made = fit();
    if (schedule_.doublings() < run_.doublings && schedule_.can_double(position)) {
      schedule_.double_windows(position);
      prepare_method();
    }
    window_ = schedule_.take(position);
    return made;
  }

  [[nodiscard]] std::size_t hop() const noexcept { return static_cast<std::size_t>(schedule_.step()); }
  [[nodiscard]] std::unique_ptr<stream::SampleFilter> filter(std::size_t lag_samples) const {
    return factory_.filter(lag_samples);
  }

 private:
  void prepare_method() { method_ = factory_.method(static_cast<std::size_t>(schedule_.window()), hop()); }

  [[nodiscard]] std::size_t length() const noexcept {
    return static_cast<std::size_t>(window_->end - window_->begin);
  }

  [[nodiscard]] stream::WindowInput window_of(std::size_t axis) const {
    const auto begin = static_cast<std::size_t>(window_->begin);
    const core::NoiseModel noise = known_at(run_.noise[axis], static_cast<std::size_t>(window_->end));
    return {.axis = axis,
            .samples = noisy_[axis].empty() ? std::span(unmeasured_).first(length())
                                            : noisy_[axis].subspan(begin, length()),
            .sample_rate_hz = run_.sample_rate_hz,
            .noise_source = core::is_usable(noise) || noise.line_count > 0 ? stream::NoiseSource::kCalibrated
                                                                           : stream::NoiseSource::kNone,
            .noise = noise};
  }

  const stream::Model* fit() {
    std::array<double, stream::kAxes> noise{};
    std::array<stream::WindowInput, stream::kAxes> windows;
    for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
      noise[axis] = models_[axis]->noise_variance();
      windows[axis] = window_of(axis);
    }
    stream::tell_others_noise(windows, noise);
    const bool alone = core::belief_in(windows[axis_].noise) == core::NoiseBelief::kColour;
    if (!alone) method_->compare(windows);
    for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
      if (axis == axis_) {
        method_->fit(windows[axis], *models_[axis], report_);
      } else if (!alone && !noisy_[axis].empty()) {
        method_->follow_noise(windows[axis], *models_[axis]);
      }
    }
    return models_[axis_].get();
  }

  const JointRun& run_;
  std::size_t axis_;
  const Axes& noisy_;
  stream::ModelMethodFactory factory_;
  stream::HopSchedule schedule_;
  std::unique_ptr<stream::ModelMethod> method_;
  std::array<std::unique_ptr<stream::Model>, stream::kAxes> models_;
  std::vector<double> unmeasured_;
  std::optional<stream::WindowJob> window_;  ///< the last one, whose models are still to come
  core::WindowReport report_;
};

}  // namespace

std::vector<core::Contender> joint_contenders(const JointRun& run, std::span<const JointAnswer> answers,
                                              std::size_t axis, const Axes& noisy) {
  const std::size_t samples = noisy[axis].size();
  SlowLoop slow_loop(run, axis, noisy);
  std::vector<Answering> all;
  for (const JointAnswer& answer : answers) {
    all.emplace_back(answer, samples, slow_loop.filter(answer.lag_samples));
    all.back().filter->expect_noise(known_at(run.noise[axis], 1));
  }
  core::StartNoise start_noise;
  bool has_model = false;
  for (std::size_t t = 0; t < samples; ++t) {
    if (const stream::Model* model = slow_loop.model_from(t)) {
      for (const Answering& one : all) one.filter->use(*model);
      has_model = true;
    }
    if (!has_model) {
      start_noise.step(sample_at(noisy, t));
      for (const Answering& one : all) one.filter->bound_noise(start_noise.most(axis));
    }
    for (Answering& one : all) one.step(t, noisy[axis][t]);
  }
  std::vector<core::Contender> contenders;
  for (Answering& one : all) {
    one.finish(slow_loop.hop());
    contenders.push_back(std::move(one.contender));
  }
  return contenders;
}

}  // namespace gyrod::app
