/// A bank that is nothing but its filters, models for it, and records that follow them.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "core/joint/kalman_bank.hpp"
#include "unit/core/joint/joint_support.hpp"

namespace gyrod::testing {

/// Variance of the white part.
inline constexpr double kBankNoise = 0.7;
/// An oscillation, a wandering level, and coloured noise.
inline core::BlockSet blocks() {
  core::BlockSet set;
  set.add(oscillation(0.95, 0.4, 0.8));
  set.add({.order = 1, .a = {0.97}, .drive = 0.5, .signal = 1.0});
  set.add(oscillation(0.6, 1.5, 0.6, 0.0));
  return set;
}

/// A model of one member; nothing but the filter is left of the bank.
inline core::JointModel single(const core::BlockSet& set, double mean = 0.0) {
  core::JointModel model;
  EXPECT_TRUE(core::MemberDesigner().design(set, kBankNoise, model.member(core::MemberKind::kFull)));
  model.mean = mean;
  return model;
}

/// No corrections, no widening, hand-overs at once.
inline core::JointOptions bare() {
  core::JointOptions options;
  options.correction_rate = 0.0;
  options.correction_share = 0.0;
  options.steady_correction = 0.0;
  options.late_steady_correction = 0.0;
  options.most_gain = 0.0;
  options.most_later_gain = 0.0;
  options.most_later_loss = 0.0;
  options.variance_factor = 1.0;
  options.hand_over_memory = 0.0;
  return options;
}

inline Signal simulated(const core::BlockSet& set, std::size_t size, unsigned seed) {
  Signal z = times(white_noise(size, seed), std::sqrt(kBankNoise));
  for (const core::FilterBlock& block : set.all()) {
    const std::vector<double> a(block.a.begin(), block.a.begin() + static_cast<std::ptrdiff_t>(block.order));
    z = sum(z, autoregressive(a, size, ++seed), std::sqrt(block.drive));
  }
  return z;
}

}  // namespace gyrod::testing
