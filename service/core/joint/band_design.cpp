#include "core/joint/band_design.hpp"

#include <algorithm>
#include <cmath>

#include "core/joint/ar_response.hpp"
#include "core/joint/companion_blocks.hpp"
#include "core/signal/portable_math.hpp"
#include "core/signal/sums.hpp"

namespace gyrod::core {
namespace {

/// Responses are followed until what 32 samples add is below this, in parts of what the first 32 add.
constexpr double kFaded = 1e-3;
/// gamma has nothing above the band, so that some of its values will do: so many in a reach.
constexpr std::size_t kValuesOfGamma = 64;

/// drive / |a(w)|^2.
double spectrum(const FilterBlock& block, double cosine, double sine) noexcept {
  return block.drive / ar_response(std::span(block.a).first(block.order), cosine, sine);
}

}  // namespace

BandDesign::BandDesign() : response_(SignalBand::kMaxReach + kMaxLag + kFar + SignalBand::kMaxReach + 1) {}

void BandDesign::set(double cycles) noexcept {
  const double before = band_.cycles();
  band_.set(cycles);
  if (band_.cycles() == before || !band_.limits()) return;
  const double top = std::min(band_.cycles() + 2.0 / static_cast<double>(band_.reach()), 0.5);
  // What is slow beside strong noise is narrow: frequencies lie the closer, the lower they are.
  for (std::size_t i = 0; i < kFrequencies; ++i) {
    const double u = (static_cast<double>(i) + 0.5) / static_cast<double>(kFrequencies);
    const double its_cycles = top * u * u;
    const auto [sine, cosine] = portable_sine_cosine(its_cycles);
    const double gain = band_.gain(its_cycles);
    frequencies_[i] = {.cosine = cosine,
                       .sine = sine,
                       .weight = 4.0 * gain * gain * top * u / static_cast<double>(kFrequencies)};
  }
}

bool BandDesign::describe(std::span<const double> signal_covariance, MemberModel& member) noexcept {
  if (!band_.limits()) return true;
  look_ahead(member);
  respond(signal_covariance, member);
  const double S = member.innovation_variance;
  member.band_variance[kMaxLag] = left_by_all(member) + S * left_by_later();
  for (std::size_t lag = kMaxLag; lag > 0; --lag) {
    const double gamma = told_later(lag);
    member.band_variance[lag - 1] = member.band_variance[lag] + S * gamma * gamma;
  }
  return std::isfinite(member.band_variance[0]) &&
         std::ranges::all_of(member.ahead, [](double part) { return std::isfinite(part); });
}

/// By Horner's rule: row <- (row + f[j] C') A.
void BandDesign::look_ahead(MemberModel& member) const noexcept {
  member.ahead = {};
  for (auto j = static_cast<std::ptrdiff_t>(band_.reach()); j > static_cast<std::ptrdiff_t>(kMaxLag); --j) {
    add_signal(member.blocks.all(), band_.tap(j), member.ahead.data());
    advance_row(member.blocks.all(), member.ahead.data());
  }
}

/// psi_k for -reach <= k <= kMaxLag + kFar + reach, 0 from where it has faded.
void BandDesign::respond(std::span<const double> signal_covariance, const MemberModel& member) noexcept {
  std::array<double, kMaxStates> x = member.gain;
  const std::size_t reach = band_.reach();
  for (std::size_t k = 1; k <= reach; ++k) {
    double signal = 0.0;
    double* state = x.data();
    for (const FilterBlock& block : member.blocks.all()) {
      signal += block.signal * advance(block.a, state, block.order);
      state += block.order;
    }
    response_[reach - k] = signal;
  }
  constexpr std::size_t kPart = 32;
  std::array<double, kMaxStates> h = heads(member.blocks.all());
  const std::span<double> later = std::span(response_).subspan(reach, kMaxLag + kFar + reach + 1);
  std::ranges::fill(later, 0.0);
  double first = 0.0;
  double part = 0.0;
  for (std::size_t k = 0; k < later.size(); ++k) {
    later[k] = dot(signal_covariance.first(member.states), std::span(h).first(member.states)) /
               member.innovation_variance;
    step_back(member, h);
    part += std::abs(later[k]);
    if ((k + 1) % kPart != 0) continue;
    if (k < kPart) first = part;
    if (k > kMaxLag && part < kFaded * first) return;
    part = 0.0;
  }
}

double BandDesign::left_by_all(const MemberModel& member) const noexcept {
  double sum = 0.0;
  for (const Frequency& frequency : frequencies_) {
    double signal = 0.0;
    double other = member.white_variance;
    for (const FilterBlock& block : member.blocks.all()) {
      const double whole = spectrum(block, frequency.cosine, frequency.sine);
      signal += block.signal * whole;
      other += (1.0 - block.signal) * whole;
    }
    sum += frequency.weight * (signal / (signal + other)) * other;
  }
  return sum;
}

/// gamma_m: what the innovation m samples after one tells of it.
double BandDesign::told_later(std::size_t m) const noexcept {
  return dot(band_.taps(), std::span(response_).subspan(m, band_.taps().size()));
}

double BandDesign::left_by_later() const noexcept {
  const std::size_t step =
      band_.reach() / kValuesOfGamma | 1U;  // odd: the one that is taken is in the middle
  double sum = 0.0;
  for (std::size_t m = kMaxLag + 1 + step / 2; m <= kMaxLag + kFar; m += step) {
    const double gamma = told_later(m);
    sum += gamma * gamma;
  }
  return static_cast<double>(step) * sum;
}

}  // namespace gyrod::core
