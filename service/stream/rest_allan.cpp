#include "stream/rest_allan.hpp"

namespace gyrod::stream {

void RestAllan::step(const std::array<double, kAxes>& rate_radps) noexcept {
  if (!at_rest_) return;
  for (std::size_t axis = 0; axis < kAxes; ++axis) now_[axis].step(rate_radps[axis]);
}

void RestAllan::end_block(bool at_rest) noexcept {
  if (!at_rest) return interrupt();
  // The first block at rest: nothing has been taken yet, the next sample begins a stretch.
  if (at_rest_) {
    sure_ = ended_;
    ended_ = now_;
  }
  at_rest_ = true;
}

void RestAllan::interrupt() noexcept {
  at_rest_ = false;
  for (core::OnlineAllan& axis : sure_) axis.interrupt();
  now_ = ended_ = sure_;
}

AllanCurves RestAllan::curves() const noexcept {
  AllanCurves all;
  for (std::size_t axis = 0; axis < kAxes; ++axis) all[axis] = sure_[axis].sums();
  return all;
}

void RestAllan::restore(const AllanCurves& curves) noexcept {
  at_rest_ = false;
  for (std::size_t axis = 0; axis < kAxes; ++axis) sure_[axis].restore(curves[axis]);
  now_ = ended_ = sure_;
}

}  // namespace gyrod::stream
