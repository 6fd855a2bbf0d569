/// A committed output of a simulated drive: a change of any number shows here first, and in review as a diff.
///
/// Regenerate, after a change that is meant to change numbers, from the root of the clone:
///   build/release/gyrod simulate --motion drive --seed 7 --samples 1500 -o tests/golden/drive.csv
///   build/release/gyrod denoise tests/golden/drive.csv -o tests/golden/drive_joint.csv --method joint
///   build/release/gyrod denoise tests/golden/drive.csv -o tests/golden/drive_denoised.csv --method paper
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rig.hpp"

namespace gyrod::testing {
namespace {

class Golden : public Rig {
 protected:
  static std::string golden(const std::string& name) {
    return std::string(std::getenv("GYROD_SOURCE_DIR")) + "/tests/golden/" + name;
  }
};

TEST_F(Golden, TheSimulatedDriveIsTheSameToTheLastBit) {
  ASSERT_EQ(
      run({"simulate", "--motion", "drive", "--seed", "7", "--samples", "1500", "-o", path("drive.csv")})
          .exit_code,
      0);
  EXPECT_EQ(read_file("drive.csv"), read_text(golden("drive.csv")))
      << "the simulator needs no library function that rounds";
}

/// A method, and the file that holds what it made.
struct Made {
  std::string method;
  std::string file;
};
const std::vector<Made> kMade = {{"joint", "drive_joint.csv"}, {"paper", "drive_denoised.csv"}};

TEST_F(Golden, TheDenoisedDriveIsTheSameToTheLastBitByBothMethods) {
  for (const Made& made : kMade) {
    ASSERT_EQ(run({"denoise", golden("drive.csv"), "-o", path("out.csv"), "--method", made.method}).exit_code,
              0);
    EXPECT_TRUE(read_file("out.csv") == read_text(golden(made.file))) << made.method;
  }
}

TEST_F(Golden, AnotherProcessorsLibraryChangesNoBit) {
  // Told that there is neither FMA nor AVX2, glibc has other functions for exp, log and sin, which differ in the last place. Elsewhere this changes
  // nothing. Long windows: of their transforms, the roots of unity differ, too. At rest noise is learned, too.
  ASSERT_EQ(
      run({"simulate", "--motion", "still", "--seed", "7", "--samples", "6000", "-o", path("still.csv")})
          .exit_code,
      0);
  write_file("long.json", R"({"denoise": {"window_samples": 4096}})");
  const std::vector<std::vector<std::string>> commands = {
      {"denoise", golden("drive.csv"), "--method", "joint"},
      {"denoise", golden("drive.csv"), "--method", "paper"},
      {"denoise", path("still.csv"), "--config", path("long.json")},
      {"calibrate", path("still.csv")}};
  for (std::vector<std::string> command : commands) {
    command.insert(command.end(), {"-o", path("here")});
    ASSERT_EQ(run(command).exit_code, 0) << command[0];
    command.back() = path("there");
    setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-AVX2", 1);
    const Result there = run(command);
    unsetenv("GLIBC_TUNABLES");
    ASSERT_EQ(there.exit_code, 0) << command[0];
    EXPECT_TRUE(read_file("here") == read_file("there")) << command[0] << " " << command[1];
  }
}

TEST_F(Golden, TheDefaultMethodIsJoint) {
  ASSERT_EQ(run({"denoise", golden("drive.csv"), "-o", path("out.csv")}).exit_code, 0);
  ASSERT_EQ(run({"denoise", golden("drive.csv"), "-o", path("joint.csv"), "--method", "joint"}).exit_code, 0);
  EXPECT_EQ(read_file("out.csv"), read_file("joint.csv"));
}

TEST_F(Golden, DenoisingBringsTheDriveNearerToItsTruth) {
  ASSERT_EQ(run({"denoise", golden("drive.csv"), "-o", path("out.csv")}).exit_code, 0);
  for (const std::string axis : {"x", "y", "z"}) {
    const auto distance = [&](const std::string& file) {
      const auto rate = columns_of(file, {"gyro_" + axis + "_radps"});
      const auto truth = columns_of(file, {"truth_" + axis + "_radps"});
      double sum = 0.0;
      for (std::size_t n = 0; n < rate.size(); ++n)
        sum += std::pow(std::stod(rate[n]) - std::stod(truth[n]), 2);
      return std::sqrt(sum / static_cast<double>(rate.size()));
    };
    EXPECT_LT(distance(path("out.csv")), 0.8 * distance(golden("drive.csv"))) << axis;
  }
}

}  // namespace
}  // namespace gyrod::testing
