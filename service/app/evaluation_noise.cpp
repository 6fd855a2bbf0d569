#include "app/evaluation_noise.hpp"

#include <algorithm>
#include <utility>

#include "app/angle_units.hpp"
#include "app/calibration_choice.hpp"
#include "app/offline_denoiser.hpp"
#include "app/sensor_axes.hpp"
#include "core/noise/noise_units.hpp"
#include "core/noise/still_noise.hpp"
#include "stream/standstill_noise.hpp"

namespace gyrod::app {
namespace {

using settings::NoiseSource;

RowNoise known_by(NoiseKnownBy by, const core::NoiseModel& model) {
  return {by, known_throughout(model), 0, false};
}

/// As a channel of the daemon has it at that rate, deg/s.
core::NoiseModel calibrated_model(const settings::NoiseCalibration& calibration, const std::string& axis,
                                  double rate_hz) {
  stream::StandstillOptions options;
  options.sample_rate_hz = rate_hz;
  options.calibrated = stream::CalibratedNoise{calibration.sample_rate_hz, calibration.models};
  return core::scaled(stream::noise_beforehand(options).axis[axis_index(axis)], kDegPerRad);
}

}  // namespace

NoiseKnowledge noise_knowledge(const std::string& calibration, const std::string& sensor,
                               const settings::NoiseSettings& settings) {
  if (!calibration.empty())
    return {NoiseSource::kCalibrated, calibration,
            choose_calibration("--calibration", calibration, sensor).calibration};
  NoiseKnowledge known{settings.source, "", std::nullopt};
  const bool wanted = settings.source == NoiseSource::kAuto || settings.source == NoiseSource::kCalibrated;
  if (!wanted || settings.calibrations.empty()) return known;
  const auto calibrations = settings::load_calibrations(settings.calibrations);
  const std::string id = sensor.empty() ? OfflineChoice{}.sensor : sensor;
  if (const auto* found = settings::calibration_for(calibrations, id)) {
    known.calibration_file = settings.calibrations;
    known.calibration = *found;
  }
  return known;
}

RowNoise told_beforehand(const NoiseKnowledge& known, const std::string& axis,
                         const std::vector<std::span<const double>>& spare, double scale, double rate_hz) {
  if (known.calibration) {
    return known_by(NoiseKnownBy::kCalibration,
                    core::scaled(calibrated_model(*known.calibration, axis, rate_hz), scale));
  }
  const bool may_learn = known.source == NoiseSource::kAuto || known.source == NoiseSource::kStandstill;
  const bool may_be_told = known.source == NoiseSource::kAuto || known.source == NoiseSource::kCalibrated;
  const auto model = may_be_told ? core::still_noise(spare) : std::nullopt;
  if (model) return known_by(NoiseKnownBy::kSpareSamples, core::scaled(*model, scale * core::kNoiseMargin));
  RowNoise nothing;
  nothing.learns = may_learn;
  return nothing;
}

void add_learned(NoiseCourse learned, RowNoise& noise) {
  noise.course = std::move(learned);
  const auto tells = [](const KnownNoise& known) { return core::is_usable(known.model); };
  const auto first = std::ranges::find_if(noise.course, tells);
  if (first == noise.course.end()) {
    const auto has_lines = [](const KnownNoise& known) { return known.model.line_count > 0; };
    if (std::ranges::any_of(noise.course, has_lines)) noise.by = NoiseKnownBy::kLines;
    return;
  }
  const bool rested = std::ranges::any_of(
      noise.course, [&](const KnownNoise& known) { return tells(known) && !known.in_motion; });
  noise.by = rested ? NoiseKnownBy::kRest : NoiseKnownBy::kMotion;
  noise.from_sample = first->from_sample;
}

std::vector<std::string> calibration_cautions(const NoiseKnowledge& known,
                                              const std::vector<std::string>& axes, double rate_hz) {
  std::vector<std::string> cautions;
  if (!known.calibration) return cautions;
  const settings::NoiseCalibration& calibration = *known.calibration;
  const std::string note = other_rate_note(calibration, rate_hz);
  if (!note.empty()) cautions.push_back(known.calibration_file + ": " + note + ", as in the daemon");
  for (const std::string& axis : axes) {
    if (core::is_usable(calibration.models[axis_index(axis)])) continue;
    cautions.push_back(known.calibration_file + ": has no axis " + axis.substr(axis.size() - 1) +
                       ", which is given the strongest of the others, as in the daemon");
  }
  return cautions;
}

}  // namespace gyrod::app
