#include "files/recording_header.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/file_error.hpp"

namespace gyrod::files {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::Optional;
using ::testing::ThrowsMessage;

RecordingHeader recognise(std::string_view text) { return recognise_columns(text, "a.csv", false); }

TEST(RecordingHeader, FindsRatesUnitTimeAndSequence) {
  const auto header = recognise("timestamp_s,sample,gyro_x_dps,gyro_y_dps,gyro_z_dps,temp_c");
  EXPECT_EQ(header.columns, 6U);
  EXPECT_EQ(header.unit, RateUnit::kDps);
  EXPECT_THAT(header.gyro, ElementsAre(Optional(2U), Optional(3U), Optional(4U)));
  EXPECT_THAT(header.time, Optional(0U));
  EXPECT_EQ(header.time_exponent, 9);
  EXPECT_THAT(header.sequence, Optional(1U));
}

TEST(RecordingHeader, OrderOfTheAxesIsFree) {
  EXPECT_THAT(recognise("gyro_z_radps,gyro_x_radps,gyro_y_radps").gyro,
              ElementsAre(Optional(1U), Optional(2U), Optional(0U)));
}

TEST(RecordingHeader, CaseBlanksAndQuotesDoNotMatter) {
  const auto header = recognise(R"( Gyro_X_DPS ,"GYRO_Y_dps", "gyro_z_dps " , Stamp_NS)");
  EXPECT_THAT(header.gyro, ElementsAre(Optional(0U), Optional(1U), Optional(2U)));
  EXPECT_THAT(header.time, Optional(3U));
}

TEST(RecordingHeader, SemicolonsAndTabsSeparateToo) {
  EXPECT_EQ(recognise("gyro_x_dps;gyro_y_dps;gyro_z_dps").separator, ';');
  EXPECT_EQ(recognise("gyro_x_dps\tgyro_y_dps\tgyro_z_dps").separator, '\t');
}

TEST(RecordingHeader, FinestOfSeveralTimesIsTaken) {
  const auto header = recognise("time_s,stamp_us,stamp_ns,gyro_x_dps,gyro_y_dps,gyro_z_dps");
  EXPECT_THAT(header.time, Optional(2U));
  EXPECT_EQ(header.time_exponent, 0);
}

TEST(RecordingHeader, EveryTimeUnitIsKnown) {
  const std::string rates = ",gyro_x_dps,gyro_y_dps,gyro_z_dps";
  EXPECT_EQ(recognise("timestamp_ns" + rates).time_exponent, 0);
  EXPECT_EQ(recognise("timestamp_us" + rates).time_exponent, 3);
  EXPECT_EQ(recognise("timestamp_ms" + rates).time_exponent, 6);
  EXPECT_EQ(recognise("time_s" + rates).time_exponent, 9);
}

TEST(RecordingHeader, DeviceTimeAndOtherGyrosPassThrough) {
  const auto header = recognise("device_ms,ref_gyro_x_dps,gyro_x_dps,gyro_x_raw,gyro_y_dps,gyro_z_dps");
  EXPECT_FALSE(header.time.has_value());
  EXPECT_THAT(header.gyro[0], Optional(2U));
}

TEST(RecordingHeader, UnknownUnitIsNamedWithTheKnownOnes) {
  EXPECT_THAT(
      [] { static_cast<void>(recognise("gyro_x_foo,gyro_y_foo,gyro_z_foo")); },
      ThrowsMessage<FileError>(AllOf(HasSubstr("a.csv:1"), HasSubstr("\"gyro_x_foo\""), HasSubstr("\"foo\""),
                                     HasSubstr("radps, mradps, dps, mdps, dph"))));
}

TEST(RecordingHeader, MissingUnitIsNamed) {
  EXPECT_THAT([] { static_cast<void>(recognise("gyro_x,gyro_y,gyro_z")); },
              ThrowsMessage<FileError>(AllOf(HasSubstr("\"gyro_x\""), HasSubstr("no unit"))));
}

TEST(RecordingHeader, WithoutAnyRateTheColumnsFoundAreListed) {
  EXPECT_THAT([] { static_cast<void>(recognise("time_s,accel_x_g")); },
              ThrowsMessage<FileError>(
                  AllOf(HasSubstr("a.csv"), HasSubstr("time_s, accel_x_g"), HasSubstr("gyro_x_"))));
}

TEST(RecordingHeader, MissingAxisIsAnErrorThatNamesTheColumn) {
  EXPECT_THAT([] { static_cast<void>(recognise("gyro_x_dps,gyro_y_dps,gyro_zz_dps")); },
              ThrowsMessage<FileError>(HasSubstr("expected gyro_z_dps")));
}

TEST(RecordingHeader, MissingAxisIsTakenWhereAllowed) {
  const auto header = recognise_columns("gyro_z_dps", "a.csv", true);
  EXPECT_FALSE(header.gyro[0].has_value());
  EXPECT_THAT(header.gyro[2], Optional(0U));
}

TEST(RecordingHeader, MixedUnitsAreAnError) {
  EXPECT_THAT([] { static_cast<void>(recognise("gyro_x_dps,gyro_y_radps,gyro_z_dps")); },
              ThrowsMessage<FileError>(AllOf(HasSubstr("gyro_y_radps"), HasSubstr("one unit for all axes"))));
}

TEST(RecordingHeader, TwoColumnsForOneAxisAreAnError) {
  EXPECT_THAT([] { static_cast<void>(recognise("gyro_x_dps,gyro_x_radps,gyro_y_dps,gyro_z_dps")); },
              ThrowsMessage<FileError>(HasSubstr("two columns for one axis")));
}

TEST(RecordingHeader, BinaryFileIsNoHeader) {
  EXPECT_THAT([] { static_cast<void>(recognise(std::string_view("g\0y\0", 4))); },
              ThrowsMessage<FileError>(HasSubstr("expected a header line")));
}

}  // namespace
}  // namespace gyrod::files
