/// Imu messages to samples and back, by the conventions of sensor_msgs/msg/Imu.
#include "bus/imu_wire.hpp"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "support/imu_message.hpp"

namespace gyrod::bus::test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using testing::imu_message;

stream::DenoisedSample denoised(double deviation) {
  stream::DenoisedSample sample;
  sample.rate_radps = {1.5, -2.5, 3.5};
  sample.rate_std_radps = {deviation, 2.0 * deviation, 0.5};
  sample.model_epoch = 1;
  return sample;
}

TEST(ImuWire, ASampleHasTheStampAndTheRatesAndNoNumber) {
  Imu message = imu_message(7, 1'700'000'000'123'456'789, {0.1, -0.2, 0.3}).fields;
  const stream::Sample sample = sample_of(message);
  EXPECT_EQ(sample.sequence, 0U);
  EXPECT_EQ(sample.stamp_ns, 1'700'000'000'123'456'789);
  EXPECT_THAT(sample.rate_radps, ElementsAre(0.1, -0.2, 0.3));
  message.header.stamp = {std::numeric_limits<std::int32_t>::min(), 999'999'999};
  EXPECT_EQ(sample_of(message).stamp_ns, -2'147'483'647'000'000'001) << "-2^31 s and 999 999 999 ns more";
  message.header.stamp = {std::numeric_limits<std::int32_t>::max(),
                          std::numeric_limits<std::uint32_t>::max()};
  EXPECT_EQ(sample_of(message).stamp_ns, 2'147'483'651'294'967'295)
      << "2^31 - 1 s and 2^32 - 1 ns more, no overflow";
}

TEST(ImuWire, LinearAccelerationIsTheSpecificForceUnlessTheMessageSaysThereIsNone) {
  Imu message = imu_message(70, 0, {}).fields;
  const auto force = sample_of(message).specific_force_mps2;
  ASSERT_TRUE(force.has_value());
  EXPECT_THAT(*force, ElementsAre(7.0, 9.81, -10.0)) << "as imu_message() makes it";
  message.linear_acceleration_covariance[0] = -1.0;
  EXPECT_FALSE(sample_of(message).specific_force_mps2.has_value());
}

TEST(ImuWire, ACovarianceThatBeginsWithMinusOneSaysThereAreNoRates) {
  Imu message = imu_message(1, 0, {0.1, 0.2, 0.3}).fields;
  ASSERT_EQ(message.orientation_covariance[0], -1.0) << "of another quantity: means nothing here";
  EXPECT_EQ(sample_of(message).rate_radps[0], 0.1);
  message.angular_velocity_covariance[0] = -1.0;
  for (const double rate : sample_of(message).rate_radps) EXPECT_TRUE(std::isnan(rate));
}

TEST(ImuWire, TheDiagonalHoldsTheDeviationsSquaredAndTheRestIsZero) {
  Imu message = imu_message(1, 0, {0.1, 0.2, 0.3}).fields;
  set_rates(message, denoised(0.25));
  EXPECT_EQ(message.angular_velocity.x, 1.5);
  EXPECT_EQ(message.angular_velocity.y, -2.5);
  EXPECT_EQ(message.angular_velocity.z, 3.5);
  EXPECT_THAT(message.angular_velocity_covariance,
              ElementsAre(0.0625, 0.0, 0.0, 0.0, 0.25, 0.0, 0.0, 0.0, 0.25));
}

TEST(ImuWire, AnUnknownDeviationMakesTheWholeCovarianceZero) {
  const auto covariance_of = [](const stream::DenoisedSample& sample) {
    Imu message = imu_message(1, 0, {}).fields;
    set_rates(message, sample);
    return std::vector<double>(std::begin(message.angular_velocity_covariance),
                               std::end(message.angular_velocity_covariance));
  };
  EXPECT_THAT(covariance_of(denoised(0.0)), Each(0.0)) << "z alone is known: a 0 beside it would say exact";
  EXPECT_THAT(covariance_of(denoised(std::nan(""))), Each(0.0));
  stream::DenoisedSample before_a_model = denoised(0.25);
  before_a_model.model_epoch = 0;
  EXPECT_THAT(covariance_of(before_a_model), Each(0.0));
}

TEST(ImuWire, WhatPassedThroughUndenoisedStaysAsItCame) {
  const testing::ImuMessage came = imu_message(1, 0, {0.1, 0.2, 0.3});
  Imu message = came.fields;
  stream::DenoisedSample sample = denoised(0.25);
  sample.flags = static_cast<std::uint32_t>(stream::SampleFlag::kPassThrough) |
                 static_cast<std::uint32_t>(stream::SampleFlag::kTail);
  set_rates(message, sample);
  EXPECT_EQ(message.angular_velocity.x, 0.1);
  EXPECT_THAT(message.angular_velocity_covariance,
              ::testing::ElementsAreArray(came.fields.angular_velocity_covariance));
}

}  // namespace
}  // namespace gyrod::bus::test
