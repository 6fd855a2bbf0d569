/// What a daemon leaves out when it takes over a sensor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace gyrod::fleet {

/// Two daemons are not given a sample at the same time: a repaired loss brings it to one of them hundreds of milliseconds later. So it
/// is not enough that one serves after the other; the second must leave out what the first may have served: all that was sent before the
/// second learned that the first has stopped.
///
/// When a sample was sent is told by its stamp and the least that `time of arrival - stamp` has been in the last half a minute to a
/// minute. That needs no clocks that agree, nor such that keep the same pace for long, and errs to the later side of a hole: nothing
/// twice. A sensor whose clock is set back just then is given up on after kLongest.
///
/// Times are ns of one steady clock. Allocates for a sensor that was not watched before. One thread at a time.
class Succession {
 public:
  /// Two ways through the network differ by less, in the least time they take; and by as much as the delay is above its least in the mean.
  /// Where packets are lost, one that is missing holds up those behind it, and none may come without delay for as long as this one watches.
  static constexpr std::int64_t kMarginNs = 20'000'000;
  /// That mean begins here, as a sensor that was hardly watched may have been held up all the time; each sample tells a 64th of it.
  static constexpr std::int64_t kFirstDoubtNs = 200'000'000;
  static constexpr std::int64_t kMostDoubtNs = 1'000'000'000;
  /// No sample that arrives later than this after a take-over is left out. Where one packet in five is lost, repairs take seconds.
  static constexpr std::int64_t kLongestNs = 10'000'000'000;
  /// A delay is remembered for one to two of these: a clock that is wrong by 100 ppm goes 6 ms astray.
  static constexpr std::int64_t kMemoryNs = 30'000'000'000;
  /// Sensors that are watched at the most; of further ones nothing is left out.
  static constexpr std::size_t kMostSensors = 65536;

  /// A sample came of a sensor that another daemon serves, and that may come to this one.
  void watch(std::string_view sensor, std::int64_t stamp_ns, std::int64_t now_ns);

  /// For each sensor that is watched: another has stopped to serve it just now if now_served(sensor); if not, another goes on.
  template <class NowServed>
  void change(std::int64_t now_ns, const NowServed& now_served) {
    for (auto& [sensor, watched] : watched_) {
      const bool taken = now_served(std::string_view(sensor));
      if (!taken || watched.taken_ns == kNotTaken) watched.taken_ns = taken ? now_ns : kNotTaken;
    }
  }

  /// Of the sensors that are served now another has told where it has stopped: nothing of them is left out by time.
  template <class NowServed>
  void settle(const NowServed& now_served) {
    std::erase_if(watched_, [&](const auto& entry) { return now_served(std::string_view(entry.first)); });
  }

  /// Whether the sample, of a sensor that this daemon serves, may have been served before. Samples come in order; the first that was not
  /// ends the watch.
  [[nodiscard]] bool may_have_been_served(std::string_view sensor, std::int64_t stamp_ns,
                                          std::int64_t now_ns) noexcept;

 private:
  static constexpr std::int64_t kNotTaken = INT64_MIN;

  struct Watched {
    std::int64_t least_delay_ns = INT64_MAX;   ///< since period_began_ns
    std::int64_t least_before_ns = INT64_MAX;  ///< in the period before that
    std::int64_t doubt_ns = kFirstDoubtNs;     ///< mean of what the delay is above its least
    std::int64_t period_began_ns = 0;
    std::int64_t taken_ns = kNotTaken;
  };
  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const noexcept {
      return std::hash<std::string_view>{}(text);
    }
  };

  std::unordered_map<std::string, Watched, Hash, std::equal_to<>> watched_;
};

}  // namespace gyrod::fleet
