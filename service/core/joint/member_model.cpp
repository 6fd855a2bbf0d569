#include "core/joint/member_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/LU>

namespace gyrod::core {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxStates, kMaxStates>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxStates, 1>;

}  // namespace

double MemberModel::error_variance(std::size_t lag) const noexcept {
  assert(lag <= kMaxLag);
  double sum = 0.0;
  for (std::size_t k = 0; k <= lag; ++k) sum += smoothing[k] * smoothing[k];
  return std::max(prediction_variance - innovation_variance * sum, 0.0);
}

/// The matrices of one design; too large for the stack.
class MemberDesigner::Workspace {
 public:
  bool design(const BlockSet& blocks, double r, MemberModel& member) noexcept {
    fill(blocks);
    if (!solve(r)) return false;
    const Vector XH = X_ * H_;
    const double S = H_.dot(XH) + r;
    if (!(S > 0.0) || !std::isfinite(S)) return false;
    gain_ = XH / S;
    if (!gain_.allFinite()) return false;
    member.blocks = blocks;
    member.states = static_cast<std::size_t>(A_.rows());
    std::copy_n(gain_.data(), member.states, member.gain.begin());
    member.innovation_variance = S;
    member.prediction_variance = C_.dot(X_ * C_);
    smooth(S, member);
    member.usable = true;
    return true;
  }

 private:
  void fill(const BlockSet& blocks) noexcept {
    Eigen::Index size = 0;
    for (const FilterBlock& block : blocks.all()) size += static_cast<Eigen::Index>(block.order);
    assert(size > 0 && size <= static_cast<Eigen::Index>(kMaxStates));
    A_.setZero(size, size);
    Q_.setZero(size, size);
    H_.setZero(size);
    C_.setZero(size);
    Eigen::Index head = 0;
    for (const FilterBlock& block : blocks.all()) {
      const auto order = static_cast<Eigen::Index>(block.order);
      for (Eigen::Index i = 0; i < order; ++i) A_(head, head + i) = block.a[static_cast<std::size_t>(i)];
      for (Eigen::Index i = 1; i < order; ++i) A_(head + i, head + i - 1) = 1.0;
      Q_(head, head) = block.drive;
      H_(head) = 1.0;
      C_(head) = block.signal ? 1.0 : 0.0;
      head += order;
    }
  }

  /// (a, G, X) = (A', H H' / r, Q), W = I + G X:  a <- a W^-1 a,  G <- G + a W^-1 G a',  X <- X + (W^-1 a)' X a.
  bool solve(double r) noexcept {
    constexpr int kMaxDoublings = 40;
    constexpr double kSettled = 1e-12;
    a_ = A_.transpose();
    G_.noalias() = H_ * H_.transpose() / r;
    X_ = Q_;
    for (int step = 0; step < kMaxDoublings; ++step) {
      W_.noalias() = G_ * X_;
      W_.diagonal().array() += 1.0;
      lu_.compute(W_);
      W_a_ = lu_.solve(a_);
      product_.noalias() = X_ * a_;
      growth_.noalias() = W_a_.transpose() * product_;
      X_ += growth_;
      symmetrise(X_);
      if (!X_.allFinite()) return false;
      if (growth_.norm() <= kSettled * X_.norm()) return true;
      W_G_ = lu_.solve(G_);
      product_.noalias() = a_ * W_G_;
      G_.noalias() += product_ * a_.transpose();
      symmetrise(G_);
      product_.noalias() = a_ * W_a_;
      a_.swap(product_);
    }
    return false;
  }

  void symmetrise(Matrix& matrix) noexcept {
    W_ = matrix.transpose();
    matrix = 0.5 * (matrix + W_);
  }

  /// g_k for all lags: h <- F' h = (I - H K') A' h.
  void smooth(double S, MemberModel& member) noexcept {
    const Vector CX = X_ * C_;
    h_ = H_;
    for (double& g : member.smoothing) {
      g = CX.dot(h_) / S;
      next_.noalias() = A_.transpose() * h_;
      h_ = next_ - H_ * gain_.dot(next_);
    }
  }

  Matrix A_, Q_, a_, G_, X_, W_, W_a_, W_G_, product_, growth_;
  Vector H_, C_, gain_, h_, next_;
  Eigen::PartialPivLU<Matrix> lu_{static_cast<Eigen::Index>(kMaxStates)};
};

MemberDesigner::MemberDesigner() : workspace_(std::make_unique<Workspace>()) {}
MemberDesigner::~MemberDesigner() = default;
MemberDesigner::MemberDesigner(MemberDesigner&&) noexcept = default;
MemberDesigner& MemberDesigner::operator=(MemberDesigner&&) noexcept = default;

bool MemberDesigner::design(const BlockSet& blocks, double noise_variance, MemberModel& member) noexcept {
  assert(noise_variance > 0.0);
  return workspace_->design(blocks, noise_variance, member);
}

}  // namespace gyrod::core
