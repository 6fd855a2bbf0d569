/// A gate that has been fed good samples, for tests of what it makes of others.
#pragma once

#include <cstdint>

#include <gtest/gtest.h>

#include "stream/sample_gate.hpp"
#include "support/samples.hpp"

namespace gyrod::stream {

using testing::kPeriodNs;
using testing::sample_at;
using Kind = Verdict::Kind;

class SampleGateTest : public ::testing::Test {
 protected:
  void feed(std::uint64_t count, std::uint64_t first = 0) {
    for (std::uint64_t n = first; n < first + count; ++n)
      ASSERT_EQ(gate_.judge(sample_at(n)).kind, Kind::kAccept);
  }
  void expect_refused(const Sample& sample, RejectReason reason) {
    const Verdict verdict = gate_.judge(sample);
    EXPECT_EQ(verdict.kind, Kind::kRefuse);
    EXPECT_EQ(verdict.reason, reason);
  }
  SampleGate gate_{{.sample_rate_hz = 0.0, .max_rate_radps = 175.0, .max_bridged_samples = 16}};
};

}  // namespace gyrod::stream
