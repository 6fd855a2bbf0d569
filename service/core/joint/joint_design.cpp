// What the fit makes of its modes: the members of the bank.
#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "core/joint/joint_fit.hpp"
#include "core/joint/line_modes.hpp"

namespace gyrod::core {
namespace {

FilterBlock colour_block(const NoiseModel& noise) noexcept {
  FilterBlock block;
  block.order = noise.colour_order;
  std::ranges::copy(noise.colour, block.a.begin());
  block.drive = noise.colour_variance;
  return block;
}

}  // namespace

void JointFit::design(JointModel& model) noexcept {
  model.noise_variance = seen_noise();
  model.slow_noise_variance = unit_ * whittle_.noise_without_lines().front();
  // Members of another band say nothing of this one.
  if (model.band_cycles != designer_.band_cycles()) {
    for (MemberModel& member : model.members) member.usable = false;
  }
  model.band_cycles = designer_.band_cycles();
  const bool band = model.band_cycles < 0.5;
  model.beyond_band_variance = band ? unit_ * beyond_band() : 0.0;
  model.residual_variance =
      band ? std::numeric_limits<double>::infinity() : model.noise_variance + unit_ * left_out();
  make(blocks_of(full_, 1.0), MemberKind::kFull, model);
  make(blocks_of(pruned_, 1.0), MemberKind::kPruned, model);
  const double drive =
      scale_.agile_drive(options_.agile_drive) * model.member(MemberKind::kFull).innovation_variance / unit_;
  const double rho = options_.level_pole;
  const double d = options_.slope_pole;
  FilterBlock agile{.order = 1, .a = {rho}, .drive = drive, .signal = 1.0};
  make(with_agile(agile), MemberKind::kLevel, model);
  agile.order = 2;
  agile.a = {rho + d, -rho * d};
  make(with_agile(agile), MemberKind::kSlope, model);
  make(blocks_of(full_, options_.rough_drive), MemberKind::kRough, model);
  make(blocks_of(full_, options_.still_drive), MemberKind::kStill, model);
  if (!make(blocks_of(lasting_, 1.0), MemberKind::kLasting, model)) model.lasting.forget();
}

/// A member in the data's unit. One that cannot be made keeps what it was. @return whether it was made
bool JointFit::make(const BlockSet& blocks, MemberKind kind, JointModel& model) noexcept {
  MemberModel& member = model.member(kind);
  if (!designer_.design(blocks, noise_.white_variance, member)) {
    ++model.fallbacks;
    return false;
  }
  member.innovation_variance *= unit_;
  member.prediction_variance *= unit_;
  member.white_variance *= unit_;
  for (double& variance : member.band_variance) variance *= unit_;
  return true;
}

/// The modes, all but the slow one and a tone driven so many times as hard, with their roots pulled in; and the noise's colour and lines.
BlockSet JointFit::blocks_of(const ModeSet& modes, double times_drive) noexcept {
  BlockSet set;
  for (const SpectralMode& mode : modes.modes()) {
    const double harder = mode.slow || mode.tone ? 1.0 : times_drive;
    FilterBlock block{.order = kModeOrder, .drive = mode.drive * harder, .signal = mode.share};
    if (mode.share > 0.0 && mode.share < 1.0)
      block.apart = mode.share * (1.0 - mode.share) * harder * whittle_.weigh(mode).power;
    double factor = 1.0;
    for (std::size_t i = 0; i < kModeOrder; ++i) {
      factor *= options_.pole_factor;
      block.a[i] = mode.a[i] * factor;
    }
    set.add(block);
  }
  if (noise_.colour_order > 0) set.add(colour_block(noise_));
  for (const NoiseLine& line : lines())
    set.add({.order = 2, .a = {line.mode.a[0], line.mode.a[1]}, .drive = line.mode.drive});
  return set;
}

/// What the noise's own lines have left in modes beside them is no motion.
void JointFit::share_out(ModeSet& modes) noexcept {
  if (line_count_ == 0) return;
  std::array<std::array<ModeNearLine, kMaxModes>, kMaxNoiseLines> candidates{};
  std::array<std::size_t, kMaxNoiseLines> counts{};
  for (SpectralMode& mode : modes.modes()) {
    if (mode.slow) continue;
    const auto [centre_cycles, power] = whittle_.weigh(mode);
    for (std::size_t i = 0; power > 0.0 && i < line_count_; ++i) {
      if (!lines_[i].reaches(centre_cycles, options_.line)) continue;
      candidates[i][counts[i]++] = {&mode, power};
      break;
    }
  }
  for (std::size_t i = 0; i < line_count_; ++i)
    share_with_line(lines_[i].power, std::span(candidates[i]).first(counts[i]));
}

/// Variance of what is left out of the modes.
double JointFit::left_out() noexcept {
  double sum = 0.0;
  for (const SpectralMode& mode : full_.modes()) {
    if (mode.share < 1.0) sum += (1.0 - mode.share) * whittle_.weigh(mode).power;
  }
  return sum;
}

/// Variance of what the full set has beyond the signal band or leaves out.
double JointFit::beyond_band() noexcept {
  double sum = left_out();
  for (const SpectralMode& mode : full_.modes())
    sum += mode.share * whittle_.power_from(mode, designer_.band_cycles());
  return sum;
}

BlockSet JointFit::with_agile(const FilterBlock& agile) noexcept {
  BlockSet set = blocks_of(pruned_, 1.0);
  set.add(agile);
  return set;
}

}  // namespace gyrod::core
