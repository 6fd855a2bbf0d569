/// Sensors for the tests of fleets.
#pragma once

#include <string>
#include <vector>

namespace gyrod::fleet {

/// Sensors enough that each shard of a small count has some that any other count puts elsewhere.
inline const std::vector<std::string>& sensors() {
  static const std::vector<std::string> ids = [] {
    std::vector<std::string> made;
    for (int k = 0; k < 200; ++k) made.push_back("imu_" + std::to_string(k));
    return made;
  }();
  return ids;
}
}  // namespace gyrod::fleet
