#include "files/record.hpp"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/file_error.hpp"
#include "support/scratch_folder.hpp"

namespace gyrod::files {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Key;
using ::testing::ThrowsMessage;

constexpr const char* kHeader = "sample,gyro_x_radps,gyro_y_radps,gyro_z_radps,Accel_X_g,note\n";

/// Rows that count up: x = the sample's number.
std::string rows(std::uint64_t from, std::uint64_t to, const std::string& rest = ",0,0,1,a\n") {
  std::string text;
  for (std::uint64_t n = from; n < to; ++n) text += std::to_string(n) + "," + std::to_string(n) + rest;
  return text;
}

class RecordTest : public ::testing::Test {
 protected:
  Record load(const std::string& text, const RecordOptions& options = at_100_hz()) {
    return load_record(scratch_.write("in.csv", text), options);
  }
  static RecordOptions at_100_hz() {
    RecordOptions options;
    options.sample_rate_hz = 100.0;
    options.max_rate_radps = 1e9;
    options.other_columns = true;
    return options;
  }

  gyrod::testing::ScratchFolder scratch_;
};

TEST_F(RecordTest, HoldsRatesTimesAndOtherColumnsThatAreNumbers) {
  const Record record = load(std::string(kHeader) + "0,0.1,0.2,0.3,1.5,a\n1,0.4,0.5,0.6,,b\n");
  ASSERT_EQ(record.size(), 2U);
  EXPECT_THAT(record.gyro_radps[0], ElementsAre(0.1, 0.4));
  EXPECT_THAT(record.gyro_radps[2], ElementsAre(0.3, 0.6));
  EXPECT_THAT(record.time_s, ElementsAre(0.0, 0.01));
  EXPECT_THAT(record.others, ElementsAre(Key("accel_x_g"))) << "a note is no number, names are in lower case";
  EXPECT_EQ(record.others.at("accel_x_g")[0], 1.5);
  EXPECT_TRUE(std::isnan(record.others.at("accel_x_g")[1]));
  EXPECT_TRUE(record.bridged.empty());
}

TEST_F(RecordTest, LeavesOtherColumnsOutUnlessAskedFor) {
  RecordOptions options = at_100_hz();
  options.other_columns = false;
  EXPECT_TRUE(load(kHeader + rows(0, 3), options).others.empty());
}

TEST_F(RecordTest, BridgesAShortGapAndARefusedSampleByLines) {
  const Record record = load(kHeader + rows(0, 3) + "3,nan,0,0,1,a\n" + rows(6, 8));
  EXPECT_THAT(record.gyro_radps[0], ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_EQ(record.counts.bridged, 3U);
  EXPECT_THAT(record.bridged, ElementsAre(0, 0, 0, 1, 1, 1, 0, 0));
  EXPECT_EQ(record.counts.refused, 1U);
  EXPECT_EQ(record.counts.missing, 2U);
  EXPECT_EQ(record.counts.gaps, 0U);
  EXPECT_TRUE(std::isnan(record.others.at("accel_x_g")[4])) << "nothing was measured there";
  EXPECT_NEAR(record.time_s[4], 0.04, 1e-9);
}

TEST_F(RecordTest, KeepsTheLongestStretchAndCountsWhatItLeavesOut) {
  const Record record = load(kHeader + rows(0, 5) + rows(100, 120) + rows(200, 207));
  EXPECT_EQ(record.size(), 20U);
  EXPECT_EQ(record.gyro_radps[0].front(), 100.0);
  EXPECT_DOUBLE_EQ(record.first_stamp_s, 1.0);
  EXPECT_EQ(record.time_s.front(), 0.0);
  EXPECT_EQ(record.counts.gaps, 2U);
  EXPECT_EQ(record.counts.left_out, 12U);
  EXPECT_EQ(record.counts.rows, 32U);
}

TEST_F(RecordTest, TakesTheMeanRateOfTheStamps) {
  RecordOptions options;
  const Record record =
      load("timestamp_s,gyro_x_dps,gyro_y_dps,gyro_z_dps\n5.0,1,1,1\n5.1,1,1,1\n5.3,1,1,1\n", options);
  EXPECT_DOUBLE_EQ(record.sample_rate_hz, 2.0 / 0.3) << "2 intervals in 0.3 s";
  EXPECT_FALSE(record.rate_given);
  EXPECT_DOUBLE_EQ(record.first_stamp_s, 5.0);
}

TEST_F(RecordTest, TakesTheGivenRateWhateverTheStampsSay) {
  RecordOptions options;
  options.sample_rate_hz = 50.0;
  const Record record =
      load("timestamp_s,gyro_x_dps,gyro_y_dps,gyro_z_dps\n0,1,1,1\n0.1,1,1,1\n0.2,1,1,1\n", options);
  EXPECT_EQ(record.sample_rate_hz, 50.0);
  EXPECT_TRUE(record.rate_given);
  EXPECT_EQ(record.counts.missing, 0U);
}

TEST_F(RecordTest, AsksForARateWhereThereIsNeitherTimeNorRate) {
  EXPECT_THAT(
      [&] { load(kHeader + rows(0, 3), {}); },
      ThrowsMessage<FileError>(AllOf(HasSubstr("in.csv"), HasSubstr("no time column"), HasSubstr("--rate"))));
}

TEST_F(RecordTest, AssumesARateOnlyWhereThereIsNeitherTimeNorRate) {
  RecordOptions options;
  options.assumed_rate_hz = 50.0;
  const Record assumed = load(kHeader + rows(0, 3), options);
  EXPECT_TRUE(assumed.rate_assumed);
  EXPECT_FALSE(assumed.rate_given);
  EXPECT_EQ(assumed.sample_rate_hz, 50.0);
  EXPECT_DOUBLE_EQ(assumed.time_s[2], 0.04);

  const Record stamped = load("timestamp_s,gyro_x_dps,gyro_y_dps,gyro_z_dps\n0,1,1,1\n0.1,1,1,1\n", options);
  EXPECT_FALSE(stamped.rate_assumed);
  EXPECT_DOUBLE_EQ(stamped.sample_rate_hz, 10.0);

  options.sample_rate_hz = 20.0;
  const Record given = load(kHeader + rows(0, 3), options);
  EXPECT_FALSE(given.rate_assumed);
  EXPECT_TRUE(given.rate_given);
  EXPECT_DOUBLE_EQ(given.time_s[2], 0.1);
}

TEST_F(RecordTest, SaysSoWhereNoSampleIsGood) {
  EXPECT_THAT([&] { load(std::string(kHeader) + "0,nan,0,0,1,a\n1,nan,0,0,1,a\n"); },
              ThrowsMessage<FileError>(AllOf(HasSubstr("none of its 2 samples"), HasSubstr("in.csv"))));
}

TEST_F(RecordTest, SaysSoWhereTheStampsDoNotGoOn) {
  EXPECT_THAT([&] { load("timestamp_s,gyro_x_dps,gyro_y_dps,gyro_z_dps\n1,1,1,1\n1,1,1,1\n1,1,1,1\n", {}); },
              ThrowsMessage<FileError>(HasSubstr("only 1 of its 3 samples")));
}

TEST_F(RecordTest, AnAbsentAxisStaysEmpty) {
  RecordOptions options;
  options.reader.allow_missing_axes = true;
  const Record record = load("timestamp_s,gyro_z_dps\n0,1\n0.01,2\n", options);
  EXPECT_TRUE(record.gyro_radps[0].empty());
  EXPECT_EQ(record.gyro_radps[2].size(), 2U);
}

TEST_F(RecordTest, StopsWhenAskedTo) {
  RecordOptions options = at_100_hz();
  std::uint64_t calls = 0;
  options.progress = [&calls](std::optional<double> fraction, std::uint64_t) {
    EXPECT_LE(fraction.value_or(0.0), 1.0);
    return ++calls < 2;
  };
  EXPECT_THROW(load(kHeader + rows(0, 20000), options), Stopped);
  EXPECT_EQ(calls, 2U);
}

}  // namespace
}  // namespace gyrod::files
