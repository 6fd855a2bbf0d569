// States that are told at rest, block by block, and which of several is the state.
#include <cmath>

#include <gtest/gtest.h>

#include "health_support.hpp"

namespace gyrod::stream {
namespace {

/// Blocks of one second of a sensor at rest.
class RestHealthTest : public SensorHealthTest {
 protected:
  RestHealthTest() {
    rest_.block_s = 1.0;
    rest_.looks_at_rest = true;
    rest_.usual_deviation_radps.fill(0.01);
    rest_.deviation_radps.fill(0.01);
    rest_.bias_s = 600.0;
    rest_.sample_rate_hz = kHz;
    for (core::AllanSums& sums : rest_.curves) {  // 1e-4 rad/s at every cluster time
      for (std::size_t j = 0; j < 16; ++j) {
        const double m = static_cast<double>(core::allan_cluster(j));
        sums.terms[j] = 1000;
        sums.squares[j] = 2000.0 * m * m * 1e-8;
      }
    }
  }
  void blocks(int count) {
    for (int i = 0; i < count; ++i) watch_.take_block(rest_);
  }
  RestEvidence rest_;
};

TEST_F(RestHealthTest, IsNoisyAfterAMinuteAboveOneAndAHalfAndUntilBelowOnePointThree) {
  rest_.deviation_radps[1] = 0.0149;
  blocks(100);
  EXPECT_EQ(state(), Health::kOk);
  rest_.deviation_radps[1] = 0.0151;
  blocks(59);
  EXPECT_EQ(state(), Health::kOk);
  blocks(1);
  const SensorHealth noisy = judge();
  EXPECT_EQ(noisy.axis[1].state, Health::kNoisy);
  EXPECT_EQ(noisy.axis[0].state, Health::kOk);
  EXPECT_DOUBLE_EQ(noisy.axis[1].value, 1.51);
  rest_.deviation_radps[1] = 0.0131;
  blocks(1000);
  EXPECT_EQ(state(), Health::kNoisy);
  rest_.deviation_radps[1] = 0.0129;
  blocks(1);
  EXPECT_EQ(state(), Health::kOk);
}

TEST_F(RestHealthTest, NoisyNeedsAMinuteWithoutABreakAndOutlastsMotion) {
  rest_.deviation_radps.fill(0.02);
  blocks(59);
  rest_.looks_at_rest = false;
  blocks(1);
  rest_.looks_at_rest = true;
  blocks(59);
  EXPECT_EQ(state(), Health::kOk);
  blocks(1);
  EXPECT_EQ(state(), Health::kNoisy);
  rest_.looks_at_rest = false;
  rest_.deviation_radps.fill(0.0);
  blocks(1000);
  EXPECT_EQ(state(), Health::kNoisy) << "in motion nobody can tell";
}

// The learner takes the louder level over after half an hour; that does not make the sensor well.
TEST_F(RestHealthTest, StaysNoisyWhenTheNoiseIsLearnedAnew) {
  rest_.deviation_radps.fill(0.02);
  blocks(60);
  rest_.usual_deviation_radps.fill(0.02);
  blocks(1000);
  EXPECT_EQ(state(), Health::kNoisy);
}

TEST_F(RestHealthTest, IsNotNoisyAgainstNothing) {
  rest_.usual_deviation_radps.fill(0.0);
  rest_.deviation_radps.fill(1.0);
  blocks(1000);
  EXPECT_EQ(state(), Health::kOk);
}

// 5 sigma: 5 sqrt(2) 1e-4 rad/s of two means that wander, and 2 * 7.292e-5 of the earth.
TEST_F(RestHealthTest, DriftsAfterTenSecondsBeyondFiveSigmaAndUntilRelearned) {
  const double limit = 5.0 * std::sqrt(2.0) * 1e-4 + 2.0 * 7.292115e-5;
  rest_.mean_radps[0] = 0.999 * limit;
  blocks(100);
  EXPECT_EQ(state(), Health::kOk);
  rest_.mean_radps[0] = 1.001 * limit;
  blocks(9);
  EXPECT_EQ(state(), Health::kOk);
  blocks(1);
  const SensorHealth drifting = judge();
  EXPECT_EQ(drifting.axis[0].state, Health::kDrifting);
  EXPECT_NEAR(drifting.axis[0].limit, limit, 1e-12);
  rest_.bias_radps[0] = 0.4 * limit;  // the learner follows: 0.601 of the limit are left
  blocks(1);
  EXPECT_EQ(state(), Health::kDrifting);
  rest_.bias_radps[0] = 0.402 * limit;
  blocks(1);
  EXPECT_EQ(state(), Health::kOk);
}

TEST_F(RestHealthTest, DoesNotDriftWhereTheBiasOrItsWanderIsNotKnown) {
  rest_.mean_radps.fill(0.1);
  rest_.bias_s = 59.0;
  blocks(100);
  EXPECT_EQ(state(), Health::kOk);
  rest_.bias_s = 600.0;
  rest_.curves = {};
  blocks(100);
  EXPECT_EQ(state(), Health::kOk);
}

TEST_F(RestHealthTest, OfSeveralTheWorstIsTheState) {
  const auto stuck_z = [](std::uint64_t n) {
    auto rates = moving(n);
    rates[2] = 0.0;
    return rates;
  };
  judge();
  rest_.mean_radps.fill(0.1);
  blocks(20);
  EXPECT_EQ(judge(1).state, Health::kDrifting);
  rest_.deviation_radps[0] = 0.02;
  blocks(60);
  watch_.lose(50);
  EXPECT_EQ(judge(1).axis[0].state, Health::kNoisy);
  EXPECT_EQ(judge(1).axis[1].state, Health::kDrifting);
  send_s(1.5, stuck_z);
  EXPECT_EQ(judge(1).axis[2].state, Health::kStuck);
  EXPECT_EQ(judge(1).state, Health::kStuck);
  now_s_ += 2.0;
  EXPECT_EQ(judge(1).axis[0].state, Health::kSilent);
  EXPECT_EQ(judge(1).state, Health::kSilent);
}

}  // namespace
}  // namespace gyrod::stream
