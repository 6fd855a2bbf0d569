/// One sensor's released samples, by number and time, for unit tests.
#pragma once

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "bus/held_samples.hpp"

namespace gyrod::bus {

inline constexpr Others kAlone{.any = false, .stronger = false};
inline constexpr Others kWeaker{.any = true, .stronger = true};
inline constexpr Others kStrongest{.any = true, .stronger = false};
/// A stronger one, which gave its last sign of life then.
inline Others stronger_that_lived(double when_s) {
  return {.any = true, .stronger = true, .stronger_lived_s = when_s};
}

/// Times in seconds from 0 on; sample n has stamp 10 n. Takes over after 1 s.
class HeldSamplesTest : public ::testing::Test {
 protected:
  static stream::DenoisedSample sample(std::uint64_t n) {
    return {.sequence = n, .stamp_ns = 10 * static_cast<std::int64_t>(n)};
  }
  void release(std::uint64_t first, std::uint64_t last, double now_s) {
    for (std::uint64_t n = first; n <= last; ++n) {
      const stream::DenoisedSample one = sample(n);
      held_.release({&one, 1}, now_s);
    }
  }
  void hear(std::uint64_t n, bool stronger) { held_.hear({n, 10 * static_cast<std::int64_t>(n)}, stronger); }
  std::vector<std::uint64_t> take(double now_s, const Others& others) {
    std::vector<std::uint64_t> taken;
    held_.take(now_s, others, [&taken](const auto& one) { taken.push_back(one.sequence); });
    return taken;
  }

  HeldSamples<stream::DenoisedSample> held_{{.takeover_s = 1.0, .most = 100}};
};

}  // namespace gyrod::bus
