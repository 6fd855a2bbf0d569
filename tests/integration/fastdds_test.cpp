// ROS 2 nodes mostly run on Fast DDS, another vendor's DDS: gyrod must understand it and be understood.
#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rig.hpp"
#include "support/eventually.hpp"
#include "support/imu_message.hpp"

namespace gyrod::testing {
namespace {

/// Numbers between anything else, bit for bit.
std::vector<double> numbers_of(std::string row) {
  std::ranges::replace(row, ',', ' ');
  std::istringstream text(row);
  return {std::istream_iterator<double>(text), {}};
}

class FastDds : public Rig {
 protected:
  [[nodiscard]] std::vector<std::vector<double>> offline_rates(const std::string& estimate) {
    const std::string out = path(estimate + ".csv");
    EXPECT_EQ(
        run({"denoise", path("raw.csv"), "-o", out, "--estimate", estimate, "--accelerometer"}).exit_code, 0);
    std::vector<std::vector<double>> rates;
    for (const std::string& row : columns_of(out, {"gyro_x_radps", "gyro_y_radps", "gyro_z_radps"}))
      rates.push_back(numbers_of(row));
    return rates;
  }
  /// What the node printed of one estimate.
  [[nodiscard]] static std::vector<std::vector<double>> printed_rates(const std::string& printed,
                                                                      const std::string& estimate) {
    std::vector<std::vector<double>> rates;
    std::istringstream lines(printed);
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with(estimate + " ")) rates.push_back(numbers_of(line.substr(estimate.size() + 1)));
    }
    return rates;
  }
};

TEST_F(FastDds, ANodeIsDenoisedAsItsRecordingAndGetsItsOwnMessagesBack) {
  constexpr std::size_t kMessages = 1000;
  write_file("raw.csv", recording_of(noisy_imu_messages(kMessages)));
  const auto daemon = start_daemon({.patch = R"({"bus": {"ros2": {"topics": ["rt/car/imu/data_raw"]}}})"});
  const char* program = std::getenv("GYROD_FASTDDS_NODE");
  ASSERT_NE(program, nullptr) << "ctest sets it";
  Process node(
      {program, std::to_string(domain_id()), "rt/car/imu/data", std::to_string(kMessages), path("go")},
      path(""), "node");
  ASSERT_TRUE(node.wait_for_err("found")) << node.err();
  ASSERT_TRUE(eventually([&] { return metric(*daemon, "gyrod_bus_matched_writers") == 1.0; }));
  write_file("go", "");
  ASSERT_EQ(node.wait(), 0) << node.err();

  for (const std::string estimate : {"denoised", "realtime"}) {
    const auto live = printed_rates(node.out(), estimate);
    EXPECT_EQ(live.size(), kMessages) << estimate;
    EXPECT_TRUE(live == offline_rates(estimate)) << estimate;
  }
  EXPECT_EQ(stop_daemon(*daemon), 0) << daemon->err();
}

}  // namespace
}  // namespace gyrod::testing
