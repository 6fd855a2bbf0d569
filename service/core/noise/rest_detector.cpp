#include "core/noise/rest_detector.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/noise/line_share.hpp"
#include "core/noise/rest_rules.hpp"

namespace gyrod::core {
namespace {

constexpr double kBlockSeconds = 1.0;
constexpr double kFewestInBlock = 100.0;
/// Effective samples of a block: with fewer it is made longer, until it has enough; with plenty of them a short one will do.
constexpr double kFewEffective = 75.0;
constexpr double kEnoughEffective = 90.0;
constexpr double kPlentyEffective = 400.0;
/// So few, and fewer, let levels differ as of these: else a level that changes by five would be even.
constexpr double kFewestEffective = 40.0;
constexpr std::size_t kMostParts = 4;
/// Share of a block's samples that may be bridged. A bridged sample has half the variance of a measured one: 1 % off the level.
constexpr double kMostBridged = 0.02;
constexpr std::size_t kHalfWindow = RestDetector::kBlocks / 2;
constexpr std::size_t kHalfSegment = kNoiseSegment / 2;

}  // namespace

RestDetector::RestDetector(double sample_rate_hz)
    : low_pass_(sample_rate_hz), force_low_pass_(sample_rate_hz), periodogram_(kNoiseSegment) {
  for (auto& samples : segment_) samples.resize(kNoiseSegment);
  retime(sample_rate_hz);
}

void RestDetector::retime(double sample_rate_hz) noexcept {
  assert(sample_rate_hz > 0.0);
  const double samples = std::max(kBlockSeconds * sample_rate_hz, kFewestInBlock);
  part_samples_ = static_cast<std::size_t>(std::lround(samples));
  set_parts(1);
  low_pass_.retime(sample_rate_hz);
  force_low_pass_.retime(sample_rate_hz);
  interrupt();
}

void RestDetector::set_parts(std::size_t parts) noexcept {
  parts_ = parts;
  block_samples_ = parts * part_samples_;
  most_bridged_ = static_cast<std::size_t>(kMostBridged * static_cast<double>(block_samples_));
}

bool RestDetector::step(const Triple& rate, const Triple* accelerometer) noexcept {
  const std::size_t inputs = accelerometer == nullptr ? 3 : kInputs;
  if (inputs != inputs_) interrupt();
  inputs_ = inputs;
  if (in_block_ == 0) fresh_ = {};
  if (accelerometer != nullptr) take_force(*accelerometer);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    add(axis, rate[axis]);
    if (accelerometer != nullptr) add(3 + axis, (*accelerometer)[axis]);
    segment_[axis][in_segment_] = rate[axis];
  }
  low_pass_.step(rate, periodogram_);
  if (accelerometer != nullptr) force_low_pass_.step(*accelerometer, periodogram_);
  if (++in_segment_ == kNoiseSegment) end_segment();
  if (++in_block_ % part_samples_ == 0) end_part();
  if (in_block_ < block_samples_) return false;
  end_block();
  return true;
}

bool RestDetector::bridge(const Triple& rate, const Triple* accelerometer) noexcept {
  if (++bridged_ <= most_bridged_) return step(rate, accelerometer);
  interrupt();
  return false;
}

void RestDetector::take_force(const Triple& force) noexcept {
  if (in_block_ == 0) forces_ = 0;
  if (forces_ == 0 || force != force_) ++forces_;
  force_ = force;
}

void RestDetector::add(std::size_t input, double value) noexcept {
  Sums& sums = sums_[input];
  if (in_block_ == 0) sums = {.first = value};
  const double offset = value - sums.first;
  sums.sum += offset;
  sums.part += offset;
  sums.squares += offset * offset;
}

void RestDetector::end_part() noexcept {
  for (std::size_t input = 0; input < inputs_; ++input) {
    Sums& sums = sums_[input];
    const double mean = sums.part / static_cast<double>(part_samples_);
    sums.means += mean;
    sums.squared_means += mean * mean;
    sums.part = 0.0;
  }
}

