#include "stream/workbench.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "stream/others_noise.hpp"

namespace gyrod::stream {
namespace {

/// One axis of the window, in `room`.
WindowInput input(std::span<double> room, const Channel& channel, const WindowJob& job,
                  std::size_t axis) noexcept {
  const std::span<double> samples = room.first(static_cast<std::size_t>(job.end - job.begin));
  channel.ring.copy(axis, job.begin, samples);
  return {.axis = axis,
          .samples = samples,
          .sample_rate_hz = job.sample_rate_hz,
          .noise_source = job.noise.source,
          .noise = job.noise.axis[axis]};
}

}  // namespace

Workbench::Workbench(const EngineOptions& options, const MethodFactory& factory)
    : window_samples_(options.window_samples),
      hop_samples_(options.hop_samples),
      models_(std::get_if<ModelMethodFactory>(&factory)) {
  if (models_ != nullptr) {
    make_room(0);
  } else {
    window_method_ = std::get<WindowMethodFactory>(factory).method(window_samples_);
    window_.resize(window_samples_);
    denoised_.resize(window_samples_);
    samples_.reserve(window_samples_);
  }
}

void Workbench::make_room(unsigned doublings) {
  ModelTool& tool = tools_.at(doublings);
  if (models_ == nullptr || tool.method != nullptr) return;
  const std::size_t window = window_samples_ << doublings;
  ModelTool made{models_->method(window, hop_samples_ << hop_doublings(doublings)),
                 std::vector<double>(kAxes * window)};
  tool = std::move(made);
}

void Workbench::work(Channel& channel, const WindowJob& job, bool pass_through) noexcept {
  const auto length = static_cast<std::size_t>(job.end - job.begin);
  has_report_ = !pass_through && length >= min_samples();
  samples_.clear();
  if (window_method_ != nullptr) {
    collect(channel, job);
    if (has_report_) {
      denoise(channel, job);
    } else {
      for (auto& sample : samples_) sample.flags |= static_cast<std::uint32_t>(SampleFlag::kPassThrough);
    }
  } else if (has_report_) {
    fit(tools_[job.doublings], channel, job);
  }
  if (has_report_) describe(channel, job);
  if (job.ends_stream && channel.fast_loop) channel.fast_loop->reset_models();
}

/// The measured samples of the part to be released, as they came.
void Workbench::collect(const Channel& channel, const WindowJob& job) noexcept {
  for (Position position = job.release_begin; position < job.release_end; ++position) {
    if (!channel.ring.released(position)) continue;
    const Sample sample = channel.ring.at(position);
    samples_.push_back({.sequence = sample.sequence,
                        .stamp_ns = sample.stamp_ns,
                        .rate_radps = sample.rate_radps,
                        .flags = job.flags});
  }
}

void Workbench::denoise(Channel& channel, const WindowJob& job) noexcept {
  const std::span<double> denoised{denoised_.data(), static_cast<std::size_t>(job.end - job.begin)};
  for (std::size_t axis = 0; axis < kAxes; ++axis) {
    window_method_->denoise(input(window_, channel, job, axis), denoised, report_.axis[axis]);
    channel.splice->join(job, axis, denoised);
    std::size_t index = 0;
    for (Position position = job.release_begin; position < job.release_end; ++position) {
      if (!channel.ring.released(position)) continue;
      samples_[index].rate_radps[axis] = denoised[static_cast<std::size_t>(position - job.begin)];
      samples_[index].rate_std_radps[axis] = report_.axis[axis].output_noise;
      samples_[index].noise_floor_radps[axis] = report_.axis[axis].noise_floor;
      ++index;
    }
  }
}

void Workbench::fit(ModelTool& tool, Channel& channel, const WindowJob& job) noexcept {
  // As they were before this window: the answers do not depend on the order of the axes.
  std::array<double, kAxes> noise{};
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    noise[axis] = channel.fast_loop->model(axis).noise_variance();
  std::array<WindowInput, kAxes> windows;
  const std::size_t room = tool.window.size() / kAxes;
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    windows[axis] = input(std::span(tool.window).subspan(axis * room, room), channel, job, axis);
  tell_others_noise(windows, noise);
  tool.method->compare(windows);
  for (std::size_t axis = 0; axis < kAxes; ++axis)
    tool.method->fit(windows[axis], channel.fast_loop->model(axis), report_.axis[axis]);
}

/// The report's frame around the axes' figures, and the epoch of the samples.
void Workbench::describe(Channel& channel, const WindowJob& job) noexcept {
  const Sample newest = channel.ring.at(job.end - 1);
  report_.model_epoch = channel.next_epoch();
  report_.last_sequence = newest.sequence;
  report_.last_stamp_ns = newest.stamp_ns;
  report_.lag_samples = static_cast<std::uint32_t>(job.end - job.release_end);
  report_.hop_samples = job.hop_samples;
  report_.sample_rate_hz = job.sample_rate_hz;
  report_.noise_source = job.noise.source == NoiseSource::kNone ? NoiseSource::kImf1 : job.noise.source;
  report_.model_fit = job.model_fit;
  report_.at_rest = job.at_rest;
  report_.flags = job.flags;
  for (std::size_t axis = 0; job.output_variance && axis < kAxes; ++axis)
    report_.axis[axis].output_noise = std::sqrt((*job.output_variance)[axis]);
  for (auto& sample : samples_) {
    sample.model_epoch = report_.model_epoch;
    sample.noise_source = report_.noise_source;
  }
}

std::size_t Workbench::min_samples() const noexcept {
  return window_method_ != nullptr ? window_method_->min_samples() : tools_[0].method->min_samples();
}

void Workbench::count_times(double window_time_s, double added_latency_s) {
  const std::lock_guard lock(times_mutex_);
  window_time_.add(window_time_s);
  added_latency_.add(added_latency_s);
}

void Workbench::add_times_to(EngineSnapshot& snapshot) const {
  const std::lock_guard lock(times_mutex_);
  snapshot.window_time += window_time_;
  snapshot.added_latency += added_latency_;
}

}  // namespace gyrod::stream
