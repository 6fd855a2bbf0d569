#include "app/noise_sources.hpp"

#include <cstddef>
#include <memory>
#include <utility>

#include "app/noise_state_file.hpp"
#include "files/file_error.hpp"
#include "settings/text_file.hpp"

namespace gyrod::app {
namespace {

/// Entries that are copied while the thread that pushes may wait: 0.2 MB.
constexpr std::size_t kCopiedAtOnce = 64;

std::vector<settings::NoiseCalibration> calibrations_of(const settings::NoiseSettings& settings) {
  const bool wanted = settings.source == settings::NoiseSource::kAuto ||
                      settings.source == settings::NoiseSource::kCalibrated;
  if (!wanted || settings.calibrations.empty()) return {};
  return settings::load_calibrations(settings.calibrations);
}

}  // namespace

NoiseSources::NoiseSources(const settings::NoiseSettings& settings, settings::NoiseStates remembered)
    : source_(settings.source),
      calibrations_(calibrations_of(settings)),
      remembered_(remembered.size()),
      learned_(std::move(remembered)) {}

void NoiseSources::attach_to(stream::EngineOptions& options, bool in_motion) {
  if (source_ == settings::NoiseSource::kImf1) return;
  const double rate_hz = options.sample_rate_hz;
  options.noise = [this, rate_hz](std::string_view sensor) {
    return stream::noise_beforehand(options_of(sensor, rate_hz));
  };
  options.learner = [this, rate_hz, in_motion](std::string_view sensor) {
    return learner_of(sensor, rate_hz, in_motion);
  };
}

stream::StandstillOptions NoiseSources::options_of(std::string_view sensor, double sample_rate_hz) const {
  stream::StandstillOptions options;
  options.sample_rate_hz = sample_rate_hz;
  options.use_learned = source_ != settings::NoiseSource::kCalibrated;
  if (const auto* calibration = calibration_of(sensor))
    options.calibrated = stream::CalibratedNoise{calibration->sample_rate_hz, calibration->models};
  const std::lock_guard lock(mutex_);
  // Also of this run: a sensor that was forgotten and is back.
  if (const auto found = learned_.find(sensor); found != learned_.end() && found->second.rest_seconds > 0.0)
    options.remembered = found->second;
  return options;
}

std::unique_ptr<stream::NoiseLearner> NoiseSources::learner_of(std::string_view sensor, double sample_rate_hz,
                                                               bool in_motion) {
  stream::StandstillOptions options = options_of(sensor, sample_rate_hz);
  options.learns_in_motion = in_motion;
  settings::NoiseStates one;
  one.try_emplace(std::string(sensor));
  // Shared, as what a std::function holds has to be copyable.
  const auto place = std::make_shared<Place>(one.extract(one.begin()));
  options.on_learned = [this, place](const stream::RememberedNoise& state) { keep(*place, state); };
  return std::make_unique<stream::StandstillNoise>(std::move(options));
}

void NoiseSources::keep(Place& place, const stream::RememberedNoise& state) {
  const std::lock_guard lock(mutex_);
  if (place.state == nullptr) place.state = &learned_.insert(std::move(place.entry)).position->second;
  *place.state = state;
  ++revision_;
}

settings::NoiseStates NoiseSources::learned() const {
  settings::NoiseStates all;
  for (bool more = true; more;) {
    const std::lock_guard lock(mutex_);
    auto entry = all.empty() ? learned_.begin() : learned_.upper_bound(all.rbegin()->first);
    for (std::size_t n = 0; n < kCopiedAtOnce && entry != learned_.end(); ++n, ++entry)
      all.emplace_hint(all.end(), *entry);
    more = entry != learned_.end();
  }
  return all;
}

settings::NoiseStates remembered_noise(const settings::NoiseSettings& settings) {
  if (settings.state_file.empty()) return {};
  const settings::TextFile read =
      settings::read_text_file(settings.state_file, NoiseStateFile::kMostMebibytes);
  if (read.missing) return {};
  if (!read.trouble.empty()) throw files::FileError(settings.state_file + ": " + read.trouble);
  return settings::parse_noise_state(settings.state_file, read.text);
}

}  // namespace gyrod::app