void RestDetector::end_segment() noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    periodogram_.transform(segment_[axis], scratch_);
    std::ranges::copy(periodogram_.spectrum(), transforms_[axis].begin());
    std::copy(segment_[axis].begin() + kHalfSegment, segment_[axis].end(), segment_[axis].begin());
  }
  fresh_.add(transforms_);
  in_segment_ = kHalfSegment;
}

void RestDetector::end_block() noexcept {
  const double count = static_cast<double>(block_samples_);
  const double parts = static_cast<double>(parts_);
  newest_ = (newest_ + 1) % kBlocks;
  for (std::size_t input = 0; input < inputs_; ++input) {
    const Sums& sums = sums_[input];
    const double mean = sums.sum / count;
    const double mean_of_means = sums.means / parts;
    windows_[input][newest_] = {
        .mean = sums.first + mean,
        .variance = std::max(sums.squares / count - mean * mean, 0.0),
        .variance_of_means = std::max(sums.squared_means / parts - mean_of_means * mean_of_means, 0.0)};
  }
  force_counts_[newest_] = static_cast<double>(forces_);
  in_block_ = bridged_ = 0;
  if (!newest_is_even()) {
    begin_run();
    after_gap_ = false;
  }
  blocks_ = std::min(blocks_ + 1, kBlocks);
  add_fresh();
  verdict_ = judge();
  if (++in_half_ == kHalfWindow) end_half();
  settle_block();
}

void RestDetector::add_fresh() noexcept {
  if (fresh_.count == 0.0) return;
  for (std::size_t axis = 0; axis < this_half_.power.size(); ++axis) {
    for (std::size_t k = 0; k < kNoiseBins; ++k) this_half_.power[axis][k] += fresh_.power[axis][k];
  }
  this_half_.count += fresh_.count;
}

/// Long enough for the noise that there is.
void RestDetector::settle_block() noexcept {
  double independent = low_pass_.independent();
  if (inputs_ == kInputs) independent = std::min(independent, force_low_pass_.independent());
  const double effective = static_cast<double>(part_samples_) * independent;
  const double now = effective * static_cast<double>(parts_);
  if (now >= kFewEffective && now <= kPlentyEffective && independent < 1.0) return;
  std::size_t parts = 1;
  while (parts < kMostParts && effective * static_cast<double>(parts) < kEnoughEffective) parts *= 2;
  if (parts == parts_) return;
  set_parts(parts);
  begin_run();
  after_gap_ = true;
  verdict_ = RestVerdict::kTooEarly;
}

/// With the newest block; the segment at work holds what was before.
void RestDetector::begin_run() noexcept {
  blocks_ = 0;
  fresh_ = {};
  this_half_ = last_half_ = {};
  in_segment_ = in_half_ = 0;
  listened_ = false;
}

void RestDetector::end_half() noexcept {
  last_half_ = this_half_;
  this_half_ = {};
  in_half_ = 0;
}

void RestDetector::interrupt() noexcept {
  set_parts(1);
  begin_run();
  low_pass_.interrupt();
  force_low_pass_.interrupt();
  in_block_ = bridged_ = 0;
  after_gap_ = true;
  verdict_ = RestVerdict::kTooEarly;
}

RestVerdict RestDetector::judge() noexcept {
  if (blocks_ < kBlocks) return after_gap_ ? RestVerdict::kTooEarly : RestVerdict::kUneven;
  average();
  if (std::ranges::all_of(variance_, [](double v) { return !(v > 0.0); })) return RestVerdict::kFrozen;
  for (std::size_t input = 0; input < inputs_; ++input) {
    const double most =
        (input < 3 ? rest_rules::kSteady : rest_rules::kSteadyAccelerometer) * low_pass_of(input).slow();
    if (!is_motionless(input, kBlocks) && wandering(input) > most) return RestVerdict::kWandering;
  }
  listen();
  if (!listened_) return RestVerdict::kTooEarly;
  return tone_ ? RestVerdict::kTone : RestVerdict::kRest;
}

void RestDetector::average() noexcept {
  mean_ = variance_ = {};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const Block& block : windows_[axis]) {
      mean_[axis] += block.mean / static_cast<double>(kBlocks);
      variance_[axis] += block.variance / static_cast<double>(kBlocks);
    }
  }
}

