#include "live/fit_watch.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace gyrod::live {
namespace {

using stream::ChannelSnapshot;
using stream::ModelFit;
using stream::NoiseSource;

std::string two_digits(double value) {
  std::array<char, 32> text{};
  const int size = std::snprintf(text.data(), text.size(), "%.2g", value);
  return {text.data(), static_cast<std::size_t>(size)};
}

/// Its samples come and are rates.
bool is_heard(const ChannelSnapshot& sensor) {
  return sensor.state == stream::ChannelState::kActive &&
         (!sensor.health || sensor.health->state <= stream::Health::kNoisy);
}

std::string evidence(const ModelFit& fit) {
  if (fit.wrong_noise) return two_digits(fit.noise_ratio) + " times the noise that is believed";
  if (fit.hidden_noise) return "noise that a low-pass of the sensor's own hides";
  return "a normalised innovation of " + two_digits(fit.normalised_innovation);
}

/// @param wrong_noise of an axis: what is believed of the noise is wrong
/// @param hidden_noise of an axis: nothing is, and it cannot be guessed
std::string_view advice(NoiseSource source, bool wrong_noise, bool hidden_noise) {
  if (hidden_noise) return "let it stand still for two minutes, with the engine off, or calibrate it";
  if (!wrong_noise) return "do not trust its deviations; if that stays while it stands still, calibrate it";
  if (source == NoiseSource::kCalibrated)
    return "calibrate it again, or take the calibration out and let it stand still for a minute";
  return "let it stand still for a minute, with the engine off, or calibrate it";
}

using Axes = std::array<bool, stream::kAxes>;

bool any_of(const Axes& axes) { return std::ranges::count(axes, true) > 0; }

std::string names_of(const Axes& axes) {
  std::string names;
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis)
    if (axes[axis]) names += std::string(names.empty() ? "" : ", ") + stream::kAxisNames[axis];
  return (std::ranges::count(axes, true) == 1 ? "axis " : "axes ") + names;
}

std::string trouble(const ChannelSnapshot& sensor, const Axes& axes) {
  const auto& fit = *sensor.last_report.model_fit;
  std::string seen;
  bool wrong_noise = false;
  bool hidden_noise = false;
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    if (!axes[axis]) continue;
    seen += std::string(seen.empty() ? "" : ", ") + stream::kAxisNames[axis] + " has " + evidence(fit[axis]);
    wrong_noise = wrong_noise || fit[axis].wrong_noise;
    hidden_noise = hidden_noise || fit[axis].hidden_noise;
  }
  const NoiseSource source = sensor.last_report.noise_source;
  return sensor.sensor + " " + names_of(axes) + ": the model has not fitted for a minute (" + seen +
         "; noise source " + std::string(stream::name_of(source)) +
         "): " + std::string(advice(source, wrong_noise, hidden_noise));
}

}  // namespace

void FitWatch::note(double now_s, const ChannelSnapshot& sensor) {
  if (!sensor.last_report.model_fit) return;
  const auto& fit = *sensor.last_report.model_fit;
  auto found = sensors_.find(sensor.sensor);
  if (found == sensors_.end()) {
    if (std::ranges::none_of(fit, &ModelFit::misfit)) return;
    found = sensors_.try_emplace(sensor.sensor).first;
  }
  found->second.round = round_;
  std::array<Axes, 2> news{};
  for (std::size_t axis = 0; axis < stream::kAxes; ++axis) {
    Axis& seen = found->second.axis[axis];
    const bool held = seen.misfit == fit[axis].misfit && seen.misfits == fit[axis].misfits;
    if (!held || !is_heard(sensor)) seen.since_s = now_s;
    seen.misfit = fit[axis].misfit;
    seen.misfits = fit[axis].misfits;
    if (seen.misfit == seen.told || now_s - seen.since_s < kHeldS) continue;
    seen.told = seen.misfit;
    news[seen.told ? 1 : 0][axis] = true;
  }
  if (any_of(news[1])) tell({true, sensor.sensor, trouble(sensor, news[1])});
  if (any_of(news[0]))
    tell({false, sensor.sensor,
          sensor.sensor + " " + names_of(news[0]) + ": the model has fitted again for a minute"});
  if (std::ranges::none_of(found->second.axis, [](const Axis& seen) { return seen.misfit || seen.told; }))
    sensors_.erase(found);
}

void FitWatch::tell(News news) {
  if (told_ == kMostSensors) {
    ++others_[news.trouble ? 1 : 0];
    return;
  }
  ++told_;
  news_.push_back(std::move(news));
}

std::vector<FitWatch::News> FitWatch::end_round(double now_s) {
  std::erase_if(sensors_, [this](const auto& entry) { return entry.second.round != round_; });
  ++round_;
  if (now_s >= next_sum_s_) sum_up(now_s);
  return std::exchange(news_, {});
}

void FitWatch::sum_up(double now_s) {
  const auto [fit_again, misfits] = std::exchange(others_, {});
  const auto more = [](std::size_t sensors) {
    return "The models of " + std::to_string(sensors) + " more sensors ";
  };
  if (misfits > 0) {
    news_.push_back(
        {true, "", more(misfits) + "have not fitted for a minute: gyrod_axis_model_misfit says which"});
  }
  if (fit_again > 0) news_.push_back({false, "", more(fit_again) + "have fitted again for a minute"});
  told_ = 0;
  next_sum_s_ = now_s + kSumS;
}

}  // namespace gyrod::live
