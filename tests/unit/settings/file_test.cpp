// The file around the text: found, readable, and what is relative to it.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "settings/load.hpp"
#include "support/scratch_folder.hpp"

namespace gyrod::settings {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class SettingsFile : public ::testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) { return scratch_.write(name, text); }

  /// What load_settings() throws, "" if it does not.
  static std::string error_of(const fs::path& file) {
    try {
      (void)load_settings(file);
    } catch (const SettingsError& error) {
      return error.what();
    }
    return "";
  }

  gyrod::testing::ScratchFolder scratch_;
  const fs::path& directory_ = scratch_.path();
};

TEST_F(SettingsFile, GivenKeysReplaceDefaultsAndTheOthersStay) {
  const Settings settings = load_settings(write("a.json", R"({"denoise": {"hop_samples": 64}, "workers": 3,
      "limits": {"max_rate_radps": 17.5}, "monitor": {"port": 0, "enabled": false}, "stop": {"deadline_s": 1}})"));
  EXPECT_EQ(settings.engine.hop_samples, 64U);
  EXPECT_EQ(settings.engine.window_samples, 1024U);
  EXPECT_EQ(settings.workers, 3U);
  EXPECT_EQ(settings.engine.max_rate_radps, 17.5);
  EXPECT_EQ(settings.monitor.port, 0);
  EXPECT_FALSE(settings.monitor.enabled);
  EXPECT_EQ(settings.stop_deadline_s, 1.0);
}

TEST_F(SettingsFile, TheErrorNamesTheFileAndHoldsEveryIssueOnALineOfItsOwn) {
  const fs::path file = write("a.json", R"({"workers": -1, "bus": {"domain": "x"}})");
  EXPECT_EQ(error_of(file), file.string() +
                                ": 2 errors\n"
                                "  workers is -1; expected an integer from 0 to 256 (threads)\n"
                                "  bus.domain is \"x\"; expected an integer from 0 to 230");
}

TEST_F(SettingsFile, AMissingFileADirectoryAndADeviceAreErrors) {
  EXPECT_EQ(error_of(directory_ / "none.json"),
            (directory_ / "none.json").string() + ": 1 error\n  no such file");
  EXPECT_THAT(error_of(directory_ / "none" / "a.json"), HasSubstr("no such file"));
  EXPECT_EQ(error_of(directory_), directory_.string() + ": 1 error\n  is a directory, not a file");
  EXPECT_THAT(error_of("/dev/zero"), HasSubstr("is not a regular file"));
  EXPECT_THAT(error_of(""), HasSubstr("no such file"));
}

TEST_F(SettingsFile, AnUnreadableFileIsAnError) {
  if (geteuid() == 0) GTEST_SKIP() << "root reads every file";
  const fs::path file = write("a.json", "{}");
  fs::permissions(file, fs::perms::none);
  EXPECT_THAT(error_of(file), HasSubstr("cannot be read: Permission denied"));
}

TEST_F(SettingsFile, AFileBeyondAMebibyteIsRefusedUnread) {
  EXPECT_THAT(error_of(write("a.json", std::string((1U << 20U) + 1, ' '))),
              HasSubstr("is larger than 1 MiB"));
}

TEST_F(SettingsFile, ANetworkFileIsRelativeToTheConfiguration) {
  const fs::path network = write("network.xml", "<CycloneDDS/>");
  const Settings settings = load_settings(write("a.json", R"({"bus": {"network": "network.xml"}})"));
  EXPECT_EQ(settings.bus.network, network.string());
}

TEST_F(SettingsFile, AnAbsoluteNetworkFileStaysAndTheTwoWordsAreNoFiles) {
  const fs::path network = write("network.xml", "<CycloneDDS/>");
  const fs::path file = write("a.json", R"({"bus": {"network": ")" + network.string() + R"("}})");
  EXPECT_EQ(load_settings(file).bus.network, network.string());
  EXPECT_EQ(load_settings(write("b.json", R"({"bus": {"network": "default"}})")).bus.network, "default");
  EXPECT_EQ(load_settings(write("c.json", R"({"bus": {"network": "loopback"}})")).bus.network, "loopback");
}

TEST_F(SettingsFile, AMissingNetworkFileIsAnErrorNow) {
  EXPECT_THAT(error_of(write("a.json", R"({"bus": {"network": "none.xml"}})")),
              HasSubstr("bus.network is \"none.xml\"; expected \"loopback\", \"default\" or the path of a "
                        "Cyclone DDS XML file"));
}

TEST_F(SettingsFile, GivesAKeyThatStandsInItBeItWithItsDefault) {
  const fs::path file = write("c.json", R"({"denoise": {"screening": "windowed"}})");
  EXPECT_TRUE(gives(file, "denoise.screening"));
  EXPECT_FALSE(gives(file, "denoise.scheme"));
  EXPECT_FALSE(gives(file, "bus.domain"));
}

}  // namespace
}  // namespace gyrod::settings
