/// The noise of every sensor over the last ten minutes, coarse enough to be kept for all of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "stream/counters.hpp"

namespace gyrod::live {

/// One figure an axis every kPeriodS: the noise floor that the last report tells. One thread notes, any may read. What it holds of a sensor
/// is sized when the sensor is first noted.
class NoiseHistory {
 public:
  static constexpr double kPeriodS = 10.0;
  static constexpr std::size_t kPoints = 60;
  using Axes = std::array<float, stream::kAxes>;  ///< rad/s; 0: not known then

  /// Takes a figure of each sensor that is noted until end_round(), which forgets the sensors that were not.
  void note(const stream::ChannelSnapshot& sensor);
  void end_round();

  /// Oldest first, at most kPoints; empty of a sensor that was not noted.
  [[nodiscard]] std::vector<Axes> of(std::string_view sensor) const;
  /// Rounds that have ended.
  [[nodiscard]] std::uint64_t rounds() const;

 private:
  struct Ring {
    std::array<Axes, kPoints> points{};
    std::size_t noted = 0;
    std::uint64_t round = 0;
  };

  mutable std::mutex mutex_;
  std::map<std::string, Ring, std::less<>> sensors_;
  std::uint64_t round_ = 0;
};

}  // namespace gyrod::live