/// With every block of the run, up to seven before.
bool RestDetector::newest_is_even() const noexcept {
  for (std::size_t input = 0; input < inputs_; ++input) {
    if (is_motionless(input, std::min(blocks_ + 1, kBlocks))) continue;
    const Window& window = windows_[input];
    double least = window[newest_].variance;
    double most = least;
    for (std::size_t back = 1; back <= std::min(blocks_, kBlocks - 1); ++back) {
      const double variance = window[(newest_ + kBlocks - back) % kBlocks].variance;
      least = std::min(least, variance);
      most = std::max(most, variance);
    }
    const double effective =
        std::max(static_cast<double>(block_samples_) * low_pass_of(input).independent(), kFewestEffective);
    const double fewest = std::min(effective, fewest_in(input, std::min(blocks_ + 1, kBlocks)));
    if (most > rest_rules::most_uneven(fewest) * least) return false;
  }
  return true;
}

/// Samples in one of the newest blocks that tell something new, in the one with the fewest; at least 1.
double RestDetector::fewest_in(std::size_t input, std::size_t blocks) const noexcept {
  auto fewest = static_cast<double>(block_samples_);
  for (std::size_t back = 0; input >= 3 && back < blocks; ++back)
    fewest = std::min(fewest, force_counts_[(newest_ + kBlocks - back) % kBlocks]);
  return fewest;
}

/// The accelerometer's axis has kept to rest_rules::kMotionless_mps2 over so many of the newest blocks.
bool RestDetector::is_motionless(std::size_t input, std::size_t blocks) const noexcept {
  if (input < 3) return false;
  const Window& window = windows_[input];
  double lowest = window[newest_].mean;
  double highest = lowest;
  double loudest = 0.0;
  for (std::size_t back = 0; back < blocks; ++back) {
    const Block& block = window[(newest_ + kBlocks - back) % kBlocks];
    lowest = std::min(lowest, block.mean);
    highest = std::max(highest, block.mean);
    loudest = std::max(loudest, block.variance);
  }
  return highest - lowest < rest_rules::kMotionless_mps2 &&
         loudest < rest_rules::kMotionless_mps2 * rest_rules::kMotionless_mps2;
}

/// Spread of the parts' means over what white noise of the blocks' level explains; 0 where nothing changes.
double RestDetector::wandering(std::size_t input) const noexcept {
  const Window& window = windows_[input];
  const double count = static_cast<double>(kBlocks);
  const double parts = static_cast<double>(parts_);
  // From one of them, so that means which are all the same have no spread by rounding.
  const double origin = window.front().mean;
  double centre = 0.0;
  double level = 0.0;
  for (const Block& block : window) {
    centre += (block.mean - origin) / count;
    level += block.variance / count;
  }
  double spread = 0.0;
  for (const Block& block : window) {
    const double off = block.mean - origin - centre;
    spread += (off * off + block.variance_of_means) * parts / (count * parts - 1.0);
  }
  if (!(spread > 0.0)) return 0.0;
  return spread * (fewest_in(input, kBlocks) / parts) / level;
}

/// Too few segments at the moment leave the answer that there was.
void RestDetector::listen() noexcept {
  const double count = this_half_.count + last_half_.count;
  if (count < rest_rules::kFewestSegments) return;
  listened_ = true;
  tone_ = false;
  std::size_t alive = 0;
  Triple further{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k < kNoiseBins; ++k)
      scratch_[k] = this_half_.power[axis][k] + last_half_.power[axis][k];
    const LineShares lines = line_shares(scratch_);
    tone_ = tone_ || lines.all > rest_rules::kTone;
    further[axis] = lines.further;
    alive += variance_[axis] > 0.0 ? 1U : 0U;
  }
  std::ranges::sort(further);
  // Of two axes both, of one that.
  tone_ = tone_ || further[alive == 1 ? 2 : 1] > rest_rules::most_further(count, low_pass_.independent());
}

}  // namespace gyrod::core
