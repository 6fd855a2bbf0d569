#include "app/version.hpp"

#include <Eigen/Core>
#include <spdlog/version.h>

namespace gyrod::app {

const char* version() noexcept { return GYROD_VERSION; }

std::string version_text() {
  const auto dotted = [](int major, int minor, int patch) {
    return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
  };
  return std::string("gyrod ") + GYROD_VERSION + "\nCyclone DDS " + GYROD_CYCLONEDDS_VERSION + ", Eigen " +
         dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION) + ", spdlog " +
         dotted(SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH) + "\nLicence: Apache-2.0";
}

}  // namespace gyrod::app
