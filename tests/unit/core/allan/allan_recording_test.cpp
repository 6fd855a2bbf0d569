// A real gyro against the curve that others have published of it. The recordings are not part of the project.
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <zlib.h>

#include "allan_support.hpp"
#include "support/data_folder.hpp"

namespace gyrod {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kChannels = 6;
using Channels = std::array<std::vector<double>, kChannels>;

/// Columns 1..6 of rows "sample,gyro x,y,z,accelerometer x,y,z".
Channels read_channels(const fs::path& path) {
  Channels channels;
  gzFile file = gzopen(path.c_str(), "rb");
  std::array<char, 256> line{};
  gzgets(file, line.data(), static_cast<int>(line.size()));
  while (gzgets(file, line.data(), static_cast<int>(line.size())) != nullptr) {
    char* end = line.data();
    std::strtod(end, &end);
    for (auto& channel : channels) channel.push_back(std::strtod(end + 1, &end));
  }
  gzclose(file);
  return channels;
}

struct Published {
  double tau_s = 0.0;
  double deviation = 0.0;
};

/// Rows "channel,tau_s,adev,lci,uci". The bounds there are adev (1 -+ 2 / sqrt(2 (N/m - 1))), twice the standard error
/// of N/m - 1 independent differences with Gaussian bounds, whatever the noise: symmetric, and for the longest
/// times nearly down to 0. Ours are chi-squared with the degrees of freedom of the noise found; not compared.
std::map<std::string, std::vector<Published>> read_published(const fs::path& path) {
  std::map<std::string, std::vector<Published>> curves;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string channel;
    std::string tau;
    std::string deviation;
    std::getline(cells, channel, ',');
    std::getline(cells, tau, ',');
    std::getline(cells, deviation, ',');
    curves[channel].push_back({std::stod(tau), std::stod(deviation)});
  }
  return curves;
}

// Published with 12 digits by SMAC-Group/avar; made from a copy of the data with more digits than ours, which sets
// the 5e-6 (stated with the file).
TEST(AllanOfARealGyro, AgreesWithThePublishedCurveOfAllSixChannels) {
  const fs::path recording = test::data_folder() / "adis16405_imu1_static_100hz.csv.gz";
  const fs::path answer = test::data_folder() / "known_answer_adis16405_imu1_oadev.csv";
  if (!fs::exists(recording) || !fs::exists(answer)) GTEST_SKIP() << "no recording " << recording;
  const Channels channels = read_channels(recording);
  auto published = read_published(answer);
  const std::array<const char*, kChannels> names = {"Gyro. X",  "Gyro. Y",  "Gyro. Z",
                                                    "Accel. X", "Accel. Y", "Accel. Z"};
  for (std::size_t c = 0; c < kChannels; ++c) {
    const auto& curve = published[names[c]];
    ASSERT_EQ(curve.size(), 18U) << names[c];
    std::vector<std::size_t> sizes;
    for (const auto& row : curve) sizes.push_back(static_cast<std::size_t>(std::lround(row.tau_s * 100.0)));
    const auto points = core::allan_deviation_at(channels[c], 100.0, sizes);
    ASSERT_EQ(points.size(), curve.size());
    for (std::size_t i = 0; i < curve.size(); ++i) {
      EXPECT_NEAR(points[i].deviation / curve[i].deviation, 1.0, 5e-6) << names[c] << " " << curve[i].tau_s;
    }
  }
}

}  // namespace
}  // namespace gyrod
