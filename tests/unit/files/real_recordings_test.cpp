/// The recordings of GYROD_DATA (default: ../shared/data beside the project), skipped where they are absent.
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "files/file_error.hpp"
#include "files/recording_reader.hpp"

namespace gyrod::files {
namespace {

namespace fs = std::filesystem;

fs::path data_folder() {
  if (const char* data = std::getenv("GYROD_DATA")) return data;
  const char* source = std::getenv("GYROD_SOURCE_DIR");
  return fs::path(source != nullptr ? source : ".") / "../shared/data";
}

std::uint64_t count_rows(const fs::path& path) {
  RecordingReader reader(path.string());
  RecordingRow row;
  while (reader.next(row)) {
  }
  return reader.rows();
}

TEST(RealRecordings, EveryGyroRecordingReadsToItsEnd) {
  if (!fs::is_directory(data_folder())) GTEST_SKIP() << "no recordings in " << data_folder();
  for (const auto& entry : fs::directory_iterator(data_folder())) {
    if (entry.path().extension() != ".gz") continue;
    EXPECT_GT(count_rows(entry.path()), 10'000U) << entry.path();
  }
}

TEST(RealRecordings, AdisRecordingHasItsMillionRows) {
  const auto path = data_folder() / "adis16405_imu1_static_100hz.csv.gz";
  if (!fs::exists(path)) GTEST_SKIP() << "no recording " << path;
  EXPECT_EQ(count_rows(path), 1'000'000U);  // the data folder's README
}

TEST(RealRecordings, GnssPositionsAreRefusedAsNoGyro) {
  const auto path = data_folder() / "drive0708_gnss_rtk_4hz.csv";
  if (!fs::exists(path)) GTEST_SKIP() << "no recording " << path;
  EXPECT_THROW(RecordingReader{path.string()}, FileError);
}

}  // namespace
}  // namespace gyrod::files
