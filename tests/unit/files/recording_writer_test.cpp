#include "files/recording_writer.hpp"

#include <array>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/file_error.hpp"
#include "files/recording_reader.hpp"
#include "support/scratch_folder.hpp"

namespace gyrod::files {
namespace {

TEST(RecordingWriter, ReplacesTheRatesAndNothingElse) {
  const gyrod::testing::ScratchFolder scratch;
  const auto header = recognise_columns("\"Note\",gyro_z_radps, gyro_x_radps,gyro_y_radps,T", "in", false);
  RecordingWriter writer(scratch.path("out.csv"), header);
  writer.write("\"a,\"\"b\"\"\",9, 9,9, 007.50", {1.5, -0.25, 0.1});
  writer.close();
  EXPECT_EQ(scratch.read("out.csv"),
            "\"Note\",gyro_z_radps, gyro_x_radps,gyro_y_radps,T\n\"a,\"\"b\"\"\",0.1,1.5,-0.25, 007.50\n");
  EXPECT_EQ(writer.rows(), 1U);
}

TEST(RecordingWriter, KeepsUnitSeparatorAndMissingAxes) {
  const gyrod::testing::ScratchFolder scratch;
  const auto header = recognise_columns("t;gyro_z_mradps", "in", true);
  RecordingWriter writer(scratch.path("out.csv"), header);
  writer.write("7;0", {1.0, 1.0, 0.25});
  writer.close();
  EXPECT_EQ(scratch.read("out.csv"), "t;gyro_z_mradps\n7;250\n");
}

TEST(RecordingWriter, AddsDeviationsInTheRatesUnitAndNoneToARefusedRow) {
  const gyrod::testing::ScratchFolder scratch;
  RecordingWriter writer(scratch.path("out.csv"),
                         recognise_columns("t;gyro_z_mradps;gyro_x_mradps", "in", true), true);
  writer.write("7;0;0", {1.0, 9.0, 0.25}, {0.5, 9.0, 0.125});
  writer.write_unchanged("8;nan;1");
  writer.close();
  EXPECT_EQ(scratch.read("out.csv"),
            "t;gyro_z_mradps;gyro_x_mradps;gyro_std_x_mradps;gyro_std_z_mradps\n"
            "7;250;1000;500;125\n8;nan;1;;\n");
}

TEST(RecordingWriter, DoesNotAddDeviationsWhereThereAreSome) {
  const gyrod::testing::ScratchFolder scratch;
  const auto header = recognise_columns("gyro_x_dps,gyro_std_x_dps", "in", true);
  EXPECT_THROW(RecordingWriter(scratch.path("out.csv"), header, true), FileError);
  EXPECT_NO_THROW(RecordingWriter(scratch.path("out.csv"), header));
}

TEST(RecordingWriter, NotFiniteRatesAreWrittenAsWords) {
  const gyrod::testing::ScratchFolder scratch;
  RecordingWriter writer(scratch.path("out.csv"),
                         recognise_columns("gyro_x_dps,gyro_y_dps,gyro_z_dps", "in", false));
  writer.write("1,2,3",
               {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 0.0});
  writer.close();
  EXPECT_EQ(scratch.read("out.csv"), "gyro_x_dps,gyro_y_dps,gyro_z_dps\nnan,inf,0\n");
}

TEST(RecordingWriter, RatesReadBackBitForBitThroughGzip) {
  const gyrod::testing::ScratchFolder scratch;
  const auto header = recognise_columns("gyro_x_radps,gyro_y_radps,gyro_z_radps", "in", false);
  std::mt19937_64 bits(2);
  std::vector<std::array<double, 3>> rates(1000);
  RecordingWriter writer(scratch.path("out.csv.gz"), header);
  for (auto& rate : rates) {
    for (auto& value : rate) value = static_cast<double>(bits()) * 0x1p-64 - 0.5;
    writer.write("0,0,0", rate);
  }
  writer.close();
  RecordingReader reader(scratch.path("out.csv.gz"));
  RecordingRow row;
  for (const auto& rate : rates) {
    ASSERT_TRUE(reader.next(row));
    ASSERT_EQ(row.sample.rate_radps, rate);
  }
  EXPECT_FALSE(reader.next(row));
}

}  // namespace
}  // namespace gyrod::files
