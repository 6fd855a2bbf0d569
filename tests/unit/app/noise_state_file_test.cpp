#include "app/noise_state_file.hpp"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"

namespace gyrod::app {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

settings::NoiseStates states(double rest_seconds) {
  core::StandstillState state;
  state.sample_rate_hz = 100.0;
  state.rest_seconds = rest_seconds;
  state.segments = 20.0;
  state.bias_seconds = 60.0;
  state.models.fill(core::white_noise(1e-5));
  return {{"front", state}};
}

class NoiseStateFileTest : public ::testing::Test {
 protected:
  NoiseStateFile file(const std::string& name) {
    return {name, [this](const std::string& line) { warnings.push_back(line); }};
  }
  testing::ScratchFolder folder;
  std::string path = folder.path("noise.json");
  std::vector<std::string> warnings;
};

TEST_F(NoiseStateFileTest, KeepsWhatWasSaved) {
  EXPECT_THAT(file(path).load(), IsEmpty()) << "no file yet, which is no trouble";
  NoiseStateFile first = file(path);
  EXPECT_TRUE(first.save(states(60.0)));
  EXPECT_TRUE(first.save(states(120.0)));
  EXPECT_EQ(file(path).load().at("front").rest_seconds, 120.0);
  EXPECT_EQ(folder.files(), 1U) << "nothing temporary is left";
  EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(NoiseStateFileTest, DoesNothingWithoutAPath) {
  NoiseStateFile none = file("");
  EXPECT_THAT(none.load(), IsEmpty());
  EXPECT_TRUE(none.save(states(60.0)));
  EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(NoiseStateFileTest, SaysAtOnceThatItsFolderIsNotThere) {
  NoiseStateFile lost = file(folder.path("nowhere/noise.json"));
  EXPECT_THAT(lost.load(), IsEmpty());
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("nowhere is no folder; learned noise is not kept")));
  EXPECT_FALSE(lost.save(states(60.0)));
  EXPECT_EQ(lost.errors(), 1U);
  EXPECT_THAT(warnings, SizeIs(1)) << "said once";
}

TEST_F(NoiseStateFileTest, PutsADamagedFileAsideWithOneWarning) {
  ASSERT_TRUE(file(path).save(states(60.0)));
  const std::string good = folder.read("noise.json");
  folder.write("noise.json", good.substr(0, good.size() / 2));
  NoiseStateFile damaged = file(path);
  EXPECT_THAT(damaged.load(), IsEmpty());
  EXPECT_THAT(warnings, ElementsAre(HasSubstr(path + ": line ")));
  EXPECT_THAT(warnings.front(),
              HasSubstr("; noise is learned anew, the file is kept as " + path + ".damaged"));
  EXPECT_EQ(folder.read("noise.json.damaged"), good.substr(0, good.size() / 2));
  EXPECT_TRUE(damaged.save(states(90.0)));
  EXPECT_EQ(file(path).load().at("front").rest_seconds, 90.0);
  EXPECT_THAT(warnings, SizeIs(1));
}

// A name that ends in .gz is compressed by whoever writes it, so it has to be readable.
TEST_F(NoiseStateFileTest, KeepsWhatWasSavedCompressedAndPutsACutFileAside) {
  const std::string compressed = folder.path("noise.json.gz");
  ASSERT_TRUE(file(compressed).save(states(60.0)));
  const std::string good = folder.read("noise.json.gz");
  EXPECT_TRUE(good.starts_with("\x1f\x8b"));
  EXPECT_EQ(file(compressed).load().at("front").rest_seconds, 60.0);
  folder.write("noise.json.gz", good.substr(0, good.size() / 2));
  EXPECT_THAT(file(compressed).load(), IsEmpty());
  EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr(compressed + ": cannot be read: gzip: "),
                                          HasSubstr("the file is kept as " + compressed + ".damaged"))));
}

// Shards with one configuration: each has its own sensors, and knows the other's from the last start only.
TEST_F(NoiseStateFileTest, TwoDaemonsKeepEachOthersSensors) {
  ASSERT_TRUE(file(path).save(states(60.0)));
  NoiseStateFile one = file(path);
  NoiseStateFile other = file(path);
  settings::NoiseStates of_one = one.load();
  settings::NoiseStates of_other = other.load();
  of_one.at("front").rest_seconds = 120.0;
  of_other["rear"] = states(30.0).at("front");
  ASSERT_TRUE(one.save(of_one));
  ASSERT_TRUE(other.save(of_other));
  const auto seconds = [this](const char* sensor) { return file(path).load().at(sensor).rest_seconds; };
  EXPECT_EQ(seconds("front"), 120.0) << "the other has nothing new of it";
  EXPECT_EQ(seconds("rear"), 30.0);
  of_one.at("front").rest_seconds = 180.0;
  ASSERT_TRUE(one.save(of_one));
  EXPECT_EQ(seconds("front"), 180.0);
  EXPECT_EQ(seconds("rear"), 30.0) << "which this one has never heard of";
}

