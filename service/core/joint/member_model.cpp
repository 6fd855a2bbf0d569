#include "core/joint/member_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/joint/band_design.hpp"
#include "core/joint/block_riccati.hpp"
#include "core/joint/companion_blocks.hpp"

namespace gyrod::core {

double MemberModel::error_variance(std::size_t lag) const noexcept {
  assert(lag <= kMaxLag);
  double sum = 0.0;
  for (std::size_t k = 0; k <= lag; ++k) sum += smoothing[k] * smoothing[k];
  return std::max(prediction_variance - innovation_variance * sum, 0.0);
}

double MemberModel::leverage(std::size_t lag) const noexcept {
  assert(lag <= kMaxLag);
  if (!(white_variance > 0.0)) return 1.0;
  double sum = 0.0;
  for (std::size_t k = 0; k <= lag; ++k) sum += whole_smoothing[k] * whole_smoothing[k];
  const double unknown = innovation_variance - white_variance - innovation_variance * sum;
  return std::clamp(unknown / white_variance, 0.0, 1.0);
}

class MemberDesigner::Workspace {
 public:
  bool design(const BlockSet& blocks, double r, MemberModel& member) noexcept {
    if (!riccati_.solve(blocks, r)) return false;
    const double S = riccati_.innovation_variance();
    const auto observed = riccati_.observed_covariance();
    std::array<double, kMaxStates> gain{};
    std::ranges::transform(observed, gain.begin(), [S](double covariance) { return covariance / S; });
    if (!std::ranges::all_of(gain, [](double K) { return std::isfinite(K); })) return false;
    MemberModel made{.blocks = blocks,
                     .states = observed.size(),
                     .gain = gain,
                     .innovation_variance = S,
                     .white_variance = r,
                     .usable = true};
    see_signal(blocks);
    std::size_t head = 0;
    for (const FilterBlock& block : blocks.all()) {
      made.prediction_variance += block.signal * signal_covariance_[head] + block.apart;
      head += block.order;
    }
    smooth(made);
    if (!band.describe(signal_covariance_, made)) return false;
    member = made;
    return true;
  }

  BandDesign band;

 private:
  /// X C.
  void see_signal(const BlockSet& blocks) noexcept {
    signal_covariance_.fill(0.0);
    const std::size_t states = riccati_.observed_covariance().size();
    std::size_t head = 0;
    for (const FilterBlock& block : blocks.all()) {
      for (std::size_t i = 0; block.signal > 0.0 && i < states; ++i) {
        signal_covariance_[i] += block.signal * riccati_.covariance(head, i);
      }
      head += block.order;
    }
  }

  /// g_k for all lags: h <- F' h = (I - H K') A' h.
  void smooth(MemberModel& member) noexcept {
    std::array<double, kMaxStates> h = heads(member.blocks.all());
    const auto observed = riccati_.observed_covariance();
    for (std::size_t k = 0; k <= kMaxLag; ++k) {
      double signal = 0.0;
      double whole = 0.0;
      for (std::size_t i = 0; i < member.states; ++i) {
        signal += signal_covariance_[i] * h[i];
        whole += observed[i] * h[i];
      }
      member.smoothing[k] = signal / member.innovation_variance;
      member.whole_smoothing[k] = whole / member.innovation_variance;
      step_back(member, h);
    }
  }

  BlockRiccati riccati_;
  std::array<double, kMaxStates> signal_covariance_{};
};

MemberDesigner::MemberDesigner() : workspace_(std::make_unique<Workspace>()) {}
MemberDesigner::~MemberDesigner() = default;
MemberDesigner::MemberDesigner(MemberDesigner&&) noexcept = default;
MemberDesigner& MemberDesigner::operator=(MemberDesigner&&) noexcept = default;

void MemberDesigner::set_band(double cycles) noexcept { workspace_->band.set(cycles); }

double MemberDesigner::band_cycles() const noexcept { return workspace_->band.band().cycles(); }

bool MemberDesigner::design(const BlockSet& blocks, double noise_variance, MemberModel& member) noexcept {
  assert(noise_variance > 0.0);
  return workspace_->design(blocks, noise_variance, member);
}

}  // namespace gyrod::core
