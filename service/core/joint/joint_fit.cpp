#include "core/joint/joint_fit.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/denoise/noise_line.hpp"
#include "core/signal/moments.hpp"
#include "core/signal/notch.hpp"

namespace gyrod::core {
namespace {

/// A level below this is that of another noise than the one that was measured.
constexpr double kOtherNoise = 0.5;

}  // namespace

JointFit::JointFit(std::size_t max_samples, const JointOptions& options)
    : options_(options),
      max_samples_(max_samples),
      emd_(max_samples, options.emd),
      tapers_(max_samples, options.tapers, options.recency),
      pruned_tapers_(max_samples, options.tapers, options.pruned_recency),
      whittle_(tapers_.transform_samples(), options.bandwidth_cycles),
      knocks_(max_samples),
      significance_(ScreeningOptions{}.false_alarm_rate),
      line_holds_(noise_line_holds(options.emd)),
      centred_(max_samples),
      imf_(max_samples),
      slow_(max_samples),
      periodogram_(tapers_.bins()),
      pruned_periodogram_(tapers_.bins()),
      whitened_(tapers_.bins()) {
  if (static_cast<std::size_t>(options.emd.max_imfs) > kMaxImfs) {
    throw std::invalid_argument("IMF limit is " + std::to_string(options.emd.max_imfs) +
                                ", expected at most " + std::to_string(kMaxImfs));
  }
  set_sample_rate(0.0);
}

void JointFit::set_sample_rate(double sample_rate_hz) noexcept {
  scale_ = JointScale(sample_rate_hz, max_samples_);
  tapers_.set_recency(scale_.recency(options_.recency));
  pruned_tapers_.set_recency(scale_.recency(options_.pruned_recency));
  whittle_.set_shrinkage(scale_.shrinkage(options_.shrinkage));
}

/// Mean, spectrum and noise of a window. @return false where it does not vary
bool JointFit::look_at(std::span<const double> window, const NoiseModel& noise, JointModel& model,
                       WindowReport& report) noexcept {
  assert(window.size() >= kMinSamples && window.size() <= max_samples_);
  report = {};
  report.window_samples = window.size();
  report.mean = mean(window);
  centred_.resize(window.size());
  for (std::size_t n = 0; n < window.size(); ++n) centred_[n] = window[n] - report.mean;
  if (std::ranges::all_of(centred_, [](double value) { return value == 0.0; })) return false;
  knocks_.apply(centred_, options_);
  tapers_.prewhitened_spectrum(centred_, periodogram_);
  judge_noise(noise, model, report);
  return true;
}

void JointFit::follow_noise(std::span<const double> window, const NoiseModel& noise,
                            JointModel& model) noexcept {
  WindowReport report;
  if (look_at(window, noise, model, report) && is_usable(noise_)) model.noise_variance = seen_noise();
}

void JointFit::fit(std::span<const double> window, const NoiseModel& noise, JointModel& model,
                   WindowReport& report) noexcept {
  model.fallbacks = 0;
  if (!look_at(window, noise, model, report)) return;
  pruned_tapers_.prewhitened_spectrum(centred_, pruned_periodogram_);
  const Tone tone = find_motion_tone();
  if (tone.prominence >= kSureTone) {
    report.tone_frequency_cycles = tone.frequency_cycles;
    report.tone_amplitude = tone.amplitude * std::sqrt(unit_);
  }
  if (!is_usable(noise_)) return;
  for (const NoiseLine& line : lines()) notch(centred_, line.cycles, line.half_width);
  decompose(report);
  start_tone(tone);
  fit_modes(model.lasting);
  follow_lines(model.lines, window.size());
  model.mean = report.mean;
  model.scale = scale_;
  model.full_prior = prior_of_full();
  design(model);
  report.modes = static_cast<std::size_t>(std::ranges::count(full_.modes(), false, &SpectralMode::slow));
}

/// What the noise is taken for: as believed, its level corrected by what the windows so far have shown, and its lines where they have shown
/// them. Where no colour is believed, or nothing is but lines, what the bands show; at most what the other axes allow.
void JointFit::judge_noise(const NoiseModel& believed, JointModel& model, WindowReport& report) noexcept {
  const NoiseBelief belief = belief_in(believed);
  const bool known = belief != NoiseBelief::kNothing;
  unit_ = known ? noise_variance(believed) : 1.0;
  noise_ = known ? scaled(believed, 1.0 / std::sqrt(unit_)) : white_noise(1.0);
  take_lines(model.lines, known ? noise_.lines() : believed.lines());
  for (double& power : periodogram_) power /= unit_;
  whittle_.observe(periodogram_, noise_);
  model.noise.observe(periodogram_, whittle_.noise(), known ? believed : NoiseModel{}, new_share(),
                      scale_.forgetting(new_share()), own_,
                      static_cast<double>(centred_.size()) / static_cast<double>(max_samples_));
  const NoiseShape& shape = model.noise.shape();
  if (belief == NoiseBelief::kColour) {
    noise_ = scaled(without_lines(noise_), std::sqrt(shape.level));
    // Quieter windows do not make a line weaker than it is believed to be, unless by far: it may be all that is as loud as ever.
    const double line_level = shape.level < kOtherNoise ? shape.level : std::max(shape.level, 1.0);
    scale_lines(line_level);
  } else if (known) {
    noise_ = noise_of(shape);
  } else {
    unit_ = std::min(shape.level, most_noise_);
    noise_ = is_usable(white_noise(unit_)) ? noise_of({.level = 1.0, .tilt = shape.tilt}) : NoiseModel{};
    if (is_usable(noise_)) {
      for (double& power : periodogram_) power /= unit_;
      scale_lines(1.0 / unit_);
    } else {
      line_count_ = 0;
    }
  }
  if (is_usable(noise_)) {
    std::array<SpectralMode, kMaxNoiseLines> modes{};
    std::ranges::transform(lines(), modes.begin(), &NoiseLine::mode);
    whittle_.observe(periodogram_, noise_, std::span(modes).first(line_count_));
  }
  report.noise_floor = std::sqrt(seen_noise());
}

void JointFit::scale_lines(double factor) noexcept {
  for (NoiseLine& line : std::span(lines_).first(line_count_)) {
    line.power *= factor;
    line.mode.drive *= factor;
  }
}

double JointFit::lines_power() const noexcept {
  double sum = 0.0;
  for (const NoiseLine& line : lines()) sum += line.power;
  return sum;
}

/// The noise's lines as far as windows have shown where they are.
void JointFit::take_lines(LineTrackers& trackers, std::span<const SpectralLine> believed) noexcept {
  believe(believed, trackers);
  line_count_ = believed.size();
  for (std::size_t i = 0; i < line_count_; ++i) lines_[i] = trackers[i].line(options_.line);
}

/// The tone that stands out most, of the noise where that has lines of its own.
Tone JointFit::find_motion_tone() noexcept {
  if (line_count_ == 0) return find_tone(periodogram_, options_.tone_prominence);
  const auto noise = whittle_.noise();
  for (std::size_t k = 0; k < noise.size(); ++k) whitened_[k] = periodogram_[k] / noise[k];
  Tone tone = find_tone(whitened_, options_.tone_prominence);
  const double bin = 2.0 * tone.frequency_cycles * static_cast<double>(noise.size() - 1);
  tone.amplitude *= std::sqrt(noise[static_cast<std::size_t>(std::lround(bin))]);
  return tone;
}

/// IMF by IMF: its figures, and a mode to start from. What is slower than T_slow is gathered with the residue.
void JointFit::decompose(WindowReport& report) noexcept {
  const std::span<double> imf{imf_.data(), centred_.size()};
  const std::span<double> slow{slow_.data(), centred_.size()};
  std::ranges::fill(slow, 0.0);
  full_.clear();
  emd_.start(centred_);
  while (emd_.next_imf(imf)) {
    describe(imf, report);
    const ImfFigures& figures = report.imf[report.imf_count - 1];
    if (figures.imf_class == ImfClass::kSignal || full_.size() + 1 >= kMaxModes) {
      for (std::size_t n = 0; n < slow.size(); ++n) slow[n] += imf[n];
    } else if (figures.imf_class == ImfClass::kMixed) {
      start_mode(imf, figures);
    }
  }
  const auto residue = emd_.residue();
  for (std::size_t n = 0; n < slow.size(); ++n) slow[n] += residue[n];
  ImfFigures slow_figures;
  slow_figures.imf_class = ImfClass::kSignal;
  start_mode(slow, slow_figures);
}

/// Energy, period, excess, its significance, and class of an IMF: noise is left out, mixed becomes a mode, signal joins the slow mode. The noise's lines are not in
/// the window any more.
void JointFit::describe(std::span<const double> imf, WindowReport& report) const noexcept {
  const std::size_t index = ++report.imf_count;
  ImfFigures& figures = report.imf[index - 1];
  figures = {};
  figures.energy = variance(imf);
  figures.mean_period_samples = mean_period(imf);
  const double floor = line_count_ > 0 ? std::sqrt(unit_ * noise_variance(noise_)) : report.noise_floor;
  figures.excess = figures.energy / (floor * floor * noise_line_energy(index));
  if (line_holds_) significance_.judge(figures, index, imf.size());
  // A tone beyond a low signal band is to be told from what is slower: only a mode of its own predicts it.
  if (figures.mean_period_samples > std::max(options_.slow_period_samples, 1.0 / designer_.band_cycles()))
    return;
  report.k = index;
  figures.imf_class = figures.excess < options_.least_excess ? ImfClass::kNoise : ImfClass::kMixed;
  if (figures.imf_class == ImfClass::kNoise && report.j + 1 == index) report.j = index;
}

void JointFit::follow_lines(LineTrackers& trackers, std::size_t samples) noexcept {
  if (line_count_ == 0) return;
  const auto explained = whittle_.explained(full_);
  for (std::size_t i = 0; i < line_count_; ++i) {
    trackers[i].observe({.periodogram = periodogram_,
                         .rest = whittle_.noise_without_lines(),
                         .explained = explained,
                         .resolution = 1.0 / static_cast<double>(samples),
                         .power = lines_[i].power,
                         .share = new_share()},
                        options_.line);
  }
}

}  // namespace gyrod::core
