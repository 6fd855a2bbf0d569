#include "files/recording_reader.hpp"

#include <cmath>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/file_error.hpp"
#include "support/scratch_folder.hpp"
#include "unit/files/gzip_file.hpp"

namespace gyrod::files {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr const char* kHeader = "stamp_ns,gyro_x_radps,gyro_y_radps,gyro_z_radps,note\n";

class RecordingReaderTest : public ::testing::Test {
 protected:
  /// All rows of a file that holds `text`.
  std::vector<RecordingRow> read(std::string_view text, const ReaderOptions& options = {}) {
    return read_file(scratch_.write("in.csv", text), options);
  }

  static std::vector<RecordingRow> read_file(const std::string& path, const ReaderOptions& options = {}) {
    RecordingReader reader(path, options);
    std::vector<RecordingRow> rows;
    RecordingRow row;
    while (reader.next(row)) rows.push_back(row);
    return rows;
  }

  gyrod::testing::ScratchFolder scratch_;
};

TEST_F(RecordingReaderTest, GivesSampleLineAndText) {
  const auto rows = read(std::string(kHeader) + "1000,0.1,-0.2,3,hello\n");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].sample.stamp_ns, 1000);
  EXPECT_EQ(rows[0].sample.sequence, 0U);
  EXPECT_THAT(rows[0].sample.rate_radps, ElementsAre(0.1, -0.2, 3.0));
  EXPECT_EQ(rows[0].line, 2U);
  EXPECT_EQ(rows[0].text, "1000,0.1,-0.2,3,hello");
}

TEST_F(RecordingReaderTest, ConvertsToRadiansPerSecond) {
  const auto rows = read("gyro_x_dps,gyro_y_dps,gyro_z_dps\n180,0,-90\n");
  EXPECT_DOUBLE_EQ(rows.at(0).sample.rate_radps[0], 3.141592653589793);
  EXPECT_DOUBLE_EQ(rows.at(0).sample.rate_radps[2], -1.5707963267948966);
}

TEST_F(RecordingReaderTest, ReadsTheAccelerometerInItsUnitWhereAskedTo) {
  const std::string text =
      "gyro_x_radps,gyro_y_radps,gyro_z_radps,Accel_Y_mg,accel_x_mg,accel_z_mg\n1,2,3,10,,1000\n1,2,3,a,0,"
      "0\n";
  const ReaderOptions options{.accelerometer = true, .skip_broken_rows = true};
  const auto rows = read(text, options);
  ASSERT_EQ(rows.size(), 1U) << "a text is no number";
  const auto& force = rows[0].sample.specific_force_mps2;
  ASSERT_TRUE(force);
  EXPECT_TRUE(std::isnan((*force)[0]));
  EXPECT_DOUBLE_EQ((*force)[1], 0.0980665);
  EXPECT_DOUBLE_EQ((*force)[2], 9.80665);
  EXPECT_EQ(read(text).size(), 2U);
  EXPECT_FALSE(read(text)[0].sample.specific_force_mps2) << "nobody asked";
  EXPECT_THAT(
      [&] { read(std::string(kHeader) + "1,2,3,4,5\n", options); },
      ThrowsMessage<FileError>(HasSubstr("in.csv: no accelerometer; expected the columns accel_x_UNIT")));
}

TEST_F(RecordingReaderTest, WithoutTimeStampsFollowTheSequenceAndTheNominalRate) {
  const auto rows =
      read("sample,gyro_x_dps,gyro_y_dps,gyro_z_dps\n5,0,0,0\n7,0,0,0\n", {.nominal_rate_hz = 200.0});
  EXPECT_EQ(rows.at(0).sample.sequence, 5U);
  EXPECT_EQ(rows.at(0).sample.stamp_ns, 25'000'000);
  EXPECT_EQ(rows.at(1).sample.stamp_ns, 35'000'000);
}

TEST_F(RecordingReaderTest, TellsThatStampsAreMadeUp) {
  EXPECT_TRUE(
      RecordingReader(scratch_.write("a.csv", "gyro_x_dps,gyro_y_dps,gyro_z_dps\n")).stamps_made_up());
  EXPECT_FALSE(RecordingReader(scratch_.write("b.csv", kHeader)).stamps_made_up());
}

TEST_F(RecordingReaderTest, WithoutSequenceRowsAreNumberedFromZero) {
  const auto rows = read(std::string(kHeader) + "1,0,0,0,\n2,0,0,0,\n");
  EXPECT_EQ(rows.at(0).sample.sequence, 0U);
  EXPECT_EQ(rows.at(1).sample.sequence, 1U);
}

