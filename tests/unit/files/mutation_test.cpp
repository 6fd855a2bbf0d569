/// Property: whatever the bytes, the reader gives rows or throws FileError; nothing else, no crash (run under
/// asan too).
#include <cstddef>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "files/file_error.hpp"
#include "files/recording_reader.hpp"
#include "support/scratch_folder.hpp"
#include "unit/files/gzip_file.hpp"

namespace gyrod::files {
namespace {

constexpr int kRounds = 2000;

const std::string kRecording =
    "sample,timestamp_s,gyro_x_dps,gyro_y_dps,gyro_z_dps,note\n"
    "0,0.00,1.5,-2.25,nan,\"a,b\"\n1,0.01,,inf,1e-3,x\n2,0.02,3,4,5,y\n";

/// One to four bytes changed, taken out or put in.
std::string mutate(std::string text, std::mt19937_64& random) {
  static const std::string kBytes = ",;\t\"\n\r \0eE+-.0919xn\xff";
  for (auto edits = 1 + random() % 4; edits > 0 && !text.empty(); --edits) {
    const std::size_t at = random() % text.size();
    const char byte = kBytes[random() % kBytes.size()];
    const auto kind = random() % 3;
    if (kind == 0) text[at] = byte;
    if (kind == 1) text.erase(at, 1 + random() % 8);
    if (kind == 2) text.insert(at, 1, byte);
  }
  return text;
}

/// @return rows and broken rows of the file, 0 if it was refused
std::uint64_t read_all(const std::string& path, bool skip_broken_rows) {
  try {
    RecordingReader reader(path, {.skip_broken_rows = skip_broken_rows});
    RecordingRow row;
    while (reader.next(row)) {
    }
    return reader.rows() + reader.broken_rows();
  } catch (const FileError&) {
    return 0;
  }
}

TEST(Mutation, MutatedTextGivesRowsOrAFileError) {
  const gyrod::testing::ScratchFolder scratch;
  std::mt19937_64 random(3);
  std::uint64_t rows = 0;
  for (int round = 0; round < kRounds; ++round) {
    const auto path = scratch.write("in.csv", mutate(kRecording, random));
    rows += read_all(path, round % 2 == 0);
  }
  // Nearly half of the bytes are the header's, so most files are refused whole; of the others, half stop at
  // the first broken row and half count all three. 1326 rows with this seed; none would mean that nothing
  // was parsed.
  EXPECT_GT(rows, static_cast<std::uint64_t>(kRounds) / 2);
}

TEST(Mutation, MutatedGzipGivesRowsOrAFileError) {
  const gyrod::testing::ScratchFolder scratch;
  gyrod::testing::write_gzip(scratch, "whole.gz", kRecording);
  const auto whole = scratch.read("whole.gz");
  std::mt19937_64 random(4);
  for (int round = 0; round < kRounds; ++round) {
    read_all(scratch.write("in.gz", mutate(whole, random)), true);
  }
}

}  // namespace
}  // namespace gyrod::files
