/// What the transition A of companion blocks does. Internal to core/joint.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/joint/member_model.hpp"

namespace gyrod::core {

/// x <- A x of one block: the next value of a process without its noise, a_1 x[0] + ... + a_p x[p-1], comes first in its state. @return it
inline double advance(const std::array<double, kMaxNoiseColour>& a, double* x, std::size_t order) noexcept {
  double head = 0.0;
  double newer = 0.0;
  for (std::size_t i = 0; i < order; ++i) {
    const double older = x[i];
    head += a[i] * older;
    x[i] = newer;
    newer = older;
  }
  x[0] = head;
  return head;
}

/// row <- row A of all blocks, row a row vector over their states.
inline void advance_row(std::span<const FilterBlock> blocks, double* row) noexcept {
  for (const FilterBlock& block : blocks) {
    const double head = row[0];
    for (std::size_t i = 0; i + 1 < block.order; ++i) row[i] = block.a[i] * head + row[i + 1];
    row[block.order - 1] = block.a[block.order - 1] * head;
    row += block.order;
  }
}

/// row <- row + factor C, C the blocks' signal at their heads.
inline void add_signal(std::span<const FilterBlock> blocks, double factor, double* row) noexcept {
  for (const FilterBlock& block : blocks) {
    row[0] += factor * block.signal;
    row += block.order;
  }
}

/// H: 1 at each block's head.
inline std::array<double, kMaxStates> heads(std::span<const FilterBlock> blocks) noexcept {
  std::array<double, kMaxStates> H{};
  std::size_t head = 0;
  for (const FilterBlock& block : blocks) {
    H[head] = 1.0;
    head += block.order;
  }
  return H;
}

/// h <- F' h = (I - H K') A' h: a step back in time of a member's smoother.
inline void step_back(const MemberModel& member, std::array<double, kMaxStates>& h) noexcept {
  advance_row(member.blocks.all(), h.data());
  double correction = 0.0;
  for (std::size_t i = 0; i < member.states; ++i) correction += member.gain[i] * h[i];
  std::size_t head = 0;
  for (const FilterBlock& block : member.blocks.all()) {
    h[head] -= correction;
    head += block.order;
  }
}

}  // namespace gyrod::core