TEST_F(RecordingReaderTest, EmptyNanAndInfRatesAreValues) {
  const auto rows = read(std::string(kHeader) + "1,,nan,-inf,\n");
  EXPECT_TRUE(std::isnan(rows.at(0).sample.rate_radps[0]));
  EXPECT_TRUE(std::isnan(rows.at(0).sample.rate_radps[1]));
  EXPECT_TRUE(std::isinf(rows.at(0).sample.rate_radps[2]));
}

TEST_F(RecordingReaderTest, AllowedMissingAxisReadsZero) {
  const auto rows = read("gyro_z_radps\n1\n", {.allow_missing_axes = true});
  EXPECT_THAT(rows.at(0).sample.rate_radps, ElementsAre(0.0, 0.0, 1.0));
}

TEST_F(RecordingReaderTest, ByteOrderMarkCrLfBlankLinesAndMissingLastLineEndAreFine) {
  const auto rows = read("\xEF\xBB\xBFgyro_x_dps,gyro_y_dps,gyro_z_dps\r\n1,2,3\r\n\r\n4,5,6\r\n  \n7,8,9");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].text, "1,2,3");
  EXPECT_EQ(rows[1].line, 4U);
  EXPECT_EQ(rows[2].text, "7,8,9");
}

TEST_F(RecordingReaderTest, QuotedAndPaddedCellsAndOtherSeparatorsAreFine) {
  EXPECT_EQ(read(std::string(kHeader) + "\"1\", 2 ,\"3\",4,\"a,b\"\n").at(0).sample.rate_radps[1], 3.0);
  EXPECT_EQ(read("gyro_x_radps;gyro_y_radps;gyro_z_radps\n1;2;3\n").at(0).sample.rate_radps[2], 3.0);
}

TEST_F(RecordingReaderTest, GzipIsToldByContentNotByName) {
  const std::string text = std::string(kHeader) + "1,1,2,3,\n";
  EXPECT_EQ(read_file(gyrod::testing::write_gzip(scratch_, "zipped.csv", text)).size(), 1U);
  EXPECT_EQ(read_file(scratch_.write("plain.csv.gz", text)).size(), 1U);
}

TEST_F(RecordingReaderTest, LinesAcrossTheBufferAreWhole) {
  // 4 MB in rows of uneven length, read through a buffer of 256 KiB.
  constexpr int kRows = 100'000;
  std::string text = kHeader;
  for (int i = 0; i < kRows; ++i)
    text += std::to_string(i) + ",1,2,3," + std::string(static_cast<std::size_t>(i % 60), 'x') + "\n";
  const auto rows = read(text);
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(kRows));
  for (int i = 0; i < kRows; ++i) ASSERT_EQ(rows[static_cast<std::size_t>(i)].sample.stamp_ns, i);
}

