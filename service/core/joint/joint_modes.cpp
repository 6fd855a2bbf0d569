// What the fit makes of IMFs: the modes of a window, and of the last windows together.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/joint/joint_fit.hpp"
#include "core/signal/portable_math.hpp"

namespace gyrod::core {
namespace {

/// What a mode's drive is multiplied by at the start where its IMF holds no more than noise.
constexpr double kLeastShare = 0.05;

}  // namespace

void JointFit::start_mode(std::span<const double> imf, const ImfFigures& figures) noexcept {
  std::array<double, kModeOrder + 1> r{};
  tapers_.autocovariance(imf, r);
  for (double& value : r) value /= unit_;
  const bool slow = figures.imf_class == ImfClass::kSignal;
  SpectralMode mode = whittle_.mode_of(r, slow);
  if (!slow) mode.drive *= std::max(1.0 - 1.0 / figures.excess, kLeastShare);
  if (slow || mode.drive > 0.0) full_.add(mode);
}

/// A mode to start from, of this variance in the periodogram's unit, with poles of this radius.
SpectralMode JointFit::oscillation(double cycles, double power, double pole) const noexcept {
  std::array<double, kModeOrder + 1> r{};
  for (std::size_t lag = 0; lag < r.size(); ++lag) {
    r[lag] = power * portable_sine_cosine(cycles * static_cast<double>(lag)).cosine;
    power *= pole;
  }
  return whittle_.mode_of(r, false);
}

/// An IMF holds a tone together with much else, and its mode is too wide for it: the tone gets one of its own.
void JointFit::start_tone(const Tone& tone) noexcept {
  if (!(tone.amplitude > 0.0) || full_.full()) return;
  SpectralMode mode =
      oscillation(tone.frequency_cycles, tone.amplitude * tone.amplitude / 2.0, options_.tone_pole);
  mode.tone = true;
  if (mode.drive > 0.0) full_.add(mode);
}

/// So does what is wider, or another tone, where the modes so far leave it unexplained.
void JointFit::find_resonances(ModeSet& modes, double least_gain) noexcept {
  for (int i = 0; i < options_.resonances && !modes.full(); ++i) {
    const WhittleFit::Band band = whittle_.least_explained(modes);
    if (!(band.gain >= least_gain && band.power > 0.0)) return;
    const double pole = portable_exp(-std::numbers::pi * band.width_cycles);
    const SpectralMode mode = oscillation(band.centre_cycles, band.power, pole);
    if (!(mode.drive > 0.0)) return;
    modes.add(mode);
    whittle_.iterate(modes, options_.resonance_iterations);
  }
}

/// The full set in the eyes of the tapers that look at the newest samples most, the pruned one in the eyes of the others. The first is left in
/// whittle_.
void JointFit::fit_modes(LastingSpectrum& lasting) noexcept {
  whittle_.iterate(full_, options_.pruned_iterations);
  find_resonances(full_, options_.resonance_gain);
  pruned_ = full_;
  lasting_ = full_;
  for (double& power : pruned_periodogram_) power /= unit_;
  whittle_.observe(pruned_periodogram_);
  whittle_.iterate(pruned_, options_.pruned_iterations);
  whittle_.prune(pruned_, options_.prune_gain);
  whittle_.iterate(pruned_, options_.final_iterations);
  fit_lasting(lasting);
  whittle_.observe(periodogram_);
  whittle_.iterate(full_, options_.full_iterations - options_.pruned_iterations);
  share_out(full_);
  share_out(pruned_);
  share_out(lasting_);
}

/// A fit that goes on for long may make of any mode any other. The one that is slowest is the slow one.
void JointFit::name_slow_mode(ModeSet& modes) noexcept {
  SpectralMode* slowest = nullptr;
  double least = 0.0;
  for (SpectralMode& mode : modes.modes()) {
    const auto [centre_cycles, power] = whittle_.weigh(mode);
    mode.slow = false;
    if (slowest != nullptr && !(power > 0.0 && centre_cycles < least)) continue;
    slowest = &mode;
    least = power > 0.0 ? centre_cycles : 0.5;
  }
  if (slowest != nullptr) slowest->slow = true;
}

/// The modes of the last windows together go on from where the window before left them, the first time from those of this window.
void JointFit::fit_lasting(LastingSpectrum& lasting) noexcept {
  const double full = static_cast<double>(centred_.size()) / static_cast<double>(max_samples_);
  const double share = std::min(new_share() / options_.lasting_windows, 1.0);
  lasting.observe(pruned_periodogram_, unit_, full * full, share);
  lasting.mean(unit_, pruned_periodogram_);
  const ModeSet kept = lasting.modes(unit_);
  if (kept.size() > 0) lasting_ = kept;
  whittle_.observe(pruned_periodogram_);
  whittle_.iterate(lasting_, options_.lasting_iterations);
  find_resonances(lasting_, options_.lasting_resonance_gain);
  whittle_.prune(lasting_, options_.lasting_prune_gain);
  whittle_.iterate(lasting_, options_.lasting_final_iterations);
  name_slow_mode(lasting_);
  if (centred_.size() == max_samples_) lasting.keep(lasting_, unit_);
}

/// Where nothing but the slow mode is left after pruning, what the full set has beside it may be the noise's: it then counts by what it buys.
double JointFit::prior_of_full() noexcept {
  if (pruned_.size() > 1) return 1.0;
  const double bought = 2.0 * (whittle_.log_likelihood(full_) - whittle_.log_likelihood(pruned_));
  if (!(bought < options_.full_evidence)) return 1.0;
  return std::max(portable_exp(0.5 * (bought - options_.full_evidence)), options_.least_full_prior);
}

}  // namespace gyrod::core