// What turned out to be no rest has no models any more, and must not come back from the file.
TEST_F(NoiseStateFileTest, WhatIsForgottenHereIsGoneThere) {
  ASSERT_TRUE(file(path).save(states(60.0)));
  NoiseStateFile one = file(path);
  settings::NoiseStates of_one = one.load();
  of_one.at("front") = {};
  ASSERT_TRUE(one.save(of_one));
  EXPECT_THAT(file(path).load(), IsEmpty());
}

TEST_F(NoiseStateFileTest, PutsAnotherVersionAside) {
  folder.write("noise.json", R"({"gyrod_noise_state": 7, "sensors": {}})");
  EXPECT_THAT(file(path).load(), IsEmpty());
  EXPECT_THAT(
      warnings,
      ElementsAre(HasSubstr("gyrod_noise_state is 7; expected 1 to 2, the versions that this gyrod knows")));
}

TEST_F(NoiseStateFileTest, LeavesWhatIsNoFileOrTooLarge) {
  std::filesystem::create_directory(path);
  EXPECT_THAT(file(path).load(), IsEmpty());
  EXPECT_THAT(warnings, ElementsAre(path + ": is a directory, not a file; noise is learned anew"));
  std::filesystem::remove(path);
  folder.write("noise.json", "");
  std::filesystem::resize_file(path, (std::uintmax_t{128} << 20U) + 1);  // sparse
  EXPECT_THAT(file(path).load(), IsEmpty());
  EXPECT_THAT(warnings.back(), HasSubstr("is larger than 128 MiB; noise is learned anew"));
}

TEST_F(NoiseStateFileTest, WarnsOnceThatItCannotBeWrittenAndAgainAfterItCould) {
  NoiseStateFile there = file(folder.path("state/noise.json"));
  EXPECT_FALSE(there.save(states(60.0)));
  EXPECT_FALSE(there.save(states(61.0)));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr(
                            "/state/noise.json: cannot be written: No such file or directory; learned "
                            "noise is not kept across a restart")));
  std::filesystem::create_directory(folder.path("state"));
  EXPECT_TRUE(there.save(states(62.0)));
  std::filesystem::remove_all(folder.path("state"));
  EXPECT_FALSE(there.save(states(63.0)));
  EXPECT_THAT(warnings, SizeIs(2));
}

TEST_F(NoiseStateFileTest, SurvivesAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  NoiseStateFile full = file("/dev/full");
  EXPECT_FALSE(full.save(states(60.0)));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("No space left on device")));
}

// A save takes a fraction of a millisecond; the moments are spread over several.
TEST_F(NoiseStateFileTest, AProcessThatIsKilledAtAnyMomentOfASaveLeavesAWholeFile) {
  ASSERT_TRUE(file(path).save(states(1.0)));
  for (int round = 0; round < 30; ++round) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      NoiseStateFile saved = file(path);
      for (double seconds = 1.0;; seconds += 1.0) (void)saved.save(states(seconds));
    }
    usleep(2000 + 137 * static_cast<unsigned>(round));
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_THAT(file(path).load(), SizeIs(1)) << round;
  }
  EXPECT_THAT(warnings, IsEmpty());
}

// Who asked for the size, here by a limit on the process, would get the same answer from a full disk: the write fails.
TEST_F(NoiseStateFileTest, AFullDiskIsCountedAndTheOldFileStaysUntilThereIsRoom) {
  NoiseStateFile kept = file(path);
  ASSERT_TRUE(kept.save(states(1.0)));
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto ignored = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit full{16, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &full);
  const bool saved = kept.save(states(2.0));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, ignored);
  EXPECT_FALSE(saved);
  EXPECT_EQ(kept.errors(), 1U);
  EXPECT_THAT(warnings, SizeIs(1));
  EXPECT_EQ(kept.load().begin()->second.rest_seconds, 1.0);
  EXPECT_TRUE(kept.save(states(3.0)));
  EXPECT_EQ(kept.load().begin()->second.rest_seconds, 3.0);
}

}  // namespace
}  // namespace gyrod::app
