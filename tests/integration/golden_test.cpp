/// A committed output of a simulated drive: a change of any number shows here first, and in review as a diff.
///
/// Regenerate, after a change that is meant to change numbers, from the root of the clone:
///   build/release/gyrod simulate --motion drive --seed 7 --samples 1500 -o tests/golden/drive.csv
///   build/release/gyrod denoise tests/golden/drive.csv -o tests/golden/drive_joint.csv --method joint
///   build/release/gyrod denoise tests/golden/drive.csv -o tests/golden/drive_denoised.csv --method paper
#include <cmath>
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
  /// Largest difference in a column of numbers.
  static double difference(const std::string& a, const std::string& b, const std::string& column) {
    const auto x = columns_of(a, {column});
    const auto y = columns_of(b, {column});
    if (x.size() != y.size()) return INFINITY;
    double largest = 0.0;
    for (std::size_t n = 0; n < x.size(); ++n) {
      const double distance = std::fabs(std::stod(x[n]) - std::stod(y[n]));
      if (!(distance <= largest)) largest = distance;  // a NaN stays
    }
    return largest;
  }
};

const std::vector<std::string> kColumns = {"gyro_x_radps", "gyro_y_radps", "gyro_z_radps"};

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

TEST_F(Golden, TheDenoisedDriveIsTheSameByBothMethods) {
  // The noise is 6e-3 rad/s. Sine and logarithm of the C library may differ in the last place from machine to
  // machine, which comes out near 1e-16; a changed decision or constant comes out far above 1e-12.
  for (const Made& made : kMade) {
    ASSERT_EQ(run({"denoise", golden("drive.csv"), "-o", path("out.csv"), "--method", made.method}).exit_code,
              0);
    for (const std::string& column : kColumns)
      EXPECT_LE(difference(path("out.csv"), golden(made.file), column), 1e-12)
          << made.method << " " << column;
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
