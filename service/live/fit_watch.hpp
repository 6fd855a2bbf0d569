/// What of the models' fit is news: sensors whose models have not fitted for long, and which fit again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "stream/counters.hpp"

namespace gyrod::live {

/// Tells of an axis whose misfit (stream::ModelFit) has held without a break for kHeldS, and when it has been over for as long: one piece of news a sensor,
/// of all its axes for which that is new. A sensor that is silent, stuck or saturated, whose health tells more, begins anew. Keeps nothing of
/// sensors that fit. One thread.
class FitWatch {
 public:
  static constexpr double kHeldS = 60.0;
  /// In so long, s, at most kMostSensors are told one by one; the others in sum at its end: thousands with a bad file of calibrations are one matter.
  static constexpr double kSumS = 60.0;
  static constexpr std::size_t kMostSensors = 10;

  struct News {
    bool trouble = false;  ///< else it is over
    std::string sensor;    ///< empty: of several
    std::string text;      ///< one sentence, without its full stop
  };

  /// Takes each sensor's last report, in rounds every few seconds; end_round() forgets the sensors that were not noted.
  /// @param now_s of a steady clock
  void note(double now_s, const stream::ChannelSnapshot& sensor);
  [[nodiscard]] std::vector<News> end_round(double now_s);

 private:
  struct Axis {
    bool misfit = false;        ///< as last seen
    std::uint64_t misfits = 0;  ///< as last seen: a misfit that came and went in between has not held
    double since_s = 0.0;       ///< when `misfit` became so
    bool told = false;          ///< what was told of it last
  };
  struct Sensor {
    std::array<Axis, stream::kAxes> axis{};
    std::uint64_t round = 0;
  };

  void tell(News news);
  void sum_up(double now_s);

  std::map<std::string, Sensor, std::less<>> sensors_;  ///< of which an axis does not fit, or is told not to
  std::uint64_t round_ = 0;
  std::vector<News> news_;
  double next_sum_s_ = 0.0;
  std::size_t told_ = 0;                 ///< one by one, since the last sum
  std::array<std::size_t, 2> others_{};  ///< sensors since then: fit again; do not fit
};

}  // namespace gyrod::live
