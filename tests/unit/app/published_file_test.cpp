#include "app/published_file.hpp"

#include <csignal>
#include <filesystem>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/errors.hpp"
#include "support/scratch_folder.hpp"

namespace gyrod::app {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class PublishedFileTest : public ::testing::Test {
 protected:
  std::unique_ptr<PublishedFile> open(std::size_t sensors = 4) {
    return std::make_unique<PublishedFile>(path, sensors,
                                           [this](const std::string& line) { warnings.push_back(line); });
  }
  static stream::DenoisedSample sample(std::uint64_t n) {
    return {.sequence = n, .stamp_ns = 10 * static_cast<std::int64_t>(n)};
  }

  testing::ScratchFolder folder;
  std::string path = folder.path("published");
  std::vector<std::string> warnings;
};

TEST_F(PublishedFileTest, RemembersTheNewestSampleOfEverySensorOnce) {
  open()->note("front", sample(1));
  {
    const auto file = open();
    file->note("front", sample(7));
    file->note("rear", sample(9));
  }
  const auto file = open();
  EXPECT_EQ(file->remembered(), 2U);
  const auto front = file->take_before("front");
  ASSERT_TRUE(front);
  EXPECT_EQ(front->sequence, 7U);
  EXPECT_EQ(front->stamp_ns, 70);
  EXPECT_FALSE(file->take_before("front")) << "the second time it has been seen since";
  EXPECT_EQ(file->take_before("rear")->sequence, 9U);
  EXPECT_FALSE(file->take_before("side"));
  EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(PublishedFileTest, KeepsWhatWasNotedWhenTheProcessIsKilled) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const auto file = open();
    file->note("front", sample(41));
    file->note("front", sample(42));
    kill(getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(open()->take_before("front")->sequence, 42U);
}

TEST_F(PublishedFileTest, ForgetsASensorThatHasEnded) {
  {
    const auto file = open();
    file->note("front", sample(1));
    file->forget("front");
    file->forget("nobody");
  }
  EXPECT_EQ(open()->remembered(), 0U);
}

TEST_F(PublishedFileTest, GivesThePlacesOfSensorsThatDoNotComeBackToNewOnesAndThenNoMore) {
  for (const std::string sensor : {"a", "b"}) open(2)->note(sensor, sample(1));
  {
    const auto file = open(2);
    file->note("b", sample(2));
    file->note("c", sample(3));
    file->note("d", sample(4));
  }
  const auto file = open(2);
  EXPECT_EQ(file->remembered(), 2U);
  EXPECT_EQ(file->take_before("b")->sequence, 2U);
  EXPECT_EQ(file->take_before("c")->sequence, 3U);
}

TEST_F(PublishedFileTest, BeginsADamagedFileAnewWithAWarning) {
  for (const std::string& text : {std::string(1000, 'x'), std::string("{}")}) {
    folder.write("published", text);
    warnings.clear();
    open()->note("front", sample(1));
    EXPECT_THAT(warnings, SizeIs(1));
    EXPECT_EQ(open()->take_before("front")->sequence, 1U);
  }
}

TEST_F(PublishedFileTest, BelongsToOneProcessAndItsFolderMustBeThere) {
  const auto file = open();
  try {
    open();
    FAIL() << "taken twice";
  } catch (const Unavailable& error) {
    EXPECT_THAT(error.what(), HasSubstr("restart.published_file"));
    EXPECT_THAT(error.what(), HasSubstr("this daemon alone"));
  }
  path = folder.path("none/published");
  EXPECT_THROW(open(), Unavailable);
}

TEST_F(PublishedFileTest, WithoutANameKeepsNothing) {
  path.clear();
  const auto file = open();
  file->note("front", sample(1));
  file->forget("front");
  EXPECT_FALSE(file->take_before("front"));
}

}  // namespace
}  // namespace gyrod::app