TEST_F(RecordingReaderTest, LineLongerThanTheBufferIsReadUpToTheLimit) {
  const std::string row = "1,1,2,3,";
  EXPECT_EQ(read(kHeader + row + std::string(500'000, 'x') + "\n").size(), 1U);
  EXPECT_THAT([&] { read(kHeader + row + std::string(2 * LineReader::kLongestLine, 'x')); },
              ThrowsMessage<FileError>(HasSubstr("in.csv:2: line is longer than")));
}

TEST_F(RecordingReaderTest, BrokenNumberIsNamedWithFileLineColumnAndText) {
  EXPECT_THAT([&] { read(std::string(kHeader) + "1,0,0,0,\n2,0,abc,0,\n"); },
              ThrowsMessage<FileError>(AllOf(HasSubstr("in.csv:3:"), HasSubstr("\"gyro_y_radps\""),
                                             HasSubstr("\"abc\""), HasSubstr("expected a number"))));
}

TEST_F(RecordingReaderTest, WrongNumberOfCellsIsNamed) {
  EXPECT_THAT([&] { read(std::string(kHeader) + "1,0,0\n"); },
              ThrowsMessage<FileError>(
                  AllOf(HasSubstr("in.csv:2:"), HasSubstr("expected 5 cells"), HasSubstr("found 3"))));
  EXPECT_THAT([&] { read(std::string(kHeader) + "1,0,0,0,a,b\n"); },
              ThrowsMessage<FileError>(HasSubstr("found 6")));
}

TEST_F(RecordingReaderTest, BrokenTimeSequenceAndQuoteAreNamed) {
  EXPECT_THAT([&] { read(std::string(kHeader) + "noon,0,0,0,\n"); },
              ThrowsMessage<FileError>(HasSubstr("\"noon\"")));
  EXPECT_THAT([&] { read("sample,gyro_x_dps,gyro_y_dps,gyro_z_dps\n-1,0,0,0\n"); },
              ThrowsMessage<FileError>(AllOf(HasSubstr("\"sample\""), HasSubstr("\"-1\""))));
  EXPECT_THAT([&] { read(std::string(kHeader) + "1,0,0,0,\"open\n"); },
              ThrowsMessage<FileError>(HasSubstr("does not end")));
}

TEST_F(RecordingReaderTest, SequenceTooLargeForAMadeUpStampIsABrokenRow) {
  EXPECT_THAT([&] { read("sample,gyro_x_dps,gyro_y_dps,gyro_z_dps\n18446744073709551615,0,0,0\n"); },
              ThrowsMessage<FileError>(HasSubstr("292 years")));
}

TEST_F(RecordingReaderTest, BrokenRowsAreCountedWhereTheyMayBeSkipped) {
  RecordingReader reader(scratch_.write("in.csv", std::string(kHeader) + "1,0,0,0,\nrubbish\n3,0,0,0,\n"),
                         {.skip_broken_rows = true});
  RecordingRow row;
  ASSERT_TRUE(reader.next(row));
  ASSERT_TRUE(reader.next(row));
  EXPECT_EQ(row.sample.sequence, 2U) << "the number of the skipped row stays free";
  EXPECT_FALSE(reader.next(row));
  EXPECT_EQ(reader.rows(), 2U);
  EXPECT_EQ(reader.broken_rows(), 1U);
}

TEST_F(RecordingReaderTest, EmptyFileHeaderOnlyAndAllBrokenAreToldApart) {
  EXPECT_THAT([&] { read(""); }, ThrowsMessage<FileError>(HasSubstr("is empty")));
  EXPECT_THAT([&] { read(kHeader); }, ThrowsMessage<FileError>(HasSubstr("no rows")));
  EXPECT_THAT([&] { read(std::string(kHeader) + "x\n", {.skip_broken_rows = true}); },
              ThrowsMessage<FileError>(HasSubstr("all rows are broken")));
}

TEST_F(RecordingReaderTest, MissingFileDirectoryAndUnreadableFileAreToldApart) {
  EXPECT_THAT([&] { read_file(scratch_.path("none.csv")); },
              ThrowsMessage<FileError>(AllOf(HasSubstr("none.csv"), HasSubstr("No such file"))));
  EXPECT_THAT([&] { read_file(scratch_.path("")); }, ThrowsMessage<FileError>(HasSubstr("is a directory")));
  if (::geteuid() == 0) GTEST_SKIP() << "root may read every file";
  const auto locked = scratch_.write("locked.csv", kHeader);
  ::chmod(locked.c_str(), 0);
  EXPECT_THAT([&] { read_file(locked); }, ThrowsMessage<FileError>(HasSubstr("Permission denied")));
}

class DamagedGzipTest : public RecordingReaderTest {
 protected:
  /// The gzip image of a recording of 20 000 rows, about 90 kB.
  std::string image() {
    std::string text = kHeader;
    for (int i = 0; i < 20'000; ++i) text += std::to_string(i * 7919 % 100'003) + ",1,2,3,\n";
    gyrod::testing::write_gzip(scratch_, "whole.gz", text);
    return scratch_.read("whole.gz");
  }
};

TEST_F(DamagedGzipTest, CutOffFileIsAnErrorWhereverTheCutIs) {
  const auto whole = image();
  for (const std::size_t size :
       {whole.size() - 1, whole.size() - 8, whole.size() / 2, std::size_t{100}, std::size_t{3}}) {
    EXPECT_THAT([&] { read_file(scratch_.write("cut.gz", whole.substr(0, size))); },
                ThrowsMessage<FileError>(AllOf(HasSubstr("cut.gz"), HasSubstr("cut off"))))
        << size;
  }
}

TEST_F(DamagedGzipTest, WrongCheckSumIsAnError) {
  auto damaged = image();
  damaged[damaged.size() - 6] ^= 1;  // in the check sum, 8 to 5 bytes before the end
  EXPECT_THAT([&] { read_file(scratch_.write("damaged.gz", damaged)); },
              ThrowsMessage<FileError>(AllOf(HasSubstr("damaged.gz"), HasSubstr("is damaged"))));
}

TEST_F(RecordingReaderTest, ProgressReachesOne) {
  RecordingReader reader(scratch_.write("in.csv", std::string(kHeader) + "1,0,0,0,\n"));
  RecordingRow row;
  while (reader.next(row)) {
  }
  EXPECT_EQ(reader.progress(), 1.0);
}

}  // namespace
}  // namespace gyrod::files
