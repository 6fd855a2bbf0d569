#include "core/joint/band_answers.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <span>

#include "core/joint/companion_blocks.hpp"
#include "core/signal/sums.hpp"

namespace gyrod::core {
namespace {

/// In f, of the sample of this age.
std::ptrdiff_t offset_of(std::size_t lag, std::size_t age) noexcept {
  return static_cast<std::ptrdiff_t>(lag) - static_cast<std::ptrdiff_t>(age);
}

/// sum_(k = age .. kMaxLag) f[lag - k] g_(k - age).
double told_by_innovation(const SignalBand& band, const MemberModel& member, std::size_t lag,
                          std::size_t age) noexcept {
  double sum = 0.0;
  for (std::size_t k = age; k <= kMaxLag; ++k) sum += band.tap(offset_of(lag, k)) * member.smoothing[k - age];
  return sum;
}

/// A look-ahead of one sample less: row <- (row + f[lag] C') A.
void step_ahead(const SignalBand& band, const MemberModel& member, std::size_t lag,
                std::array<double, kMaxStates>& row) noexcept {
  add_signal(member.blocks.all(), band.tap(offset_of(lag, 0)), row.data());
  advance_row(member.blocks.all(), row.data());
}

}  // namespace

void BandAnswers::use(const BankModel& model) noexcept {
  band_.set(model.band_cycles);
  if (!band_.limits()) return;
  for (std::size_t lag = 0; lag <= kMaxLag; ++lag) {
    const auto taps = settled_taps(lag);
    shares_[lag] = 1.0 - std::accumulate(taps.begin(), taps.end(), 0.0);
  }
  for (std::size_t i = 0; i < kMembers; ++i) {
    if (!model.members[i].usable) continue;
    for (std::size_t slot = 0; slot < kOftenAsked; ++slot) {
      const auto* const same = std::find(lags_.begin(), lags_.begin() + slot, lags_[slot]);
      if (same == lags_.begin() + slot) rows_[i][slot] = make_row(model.members[i], lags_[slot]);
    }
  }
}

BandAnswers::Row BandAnswers::make_row(const MemberModel& member, std::size_t lag) const noexcept {
  assert(lag <= kMaxLag);
  Row row{.states = member.ahead};
  for (std::size_t L = kMaxLag; L > lag; --L) step_ahead(band_, member, L, row.states);
  for (std::size_t age = 0; age <= kMaxLag; ++age)
    row.innovations[age] = told_by_innovation(band_, member, lag, age);
  return row;
}

const BandAnswers::Row* BandAnswers::known_row(std::size_t member, std::size_t lag) const noexcept {
  const auto* const known = std::ranges::find(lags_, lag);
  return known != lags_.end() ? &rows_[member][static_cast<std::size_t>(known - lags_.begin())] : nullptr;
}

void BandAnswers::feed(double estimate) noexcept {
  if (settled_count_ == 0) settled_.fill(estimate);
  settled_[settled_count_ % kRing] = settled_[settled_count_ % kRing + kRing] = estimate;
  ++settled_count_;
}

/// f[-reach] .. f[lag - kMaxLag - 1].
std::span<const double> BandAnswers::settled_taps(std::size_t lag) const noexcept {
  const std::size_t later = kMaxLag - lag;
  return band_.reach() > later ? band_.taps().first(band_.reach() - later) : std::span<const double>{};
}

double BandAnswers::settled_part(std::size_t lag) const noexcept {
  const auto taps = settled_taps(lag);
  const std::size_t newest = (settled_count_ - 1) % kRing + kRing;
  return dot(taps, std::span(settled_).subspan(newest - taps.size(), taps.size()));
}

}  // namespace gyrod::core
