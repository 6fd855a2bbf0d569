#include "files/output_file.hpp"

#include <filesystem>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/file_error.hpp"
#include "support/scratch_folder.hpp"

namespace gyrod::files {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

class OutputFileTest : public ::testing::Test {
 protected:
  void write(const std::string& path, const std::string& text) {
    OutputFile file(path);
    file.write(text);
    file.close();
  }

  gyrod::testing::ScratchFolder scratch_;
};

TEST_F(OutputFileTest, IsThereInFullAfterClose) {
  write(scratch_.path("a"), "text");
  EXPECT_EQ(scratch_.read("a"), "text");
  EXPECT_EQ(scratch_.files(), 1U) << "nothing is left beside it";
}

TEST_F(OutputFileTest, OldFileStaysUntilClose) {
  scratch_.write("a", "old");
  OutputFile file(scratch_.path("a"));
  file.write("new");
  EXPECT_EQ(scratch_.read("a"), "old");
  file.close();
  EXPECT_EQ(scratch_.read("a"), "new");
}

TEST_F(OutputFileTest, WithoutCloseTheOldFileStaysAndNothingElse) {
  scratch_.write("a", "old");
  { OutputFile(scratch_.path("a")).write("new"); }
  { OutputFile(scratch_.path("b")).write("new"); }
  EXPECT_EQ(scratch_.read("a"), "old");
  EXPECT_EQ(scratch_.files(), 1U);
}

TEST_F(OutputFileTest, NameEndingInGzIsCompressed) {
  write(scratch_.path("a.gz"), std::string(10'000, 'x'));
  EXPECT_THAT(scratch_.read("a.gz"), StartsWith("\x1f\x8b"));
  EXPECT_LT(scratch_.read("a.gz").size(), 1000U);
}

TEST_F(OutputFileTest, UnwritableTargetFailsAtOnce) {
  EXPECT_THAT(
      [&] { OutputFile(scratch_.path("none/a")); },
      ThrowsMessage<FileError>(AllOf(HasSubstr("none/a: cannot be written"), HasSubstr("No such file"))));
  EXPECT_THAT([&] { OutputFile(scratch_.path("")); }, ThrowsMessage<FileError>(HasSubstr("directory")));
}

TEST_F(OutputFileTest, WriteProtectedTargetIsRespected) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write every file";
  const auto path = scratch_.write("a", "old");
  ::chmod(path.c_str(), 0444);
  EXPECT_THAT([&] { OutputFile{path}; }, ThrowsMessage<FileError>(HasSubstr("Permission denied")));
}

TEST_F(OutputFileTest, FullDeviceIsReported) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_THAT([&] { write("/dev/full", "text"); },
              ThrowsMessage<FileError>(AllOf(HasSubstr("/dev/full"), HasSubstr("No space left"))));
}

TEST_F(OutputFileTest, FullDeviceIsReportedInTheMiddleOfALongText) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_THAT([&] { write("/dev/full", std::string(1'000'000, 'x')); },
              ThrowsMessage<FileError>(HasSubstr("No space left")));
}

TEST_F(OutputFileTest, DeviceIsWrittenToAndNotReplaced) {
  write("/dev/null", "text");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(OutputFileTest, LinkStaysALinkAndItsFileIsReplaced) {
  scratch_.write("a", "old");
  std::filesystem::create_symlink("a", scratch_.path("link"));
  write(scratch_.path("link"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(scratch_.path("link")));
  EXPECT_EQ(scratch_.read("a"), "new");
}

}  // namespace
}  // namespace gyrod::files
