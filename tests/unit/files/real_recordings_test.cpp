/// The recordings of GYROD_DATA (default: ../shared/data beside the project), skipped where they are absent.
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "files/file_error.hpp"
#include "files/recording_reader.hpp"
#include "support/data_folder.hpp"

namespace gyrod::files {
namespace {

namespace fs = std::filesystem;

std::uint64_t count_rows(const fs::path& path) {
  RecordingReader reader(path.string());
  RecordingRow row;
  while (reader.next(row)) {
  }
  return reader.rows();
}

TEST(RealRecordings, EveryGyroRecordingReadsToItsEnd) {
  if (!fs::is_directory(test::data_folder())) GTEST_SKIP() << "no recordings in " << test::data_folder();
  for (const auto& entry : fs::directory_iterator(test::data_folder())) {
    if (entry.path().extension() != ".gz") continue;
    EXPECT_GT(count_rows(entry.path()), 10'000U) << entry.path();
  }
}

TEST(RealRecordings, AdisRecordingHasItsMillionRows) {
  const auto path = test::data_folder() / "adis16405_imu1_static_100hz.csv.gz";
  if (!fs::exists(path)) GTEST_SKIP() << "no recording " << path;
  EXPECT_EQ(count_rows(path), 1'000'000U);  // the data folder's README
}

TEST(RealRecordings, GnssPositionsAreRefusedAsNoGyro) {
  const auto path = test::data_folder() / "drive0708_gnss_rtk_4hz.csv";
  if (!fs::exists(path)) GTEST_SKIP() << "no recording " << path;
  EXPECT_THROW(RecordingReader{path.string()}, FileError);
}

}  // namespace
}  // namespace gyrod::files
